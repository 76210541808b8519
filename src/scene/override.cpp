#include "scene/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "scene/table_reader.h"

namespace bookspin {
namespace {

std::optional<std::size_t> index(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// What most likely went wrong in a text that is no TOML; empty: no idea.
std::string_view slip_in(std::string_view text, const toml::parse_error& error) {
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") || text.substr(0, 4).find('\0') != text.npos) {
    return "; the text is UTF-16: save it as UTF-8";
  }
  if (error.description().find("utf-8") != text.npos) return "; save it as UTF-8";
  for (auto line = error.source().begin.line; line > 1; --line)
    text.remove_prefix(std::min(text.find('\n') + 1, text.size()));
  const std::string line(text.substr(0, std::min<std::size_t>(text.find('\n'), 200)));
  static const std::pair<std::regex, const char*> slips[] = {
      {std::regex("[^\"'#]*[=,[]\\s*(\u201c|\u201d|\u201e|\u2018|\u2019|\u201a|\u00ab|\u00bb).*"),
       "; a text stands in straight quotes, \" or '"},
      {std::regex(R"([^"'#=]*=\s*[-+]?[0-9]+,[0-9].*)"), "; decimals follow a point, not a comma"},
      {std::regex(R"([^"'#=]*=\s*[A-Za-z].*)"), "; a text stands in quotes"},
      {std::regex(R"(\s*[\w"'.-]+\s*:.*)"), "; a key has its value behind ="}};
  for (const auto& [slip, words] : slips) {
    if (std::regex_match(line, slip)) return words;
  }
  return "";
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(
        fmt::format("{}{}{}", location(error.source()), error.description(), slip_in(text, error)));
  }
}

void apply_override(toml::table& scene, const std::string& text) {
  const std::string source = "--set " + text;
  const auto fail = [&source](const std::string& what) { throw std::invalid_argument(source + ": " + what); };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) fail("allowed: KEY=VALUE, such as book.0.method=matrix");
  const std::string value_text = text.substr(equals + 1);
  toml::table value;
  try {
    value = toml::parse("value = " + value_text, source);
  } catch (const toml::parse_error&) {
    std::ostringstream quoted;  // a bare word is a text
    quoted << "value = " << toml::value<std::string>(value_text);
    value = parse_toml(quoted.str(), source);
  }
  if (value.size() != 1) fail("allowed: one value");
  // What is put into the scene knows where it came from, key and value, for the messages.
  const auto put = [&source](toml::table& table, std::string_view key, toml::node& node) {
    const toml::table keyed = parse_toml(fmt::format("'{}' = 0", key), source);
    table.insert_or_assign(keyed.cbegin()->first, std::move(node));
  };
  toml::node* at = &scene;
  std::string_view path = std::string_view(text).substr(0, equals);
  while (true) {
    const std::size_t dot = path.find('.');
    const std::string_view key = path.substr(0, dot);
    const bool last = dot == std::string_view::npos;
    if (toml::array* list = at->as_array()) {
      const std::optional<std::size_t> i = index(key);
      if (!i || *i >= list->size())
        fail(fmt::format("there is no '{}' in a list of {}, counted from 0", key, list->size()));
      if (last) {
        list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(*i), std::move(*value.get("value")));
        return;
      }
      at = list->get(*i);
    } else if (toml::table* table = at->as_table()) {
      if (key.empty()) fail("a part of the key is empty");
      if (last) {
        put(*table, key, *value.get("value"));
        return;
      }
      if (!table->contains(key)) {
        if (key == "book" || key == "expect") fail(fmt::format("the scene has no {}", key));
        if (index(path.substr(dot + 1, path.substr(dot + 1).find('.')))) {
          fail(fmt::format("the script has no list '{0}': give it whole, such as {0}=[1, 2, 3]", key));
        }
        toml::table empty = parse_toml("value = {}", source);
        put(*table, key, *empty.get("value"));
      }
      at = table->get(key);
    } else {
      fail(fmt::format("'{}' is below a value, not a table", key));
    }
    path.remove_prefix(dot + 1);
  }
}

}  // namespace bookspin
