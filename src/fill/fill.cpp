#include "fill/fill.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace bookspin {
namespace {

using Json = nlohmann::json;
using Stack = std::vector<const Json*>;

struct Template {
  std::string_view text;
  const std::string& file;

  [[noreturn]] void fail(std::size_t at, const std::string& what) const {
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(at, text.size())), '\n');
    throw std::runtime_error(fmt::format("{}:{}: {}", file, line, what));
  }
};

const Json* descend(const Json* from, std::string_view path) {
  while (from != nullptr && !path.empty()) {
    const std::size_t dot = path.find('.');
    const std::string key(path.substr(0, dot));
    path = dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1);
    from = from->is_object() && from->contains(key) ? &(*from)[key] : nullptr;
  }
  return from;
}

const Json* look_up(const Stack& stack, std::string_view path) {
  if (path == ".") return stack.back();
  for (std::size_t level = stack.size(); level-- > 0;) {
    if (const Json* found = descend(stack[level], path)) return found;
  }
  return nullptr;
}

bool shows(const Json* value) {
  if (value == nullptr || value->is_null()) return false;
  if (value->is_boolean()) return value->get<bool>();
  if (value->is_string()) return !value->get_ref<const std::string&>().empty();
  return value->is_number() || !value->empty();
}

std::string as_text(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// Fills from `at` to the end of the section, and returns where what follows it begins. Without `out` it only finds that
// place.
std::size_t fill_section(const Template& source, std::size_t at, std::string_view section, Stack& stack,
                         std::string* out) {
  while (true) {
    const std::size_t open = source.text.find("{{", at);
    if (out != nullptr) out->append(source.text.substr(at, open - at));
    const std::size_t before = at;
    if (open == std::string_view::npos) {
      if (!section.empty()) source.fail(at, fmt::format("{{{{/{}}}}} is missing", section));
      return source.text.size();
    }
    const bool raw = source.text.substr(open).starts_with("{{{");
    const std::string_view ending = raw ? "}}}" : "}}";
    const std::size_t close = source.text.find(ending, open);
    if (close == std::string_view::npos) source.fail(open, "a tag does not end");
    std::string_view tag = trimmed(source.text.substr(open + ending.size(), close - open - ending.size()));
    at = close + ending.size();
    const char kind = raw || tag.empty() ? '\0' : tag.front();
    if (kind == '/' || kind == '#' || kind == '^') {
      tag = trimmed(tag.substr(1));
      // A section's tag that has a line to itself leaves no line behind.
      const std::size_t line = open == 0 ? 0 : source.text.rfind('\n', open - 1) + 1;  // npos + 1 is 0
      const std::size_t end_of_line = std::min(source.text.find('\n', at), source.text.size() - 1);
      if (line >= before && trimmed(source.text.substr(line, open - line)).empty() &&
          source.text[end_of_line] == '\n' && trimmed(source.text.substr(at, end_of_line - at)).empty()) {
        if (out != nullptr) out->resize(out->size() - (open - line));
        at = end_of_line + 1;
      }
    }
    if (kind == '/') {
      if (tag != section) source.fail(open, fmt::format("{{{{/{}}}}} does not close {{{{#{}}}}}", tag, section));
      return at;
    }
    if (kind != '#' && kind != '^') {
      if (out == nullptr) continue;
      const Json* value = look_up(stack, tag);
      if (value == nullptr) source.fail(open, fmt::format("nothing is known as '{}'", tag));
      out->append(raw ? as_text(*value) : escape_html(as_text(*value)));
      continue;
    }
    const Json* value = out == nullptr ? nullptr : look_up(stack, tag);
    std::size_t end = at;
    if (kind == '#' && shows(value) && value->is_array()) {
      for (const Json& entry : *value) {
        stack.push_back(&entry);
        end = fill_section(source, at, tag, stack, out);
        stack.pop_back();
      }
    } else if (out != nullptr && shows(value) == (kind == '#')) {
      if (kind == '#') stack.push_back(value);
      end = fill_section(source, at, tag, stack, out);
      if (kind == '#') stack.pop_back();
    } else {
      end = fill_section(source, at, tag, stack, nullptr);
    }
    at = end;
  }
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string fill(std::string_view text, const nlohmann::json& data, const std::string& file) {
  std::string out;
  Stack stack{&data};
  fill_section({text, file}, 0, {}, stack, &out);
  return out;
}

}  // namespace bookspin
