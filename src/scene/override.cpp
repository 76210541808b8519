#include "scene/override.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "scene/table_reader.h"

namespace bookspin {
namespace {

std::optional<std::size_t> index(std::string_view text) {
  std::size_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw std::invalid_argument(location(error.source()) + std::string(error.description()));
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
      if (last) {
        put(*table, key, *value.get("value"));
        return;
      }
      if (!table->contains(key)) {
        if (key == "book" || key == "expect") fail(fmt::format("the scene has no {}", key));
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
