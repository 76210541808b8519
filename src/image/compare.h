// How far two pictures are apart: data, not an error.
//
// The delta of a pixel is the largest of its four channels' absolute differences, in 8-bit levels.
#pragma once

#include <cstddef>
#include <string>

#include "image/image.h"

namespace bookspin {

struct ImageDelta {
  bool same_size = false;  // if not, nothing below is meaningful
  int max_delta = 0;       // largest delta of a pixel, 0 ... 255
  double mean_delta = 0;   // mean delta of a pixel
  double share_above = 0;  // share of pixels whose delta exceeds the threshold, 0 ... 1
};

[[nodiscard]] ImageDelta compare(const Image& a, const Image& b, int threshold);

// A table of the pixels that differ most, the worst first, at most `count` lines: x, y, delta, and both colors. Empty
// when nothing differs. The pictures must be of one size.
[[nodiscard]] std::string worst_pixels(const Image& a, const Image& b, std::size_t count);

// What differs, to be looked at: a in faint gray, and over it in red every pixel that differs, never fainter than half.
// The pictures must be of one size.
[[nodiscard]] Image delta_picture(const Image& a, const Image& b);

}  // namespace bookspin
