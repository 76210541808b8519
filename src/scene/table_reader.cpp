#include "scene/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "scene/did_you_mean.h"

namespace bookspin {
namespace {

constexpr std::size_t most_tables = 1000;  // of one name; what each says is printed

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

std::optional<std::size_t> index_of(const toml::node& node, const Words& words) {
  const auto* text = node.as_string();
  const auto found = text == nullptr ? words.end() : std::find(words.begin(), words.end(), text->get());
  if (found == words.end()) return {};
  return static_cast<std::size_t>(found - words.begin());
}

std::string schema_of(const Range& range) {
  return fmt::format(R"("type": "number", "{}inimum": {:g}, "maximum": {:g})",
                     range.least_excluded ? "exclusiveM" : "m", range.least, range.most);
}

std::string quoted(const Words& words) {
  return fmt::format("\"{}\"", fmt::join(words, "\", \""));
}

std::string shortened(const std::string& text) {
  std::size_t length = 60;
  if (text.size() <= length) return text;
  while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U)
    --length;  // no letter is cut in two
  return text.substr(0, length) + " ...";
}

// A node as it would be written, shortened.
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
  return shortened(text);
}

// What a comma between decimals makes of a number, or of a list of them.
std::string_view slip_in(const toml::node& node, std::string_view allowed) {
  static const std::regex number("[-+]?[0-9]+,[0-9]+");
  const toml::array* list = node.as_array();
  const auto* text = node.as_string();
  const bool slip = list != nullptr ? allowed.starts_with("a list of") && list->size() > 3 && list->front().is_number()
                    : text != nullptr ? text->get().size() < 32 && std::regex_match(text->get(), number)
                                      : false;
  return slip ? "; decimals follow a point, not a comma" : "";
}

}  // namespace

std::string location(const toml::source_region& source) {
  const std::string name = source.path ? *source.path : std::string("script");
  if (name.starts_with("--set")) return name + ": ";
  return fmt::format("{}:{}:{}: ", name, source.begin.line, source.begin.column);
}

std::string TableReader::full_key(std::string_view key) const {
  return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
}

const Key& TableReader::declared(std::string_view key) const {
  return *std::find_if(keys_.begin(), keys_.end(), [key](const Key& k) { return k.name == key; });
}

void TableReader::fail(const toml::node& at, std::string_view key, std::string_view allowed) const {
  throw std::invalid_argument(fmt::format("{}{}: found {}; allowed: {}{}", location(at.source()), full_key(key),
                                          shown(at), allowed, slip_in(at, allowed)));
}

void TableReader::fail(std::string_view key, std::string_view allowed) const {
  fail(*table_->get(key), key, allowed.empty() ? declared(key).allowed : allowed);
}

void TableReader::fail_word(const toml::node& at, std::string_view key, const Words& words, std::string allowed) const {
  const auto* text = at.as_string();
  const std::vector<std::string> known(words.begin(), words.end());
  const auto near = text == nullptr ? std::nullopt : near_match(text->get(), known);
  if (near) allowed += fmt::format("; did you mean \"{}\"?", *near);
  fail(at, key, allowed);
}

void TableReader::fail_missing(std::string_view key, std::string_view allowed) const {
  throw std::invalid_argument(
      fmt::format("{}{}: is missing; allowed: {}", location(table_->source()), full_key(key), allowed));
}

const toml::node* TableReader::declare(Key key) {
  keys_.push_back(std::move(key));
  return table_->get(keys_.back().name);
}

void TableReader::need(std::string_view key) {
  for (Key& k : keys_) {
    if (k.name != key) continue;
    k.needed = true;
    if (!has(key)) fail_missing(key, k.allowed);
  }
}

void TableReader::read(std::string_view key, std::string& value, const char* meaning) {
  const toml::node* found = declare({std::string(key), meaning, "a text in quotes", R"("type": "string")"});
  if (found == nullptr) return;
  if (!found->is_string()) fail(key);
  value = found->as_string()->get();
}

void TableReader::read(std::string_view key, bool& value, const char* meaning) {
  const toml::node* found =
      declare({std::string(key), meaning, "true or false", R"("type": "boolean")", value ? "true" : "false"});
  if (found == nullptr) return;
  if (!found->is_boolean()) fail(key);
  value = found->as_boolean()->get();
}

void TableReader::read(std::string_view key, int& value, int least, int most, const char* meaning) {
  std::optional<int> number;
  read(key, number, least, most, meaning);
  keys_.back().otherwise = std::to_string(value);
  value = number.value_or(value);
}

void TableReader::read(std::string_view key, std::optional<int>& value, int least, int most, const char* meaning) {
  const toml::node* found =
      declare({std::string(key), meaning, fmt::format("a whole number from {} to {}", least, most),
               fmt::format(R"("type": "integer", "minimum": {}, "maximum": {})", least, most)});
  if (found == nullptr) return;
  const bool fits = found->is_integer() && found->as_integer()->get() >= least && found->as_integer()->get() <= most;
  if (!fits) fail(key);
  value = static_cast<int>(found->as_integer()->get());
}

