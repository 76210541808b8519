// A color as OpenGL wants it: the sRGB levels divided by 255, not linearized (book.frag says why).
#pragma once

#include <array>

#include "render/shot.h"

namespace bookspin {

inline std::array<float, 4> gl_color(const Color& color) {
  const auto channel = [](std::uint8_t level) { return static_cast<float>(level) / 255.0F; };
  return {channel(color.r), channel(color.g), channel(color.b), channel(color.a)};
}

}  // namespace bookspin
