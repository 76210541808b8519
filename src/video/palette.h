// The 256 colors of a GIF: those that fill most of some sample pictures, and the 64 of four levels a channel.
// No dither: plain areas stay plain, and the file small.
//
// Colors are told apart by five bits a channel. Nothing throws but std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "image/image.h"

namespace bookspin {

class Palette {
 public:
  Palette() : sums_(bins) {}

  void sample(const Image& picture);
  void choose();  // after the samples, before the rest

  // 256; those after the opaque ones are transparent, by which the encoder says "as before".
  [[nodiscard]] const std::vector<std::uint32_t>& argb() const { return argb_; }

  // The nearest color's index for every pixel inside `area`, which lies inside the image. `stride`: bytes from row to
  // row.
  void convert(const Image& image, const Rect& area, std::uint8_t* indices, std::ptrdiff_t stride);

 private:
  static constexpr std::size_t bins = 1U << 15U;
  struct Sum {
    std::uint64_t count = 0, r = 0, g = 0, b = 0;
  };

  std::vector<Sum> sums_;  // of the samples, by five bits a channel
  std::vector<std::uint32_t> argb_;
  std::ptrdiff_t opaque_ = 0;
  std::vector<std::int16_t> nearest_;  // in the same order; -1: not yet known
};

}  // namespace bookspin
