#include "image/halved.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace bookspin {

Image halved(const Image& image) {
  constexpr int steps = 4095;  // of linear light: two to a level where the levels lie closest, near black
  static const auto linear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double level = static_cast<double>(i) / 255;
      table[i] = static_cast<float>(level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4));
    }
    return table;
  }();
  static const auto encoded = [] {
    std::array<std::uint8_t, steps + 1> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double light = static_cast<double>(i) / steps;
      const double level = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
      table[i] = static_cast<std::uint8_t>(std::lround(255 * level));
    }
    return table;
  }();
  Image half(std::max(1, image.width / 2), std::max(1, image.height / 2));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const int x1 = std::min(2 * x + 1, image.width - 1), y1 = std::min(2 * y + 1, image.height - 1);
      const std::array four{image.pixel(2 * x, 2 * y), image.pixel(x1, 2 * y), image.pixel(2 * x, y1),
                            image.pixel(x1, y1)};
      for (std::size_t c = 0; c < 3; ++c) {
        const float light = linear[four[0][c]] + linear[four[1][c]] + linear[four[2][c]] + linear[four[3][c]];
        // NOLINTNEXTLINE(bugprone-incorrect-roundings): light is never negative
        half.pixel(x, y)[c] = encoded[static_cast<std::size_t>(light * (steps / 4.0F) + 0.5F)];
      }
      half.pixel(x, y)[3] = 255;
    }
  }
  return half;
}

}  // namespace bookspin
