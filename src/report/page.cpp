#include "report/page.h"

#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>

namespace bookspin {

std::string fill_page(const std::filesystem::path& page_template, const PageValues& values) {
  std::ifstream in(page_template, std::ios::binary);
  std::ostringstream read;
  read << in.rdbuf();
  if (!in) throw std::runtime_error(page_template.string() + ": cannot be read");
  const std::string text = read.str();
  std::string page;
  std::set<std::string> used;
  std::size_t from = 0;
  while (true) {
    const std::size_t open = text.find("{{", from);
    page += text.substr(from, open - from);
    if (open == std::string::npos) break;
    const std::size_t close = text.find("}}", open);
    const std::string key = text.substr(open + 2, close == std::string::npos ? close : close - open - 2);
    const auto value = values.find(key);
    if (close == std::string::npos || value == values.end()) {
      throw std::runtime_error(page_template.string() + ": {{" + key.substr(0, 40) +
                               "}}: the report has no such value");
    }
    used.insert(key);
    page += value->second;
    from = close + 2;
  }
  for (const auto& [key, value] : values) {
    if (!used.contains(key))
      throw std::runtime_error(page_template.string() + ": {{" + key + "}} is nowhere asked for");
  }
  return page;
}

}  // namespace bookspin
