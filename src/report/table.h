// A table of the report: the same rows as CSV, as JSON and as HTML.
//
// A number that is not finite is an empty cell in CSV, null in JSON, a dash in HTML. CSV and JSON keep eight digits,
// HTML three.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace bookspin {

using Cell = std::variant<std::string, double>;

struct Table {
  std::string name;  // of its CSV file, and its key in the JSON
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  // each as long as columns
};

[[nodiscard]] std::string as_csv(const Table& table);
[[nodiscard]] std::string as_html(const Table& table);
[[nodiscard]] std::string as_json(const std::vector<Table>& tables,
                                  const std::vector<std::pair<std::string, std::string>>& head);

[[nodiscard]] std::string escape_text(std::string_view text);  // & < > for HTML

// Three digits, 1.2e-7 as "1.2·10⁻⁷": for reading.
[[nodiscard]] std::string readable(double value);

}  // namespace bookspin
