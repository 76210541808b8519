#include "report/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bookspin {
namespace {

std::string csv_cell(const Cell& cell) {
  if (const auto* value = std::get_if<double>(&cell)) return std::isfinite(*value) ? fmt::format("{:.8g}", *value) : "";
  const std::string& text = std::get<std::string>(cell);
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted(1, '"');
  for (const char c : text) quoted.append(c == '"' ? 2 : 1, c);
  quoted += '"';
  return quoted;
}

}  // namespace

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

std::string as_html(const Table& table) {
  std::string out = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& column : table.columns) out += "<th scope=\"col\">" + column + "</th>";
  out += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    out += "<tr>";
    for (std::size_t i = 0; i < row.size(); ++i) {
      const auto* value = std::get_if<double>(&row[i]);
      const std::string text = value == nullptr ? std::get<std::string>(row[i]) : readable(*value);
      if (i == 0) {
        out += fmt::format("<th scope=\"row\">{}</th>", text);
      } else {
        out += fmt::format("<td{}>{}</td>", value != nullptr ? " class=\"n\"" : "", text);
      }
    }
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>";
}

std::string as_json(const std::vector<Table>& tables, const std::vector<std::pair<std::string, std::string>>& head) {
  nlohmann::ordered_json json;
  for (const auto& [key, value] : head) json[key] = value;
  for (const Table& table : tables) {
    auto& rows = json[table.name] = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
      nlohmann::ordered_json object;
      for (std::size_t i = 0; i < row.size(); ++i) {
        const auto* value = std::get_if<double>(&row[i]);
        if (value == nullptr) {
          object[table.columns[i]] = std::get<std::string>(row[i]);
        } else {
          object[table.columns[i]] = std::isfinite(*value)
                                         ? nlohmann::ordered_json(std::stod(fmt::format("{:.8g}", *value)))
                                         : nlohmann::ordered_json();
        }
      }
      rows.push_back(std::move(object));
    }
  }
  return json.dump(1) + "\n";
}

std::string escape_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

std::string readable(double value) {
  if (!std::isfinite(value)) return "–";
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (size < 1e5 && value == std::floor(value)) return fmt::format("{:.0f}", value);
  if (size >= 1e-2 && size < 1e5) {
    const int decimals = std::max(0, 2 - static_cast<int>(std::floor(std::log10(size))));
    return fmt::format("{:.{}f}", value, decimals);
  }
  static constexpr std::array<const char*, 10> raised{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string text = fmt::format("{:.1e}", value);
  const std::size_t e = text.find('e');
  const int exponent = std::stoi(text.substr(e + 1));
  std::string power;
  for (const char digit : std::to_string(std::abs(exponent))) power += raised[static_cast<std::size_t>(digit - '0')];
  return text.substr(0, e) + "·10" + (exponent < 0 ? "⁻" : "") + power;
}

}  // namespace bookspin