void TableReader::read(std::string_view key, double& value, Range range, const char* meaning) {
  std::optional<double> number;
  read(key, number, range, meaning);
  keys_.back().otherwise = fmt::format("{}", value);
  value = number.value_or(value);
}

void TableReader::read(std::string_view key, std::optional<double>& value, Range range, const char* meaning) {
  const toml::node* found = declare({std::string(key), meaning, text_of(range), schema_of(range)});
  if (found == nullptr) return;
  value = number_in(*found, range);
  if (!value) fail(key);
}

void TableReader::read(std::string_view key, Eigen::Vector3d& value, Range each, const char* meaning) {
  const std::string otherwise = fmt::format("[{}, {}, {}]", value.x(), value.y(), value.z());
  read(key, std::span(value.data(), 3), "x, y, z", each, meaning);
  keys_.back().otherwise = otherwise;
}

bool TableReader::read(std::string_view key, std::span<double> values, const char* names, Range each,
                       const char* meaning) {
  const std::size_t n = values.size();
  const toml::node* found = declare(
      {std::string(key), meaning,
       fmt::format("a list of {} numbers [{}], each {}", n == 3 ? "three" : "four", names, text_of(each)),
       fmt::format(R"("type": "array", "items": {{{}}}, "minItems": {}, "maxItems": {})", schema_of(each), n, n)});
  if (found == nullptr) return false;
  const toml::array* list = found->as_array();
  if (list == nullptr || list->size() != n) fail(key);
  for (std::size_t i = 0; i < n; ++i) {
    const std::optional<double> number = number_in((*list)[i], each);
    if (!number) fail(key);
    values[i] = *number;
  }
  return true;
}

std::size_t TableReader::read_word(std::string_view key, const Words& words, const char* meaning, const char* manual) {
  const toml::node* found = declare({std::string(key), meaning, "one of " + quoted(words),
                                     fmt::format(R"("enum": [{}])", quoted(words)), quoted({words.front()}), manual});
  if (found == nullptr) return 0;
  const std::optional<std::size_t> i = index_of(*found, words);
  if (!i) fail_word(*found, key, words, declared(key).allowed);
  return *i;
}

std::vector<std::size_t> TableReader::read_words(std::string_view key, const Words& words, const char* meaning,
                                                 const char* manual) {
  std::vector<std::size_t> indices;
  const toml::node* found =
      declare({std::string(key), meaning, "a list of " + quoted(words),
               fmt::format(R"("type": "array", "items": {{"enum": [{}]}})", quoted(words)), "[]", manual});
  if (found == nullptr) return indices;
  if (!found->is_array()) fail(key);
  for (const toml::node& entry : *found->as_array()) {
    const std::optional<std::size_t> i = index_of(entry, words);
    if (!i) fail_word(entry, key, words, declared(key).allowed);
    indices.push_back(*i);
  }
  return indices;
}

std::vector<TableReader> TableReader::table(std::string_view key, const char* meaning) {
  const toml::node* found = declare(
      {std::string(key), meaning, fmt::format("a table [{}]", key), fmt::format(R"("$ref": "#/$defs/{}")", key)});
  if (found == nullptr) return {};
  if (!found->is_table()) fail(key);
  TableReader reader(*found->as_table(), record_);
  reader.path_ = key;
  return {reader};
}

std::vector<TableReader> TableReader::tables(std::string_view key, const char* meaning) {
  const toml::node* found =
      declare({std::string(key), meaning, fmt::format("one or more tables [[{}]]", key),
               fmt::format(R"("type": "array", "minItems": 1, "maxItems": {}, "items": {{"$ref": "#/$defs/{}"}})",
                           most_tables, key)});
  if (found == nullptr) return {};
  const toml::array* list = found->as_array();
  if (list == nullptr || list->empty()) fail(key);
  if (list->size() > most_tables)
    fail(key, fmt::format("up to {} tables [[{}]], not {}", most_tables, key, list->size()));
  std::vector<TableReader> readers;
  for (const toml::node& one : *list) {
    const std::string path = fmt::format("{}.{}", key, readers.size());
    if (!one.is_table()) fail(one, path, fmt::format("a table [[{}]]", key));
    readers.emplace_back(*one.as_table(), record_).path_ = path;
  }
  return readers;
}

void TableReader::done() const {
  for (const auto& [key, value] : *table_) {
    std::vector<std::string> known;
    for (const Key& k : keys_) known.push_back(k.name);
    if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
    throw std::invalid_argument(fmt::format("{}{}: unknown key; {}", location(key.source()),
                                            full_key(shortened(std::string(key.str()))),
                                            did_you_mean(key.str(), known)));
  }
  if (record_ == nullptr) return;
  const std::string name = path_.substr(0, path_.find('.'));
  if (std::none_of(record_->begin(), record_->end(), [&](const KeyTable& t) { return t.name == name; })) {
    record_->push_back({name, keys_});
  }
}

}  // namespace bookspin
