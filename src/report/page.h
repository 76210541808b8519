// Fills the report's page: {{key}} in videos/report/page.html by the value of that key, as it is.
//
// Throws std::runtime_error for a key that the template asks for and nobody gives, and one that is given and not asked
// for.
#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace bookspin {

using PageValues = std::map<std::string, std::string>;

[[nodiscard]] std::string fill_page(const std::filesystem::path& page_template, const PageValues& values);

}  // namespace bookspin
