// A table of the report: the same rows as CSV, as JSON, and for the page.
//
// A number that is not finite is an empty cell in CSV, null in JSON, a dash on the page. CSV and JSON keep all digits,
// the page three.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace bookspin {

using Cell = nlohmann::json;                                   // a text or a number
[[nodiscard]] Cell number_or(const char* word, double value);  // the word for a number that is not finite

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  // each as long as columns
};

[[nodiscard]] std::string as_csv(const Table& table);
[[nodiscard]] nlohmann::ordered_json as_json(const Table& table);  // a list of objects, one a row
// {columns: [{text, number}], rows: [{cells: [{text, number, head}]}]}: number is true of each cell of a column of
// numbers, head of the first cell.
[[nodiscard]] nlohmann::json for_page(const Table& table);

// Three digits, 1.2e-7 as "1.2·10⁻⁷", a power of ten as "10⁻⁷": for reading.
[[nodiscard]] std::string readable(double value);
void make_readable(nlohmann::json& values);  // each number in it; whole ones stay what they are

}  // namespace bookspin
