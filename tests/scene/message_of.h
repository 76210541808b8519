// What a bad script is answered with.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_file.h"

namespace bookspin {

inline std::string message_of(std::string_view text, const std::vector<std::string>& overrides) {
  try {
    (void)parse_scene(text, "s.toml", overrides);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace bookspin
