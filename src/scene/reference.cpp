#include "scene/reference.h"

#include <fmt/format.h>

#include <sstream>

#include "scene/any_book.h"
#include "scene/scene_file.h"
#include "scene/table_reader.h"

namespace bookspin {
namespace {

constexpr std::size_t width = 110;  // columns

// A paragraph broken into lines; those after the first are indented.
std::string wrapped(const std::string& text, const std::string& indent) {
  std::string result;
  std::size_t column = 0;
  std::istringstream words(text);
  for (std::string word; words >> word; column += word.size()) {
    if (column > 0 && column + 1 + word.size() > width) {
      result += "\n" + indent;
      column = indent.size();
    } else if (column > 0) {
      result += ' ';
      ++column;
    }
    result += word;
  }
  return result + "\n";
}

std::string item(std::string_view name, const std::string& text) {
  return wrapped(fmt::format("- `{}`{}", name, text), "  ");
}

std::string text_of(const Key& key) {
  const std::string otherwise = key.needed              ? " (needed)"
                                : key.otherwise.empty() ? ""
                                                        : fmt::format(" (default {})", key.otherwise);
  return fmt::format("{}: {}. Allowed: {}.", otherwise, key.meaning, key.manual.empty() ? key.allowed : key.manual);
}

bool is_table(const Key& key) {
  return key.schema.find("$ref") != std::string::npos;
}

// "springs without damping, quaternion".
std::string methods_of(const IntegratorInfo& integrator) {
  std::string methods;
  for (const Method method : {Method::springs, Method::matrix, Method::quaternion}) {
    if (!takes(method, false, integrator)) continue;
    methods += methods.empty() ? "" : ", ";
    methods += name_of(method);
    if (method == Method::springs && !takes(method, true, integrator)) methods += " without damping";
  }
  return methods;
}

std::string object_schema(const KeyTable& table) {
  std::string properties;
  std::string needed;
  for (const Key& key : table.keys) {
    properties += fmt::format("{}\n    \"{}\": {{{}", properties.empty() ? "" : ",", key.name, key.schema);
    if (!key.needed && !key.otherwise.empty()) properties += fmt::format(", \"default\": {}", key.otherwise);
    properties += fmt::format(R"(, "description": "{}"}})", key.meaning);
    if (key.needed) needed += fmt::format("{}\"{}\"", needed.empty() ? "" : ", ", key.name);
  }
  return fmt::format(
      "  \"type\": \"object\", \"additionalProperties\": false, \"required\": [{}],\n  \"properties\": {{{}\n  }}",
      needed, properties);
}

}  // namespace

std::string script_manual() {
  const std::vector<KeyTable> tables = script_keys();
  std::string manual =
      "# Scene scripts: every key\n\n" +
      wrapped(
          "A script is a TOML file: one film, or a still picture when it has one frame. Lengths, times "
          "and masses are in the scene's own units. A key that is not here, a wrong type or a value out "
          "of range is an error that names the line. `bookspin help scene` prints this text, `bookspin "
          "schema` a JSON schema for editors.",
          "");
  for (const KeyTable& table : tables) {
    for (const Key& key : tables.front().keys) {
      if (key.name != table.name) continue;
      manual += fmt::format("\n## `{}`: {}\n", key.allowed.substr(key.allowed.find('[')), key.meaning);
    }
    manual += '\n';
    for (const Key& key : table.keys) {
      if (!is_table(key)) manual += item(key.name, text_of(key));
    }
  }
  manual += "\n## Integrators: `book.integrator`\n\n";
  for (const IntegratorInfo& integrator : integrators) {
    const std::string order = integrator.order == all_orders ? "the motion itself, but for rounding"
                                                             : fmt::format("order {}", integrator.order);
    manual += item(integrator.name, fmt::format(": {}; for {}", order, methods_of(integrator)));
  }
  manual += "\n## Overlays: `book.show`\n\n";
  for (const OverlayInfo& overlay : overlay_table) manual += item(overlay.name, fmt::format(": {}", overlay.meaning));
  manual += "\n## Quantities: `view.head_up`, `expect.quantity`\n\n";
  for (const Quantity& q : quantities) {
    manual += item(q.name, fmt::format("{}: {}", q.unit.empty() ? "" : fmt::format(", {}", q.unit), q.meaning));
  }
  return manual + "\n" +
         wrapped(
             "A film's data, `NAME.json`, hold all of them for every frame, to seven digits; `bookspin trajectory` "
             "writes "
             "them as CSV to the last one, with corners, q, L and omega.",
             "");
}

std::string script_schema() {
  const std::vector<KeyTable> tables = script_keys();
  std::string definitions;
  for (std::size_t i = 1; i < tables.size(); ++i) {
    definitions += fmt::format("{}\n\"{}\": {{\n{}}}", i == 1 ? "" : ",", tables[i].name, object_schema(tables[i]));
  }
  return fmt::format(
      "{{\n  \"$schema\": \"http://json-schema.org/draft-07/schema#\",\n  \"title\": \"bookspin scene script\",\n{},\n"
      "  \"$defs\": {{{}\n}}}}\n",
      object_schema(tables.front()), definitions);
}

}  // namespace bookspin
