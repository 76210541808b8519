// What a command will take of memory and time: refused, or said, before it begins.
#pragma once

#include <optional>
#include <string>

#include "scene/scene.h"

namespace bookspin {

struct Drawing {
  int frames = 0;
  int width = 0;   // pixels
  int height = 0;  // pixels
};

// Throws std::runtime_error when the address space (ulimit -v) has no room to draw: Mesa does not survive when it ends.
void require_room(int width, int height);

// "900 frames of 1280x720, 15.0 s long; 27000 steps; about 2 min to make", of a scene that is simulated and perhaps
// drawn; nothing when that takes less than a minute.
[[nodiscard]] std::string announcement(const Scene& scene, const std::optional<Drawing>& drawing = {});

}  // namespace bookspin
