// A picture in memory.
//
// Pixels are RGBA, 8 bits a channel, sRGB, rows from top to bottom, tightly packed: pixel (x, y) starts at byte
// 4 (y width + x). x runs right, y runs down, both from 0.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/rect.h"

namespace bookspin {

struct Image {
  int width = 0;                   // pixels
  int height = 0;                  // pixels
  std::vector<std::uint8_t> rgba;  // 4 width height bytes

  Image() = default;
  Image(int width_, int height_)
      : width(width_),
        height(height_),
        rgba(4 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}
  // Where in rgba the four bytes of pixel (x, y) start, and the first of them.
  [[nodiscard]] std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
  [[nodiscard]] std::uint8_t* pixel(int x, int y) { return rgba.data() + offset(x, y); }
  [[nodiscard]] const std::uint8_t* pixel(int x, int y) const { return rgba.data() + offset(x, y); }
  [[nodiscard]] Rect bounds() const { return {0, 0, width, height}; }
};

}  // namespace bookspin
