// sRGB to linear light (IEC 61966-2-1), for colours that go to a shader.
#pragma once

#include <array>
#include <cmath>

#include "render/shot.h"

namespace bookspin {

inline float linear_channel(std::uint8_t level) {
  const double x = level / 255.0;
  return static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
}

inline std::array<float, 4> linear(const Color& color) {
  return {linear_channel(color.r), linear_channel(color.g), linear_channel(color.b), static_cast<float>(color.a / 255.0)};
}

}  // namespace bookspin
