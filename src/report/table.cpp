#include "report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace bookspin {
namespace {

std::string csv_cell(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return std::isfinite(*value) ? fmt::format("{}", *value) : "";
  const std::string& text = std::get<std::string>(cell);
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

}  // namespace

Cell number_or(const char* word, double value) {
  return std::isfinite(value) ? Cell(value) : Cell(word);
}

std::string as_csv(const Table& table) {
  std::string out = fmt::format("{}\n", fmt::join(table.columns, ","));
  for (const auto& row : table.rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (i > 0) out += ',';
      out += csv_cell(row[i]);
    }
    out += '\n';
  }
  return out;
}

nlohmann::ordered_json as_json(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (std::size_t i = 0; i < row.size(); ++i)
      std::visit([&](const auto& value) { object[table.columns[i]] = value; }, row[i]);
    rows.push_back(std::move(object));
  }
  return rows;
}

nlohmann::json for_page(const Table& table) {
  nlohmann::json columns = nlohmann::json::array();
  nlohmann::json rows = nlohmann::json::array();
  for (const std::string& column : table.columns) {
    const std::size_t i = columns.size();
    const bool number = i > 0 && std::any_of(table.rows.begin(), table.rows.end(), [i](const auto& row) {
                          return std::holds_alternative<double>(row[i]) || std::get<std::string>(row[i]) == "never";
                        });
    columns.push_back({{"text", column}, {"number", number}});
  }
  for (const auto& row : table.rows) {
    nlohmann::json cells = nlohmann::json::array();
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* value = std::get_if<double>(&row[i]);
      cells.push_back({{"text", value == nullptr ? std::get<std::string>(row[i]) : readable(*value)},
                       {"number", columns[i]["number"]},
                       {"head", i == 0}});
    }
    rows.push_back({{"cells", std::move(cells)}});
  }
  return {{"columns", std::move(columns)}, {"rows", std::move(rows)}};
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
