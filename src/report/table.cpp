#include "report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace bookspin {
namespace {

std::string csv_cell(const Cell& cell) {
  if (cell.is_number()) return std::isfinite(cell.get<double>()) ? fmt::format("{}", cell.get<double>()) : "";
  std::string text = cell;
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  return quoted + '"';
}

}  // namespace

Cell number_or(const char* word, double value) {
  return std::isfinite(value) ? Cell(value) : Cell(word);
}

std::string as_csv(const Table& table) {
  std::string out;
  const auto add = [&](const auto& row) {
    std::vector<std::string> cells;
    std::transform(row.begin(), row.end(), std::back_inserter(cells), csv_cell);
    out += fmt::format("{}\n", fmt::join(cells, ","));
  };
  add(table.columns);
  for (const auto& row : table.rows) add(row);
  return out;
}

nlohmann::ordered_json as_json(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    auto& object = rows.emplace_back();
    for (std::size_t i = 0; i < row.size(); ++i) object[table.columns[i]] = row[i];
  }
  return rows;
}

nlohmann::json for_page(const Table& table) {
  nlohmann::json page{{"columns", nlohmann::json::array()}, {"rows", nlohmann::json::array()}};
  for (const std::string& column : table.columns) {
    const std::size_t i = page["columns"].size();
    const bool number = i > 0 && std::any_of(table.rows.begin(), table.rows.end(),
                                             [i](const auto& row) { return row[i].is_number() || row[i] == "never"; });
    page["columns"].push_back({{"text", column}, {"number", number}});
  }
  for (const auto& row : table.rows) {
    auto& cells = page["rows"].emplace_back()["cells"];
    for (std::size_t i = 0; i < row.size(); ++i)
      cells.push_back({{"text", row[i].is_number() ? Cell(readable(row[i])) : row[i]},
                       {"number", page["columns"][i]["number"]},
                       {"head", i == 0}});
  }
  return page;
}

std::string readable(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size >= 1.0 && size < 1e5 && value == std::floor(value)) return fmt::format("{:.0f}", value);
  if (size > 1e-2 && size < 1e5) {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
    return fmt::format("{:.{}f}", value, decimals);
  }
  static constexpr std::array raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string text = fmt::format("{:.1e}", value);
  const int exponent = std::stoi(text.substr(text.find('e') + 1));
  std::string power = exponent < 0 ? "10⁻" : "10";
  for (const char digit : std::to_string(std::abs(exponent))) power += raised.at(static_cast<std::size_t>(digit - '0'));
  return value == std::stod(fmt::format("1e{}", exponent)) ? power : text.substr(0, text.find('e')) + "·" + power;
}

void make_readable(nlohmann::json& values) {
  if (values.is_structured()) {
    for (auto& value : values) make_readable(value);
  } else if (values.is_number_float()) {
    values = readable(values.get<double>());
  }
}

}  // namespace bookspin
