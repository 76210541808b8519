// TOML text to tables, and the --set overrides that change them.
//
// Both throw std::invalid_argument that says where: "file:line:column: ...", or "--set KEY=VALUE: ...".
#pragma once

#include <string>
#include <string_view>

#include "scene/toml.h"

namespace bookspin {

[[nodiscard]] toml::table parse_toml(std::string_view text, const std::string& name);

// "book.0.method=matrix": scene["book"][0]["method"] = "matrix". The value is TOML, or a bare word.
void apply_override(toml::table& scene, const std::string& text);

}  // namespace bookspin
