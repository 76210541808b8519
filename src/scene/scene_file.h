// Scene scripts: TOML -> Scene.
//
// Every key is checked: an unknown one, a wrong type or a value out of range throws std::invalid_argument with
// "file:line:column: key: what was found; what is allowed". A script that cannot be read throws std::runtime_error.
// Overrides are written "book.0.method=matrix": dotted keys, books and expectations by index, the value in TOML or a
// bare word.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bookspin {

[[nodiscard]] Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {});

// The same from text; `name` stands for the file in messages.
[[nodiscard]] Scene parse_scene(std::string_view text, const std::string& name,
                                std::span<const std::string> overrides = {});

// Every key that a script may hold, as the reader declares them: the root's first.
[[nodiscard]] std::vector<struct KeyTable> script_keys();

// What a script may say, and hardly means: "book.0: does not turn: ...".
[[nodiscard]] std::vector<std::string> remarks_on(const Scene& scene);

}  // namespace bookspin
