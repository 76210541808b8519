#include "scene/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace bookspin {
namespace {

std::string text_of(const Range& range) {
  const char* more = range.least_excluded ? "more than" : "from";
  if (range.least <= -largest_number && range.most >= largest_number)
    return fmt::format("a number between {:g} and {:g}", range.least, range.most);
  return fmt::format("a number {} {:g}{} {:g}", more, range.least, range.least_excluded ? ", up to" : " to",
                     range.most);
}

std::optional<double> number_in(const toml::node& node, const Range& range) {
  const std::optional<double> value = node.value<double>();
  if (!node.is_number() || !value || !std::isfinite(*value) || *value < range.least || *value > range.most) return {};
  if (range.least_excluded && *value == range.least) return {};
  return value;
}

std::optional<std::size_t> index_of(const toml::node& node, std::span<const std::string_view> words) {
  const auto* text = node.as_string();
  const auto found = text == nullptr ? words.end() : std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) return {};
  return static_cast<std::size_t>(found - words.begin());
}

}  // namespace

std::string location(const toml::source_region& source) {
  const std::string name = source.path ? *source.path : std::string("script");
  if (name.starts_with("--set")) return name + ": ";
  return fmt::format("{}:{}:{}: ", name, source.begin.line, source.begin.column);
}

std::string shown(const toml::node& node) {
  if (node.is_table()) return "a table";
  if (node.is_array_of_tables()) return "a list of tables";
  std::string text;
  if (const toml::array* list = node.as_array()) {
    std::vector<std::string> each;
    for (const toml::node& one : *list) each.push_back(shown(one));
    text = fmt::format("[{}]", fmt::join(each, ", "));
  } else if (const auto* number = node.as_floating_point()) {
    text = fmt::format("{}", number->get());  // the shortest text that means this number, and is no whole number's
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
  } else {
    std::ostringstream out;
    out.imbue(std::locale::classic());
    node.visit([&out](const auto& n) { out << n; });
    text = out.str();
  }
  std::size_t length = 60;
  if (text.size() <= length) return text;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U)
    --length;  // no letter is cut in two
  return text.substr(0, length) + " ...";
}

std::string TableReader::full_key(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

void TableReader::fail(const toml::node& at, std::string_view key, std::string_view allowed) const {
  throw std::invalid_argument(
      fmt::format("{}{}: found {}; allowed: {}", location(at.source()), full_key(key), shown(at), allowed));
}

void TableReader::fail_missing(std::string_view key, std::string_view allowed) const {
  throw std::invalid_argument(
      fmt::format("{}{}: is missing; allowed: {}", location(table_.source()), full_key(key), allowed));
}

const toml::node* TableReader::node(std::string_view key) {
  known_.emplace(key);
  return table_.get(key);
}

void TableReader::read(std::string_view key, std::string& value) {
  const toml::node* found = node(key);
  if (found == nullptr) return;
  if (!found->is_string()) fail(*found, key, "a text in quotes");
  value = found->as_string()->get();
}

void TableReader::read(std::string_view key, bool& value) {
  const toml::node* found = node(key);
  if (found == nullptr) return;
  if (!found->is_boolean()) fail(*found, key, "true or false");
  value = found->as_boolean()->get();
}

void TableReader::read(std::string_view key, int& value, int least, int most) {
  const toml::node* found = node(key);
  if (found == nullptr) return;
  const bool fits = found->is_integer() && found->as_integer()->get() >= least && found->as_integer()->get() <= most;
  if (!fits) fail(*found, key, fmt::format("a whole number from {} to {}", least, most));
  value = static_cast<int>(found->as_integer()->get());
}

void TableReader::read(std::string_view key, double& value, Range range) {
  const toml::node* found = node(key);
  if (found == nullptr) return;
  const std::optional<double> number = number_in(*found, range);
  if (!number) fail(*found, key, text_of(range));
  value = *number;
}

void TableReader::read(std::string_view key, std::optional<double>& value, Range range) {
  if (!has(key)) {
    known_.emplace(key);
    return;
  }
  double number = 0.0;
  read(key, number, range);
  value = number;
}

void TableReader::read(std::string_view key, Eigen::Vector3d& value, Range each) {
  const toml::node* found = node(key);
  if (found == nullptr) return;
  const toml::array* list = found->as_array();
  const std::string allowed = fmt::format("a list of three numbers [x, y, z], each {}", text_of(each));
  if (list == nullptr || list->size() != 3) fail(*found, key, allowed);
  for (int d = 0; d < 3; ++d) {
    const std::optional<double> number = number_in((*list)[static_cast<std::size_t>(d)], each);
    if (!number) fail(*found, key, allowed);
    value(d) = *number;
  }
}

std::size_t TableReader::read_word(std::string_view key, std::span<const std::string_view> words,
                                   std::size_t otherwise) {
  const toml::node* found = node(key);
  if (found == nullptr) return otherwise;
  const std::optional<std::size_t> i = index_of(*found, words);
  if (!i) fail(*found, key, fmt::format("one of \"{}\"", fmt::join(words, "\", \"")));
  return *i;
}

std::vector<std::size_t> TableReader::read_words(std::string_view key, std::span<const std::string_view> words) {
  std::vector<std::size_t> indices;
  const toml::node* found = node(key);
  if (found == nullptr) return indices;
  const std::string allowed = fmt::format("a list of \"{}\"", fmt::join(words, "\", \""));
  if (!found->is_array()) fail(*found, key, allowed);
  for (const toml::node& entry : *found->as_array()) {
    const std::optional<std::size_t> i = index_of(entry, words);
    if (!i) fail(entry, key, allowed);
    indices.push_back(*i);
  }
  return indices;
}

void TableReader::done() const {
  for (const auto& [key, value] : table_) {
    if (known_.contains(key.str())) continue;
    throw std::invalid_argument(fmt::format("{}{}: unknown key; allowed here: {}", location(key.source()),
                                            full_key(key.str()), fmt::join(known_, ", ")));
  }
}

}  // namespace bookspin
