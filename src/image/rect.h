// A rectangle of whole pixels: x runs right, y runs down.
#pragma once

#include <algorithm>

namespace bookspin {

struct Rect {
  int x = 0;       // left column, pixels
  int y = 0;       // top row, pixels
  int width = 0;   // pixels; 0: empty
  int height = 0;  // pixels; 0: empty

  [[nodiscard]] bool empty() const { return width <= 0 || height <= 0; }
  bool operator==(const Rect&) const = default;
};

// Empty, at (0, 0), when they do not meet.
[[nodiscard]] inline Rect intersection(const Rect& a, const Rect& b) {
  const int x0 = std::max(a.x, b.x);
  const int y0 = std::max(a.y, b.y);
  const int x1 = std::min(a.x + a.width, b.x + b.width);
  const int y1 = std::min(a.y + a.height, b.y + b.height);
  return x1 > x0 && y1 > y0 ? Rect{x0, y0, x1 - x0, y1 - y0} : Rect{};
}

// The smallest rectangle that holds both.
[[nodiscard]] inline Rect union_of(const Rect& a, const Rect& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  const int x0 = std::min(a.x, b.x);
  const int y0 = std::min(a.y, b.y);
  return {x0, y0, std::max(a.x + a.width, b.x + b.width) - x0, std::max(a.y + a.height, b.y + b.height) - y0};
}

}  // namespace bookspin
