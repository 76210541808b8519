#include "image/compare.h"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace bookspin {
namespace {

int pixel_delta(const Image& a, const Image& b, std::size_t byte) {
  int delta = 0;
  for (std::size_t i = byte; i < byte + 4; ++i) delta = std::max(delta, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  return delta;
}

}  // namespace

ImageDelta compare(const Image& a, const Image& b, int threshold) {
  ImageDelta result;
  result.same_size = a.width == b.width && a.height == b.height;
  if (!result.same_size || a.rgba.empty()) return result;

  std::size_t above = 0;
  std::size_t sum = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    const int delta = pixel_delta(a, b, i);
    result.max_delta = std::max(result.max_delta, delta);
    sum += static_cast<std::size_t>(delta);
    above += delta > threshold ? 1 : 0;
  }
  const std::size_t pixel_count = a.rgba.size() / 4;
  const auto pixels = static_cast<double>(pixel_count);
  result.mean_delta = static_cast<double>(sum) / pixels;
  result.share_above = static_cast<double>(above) / pixels;
  return result;
}

Image delta_picture(const Image& a, const Image& b) {
  assert(a.width == b.width && a.height == b.height);
  Image picture(a.width, a.height);
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    const int grey = (a.rgba[i] + 2 * a.rgba[i + 1] + a.rgba[i + 2]) / 16;
    const int delta = pixel_delta(a, b, i);
    // A difference of one level must be as visible as one of a hundred, and yet look smaller.
    const int red = delta == 0 ? grey : 128 + delta / 2;
    picture.rgba[i] = static_cast<std::uint8_t>(red);
    picture.rgba[i + 1] = static_cast<std::uint8_t>(grey);
    picture.rgba[i + 2] = static_cast<std::uint8_t>(grey);
    picture.rgba[i + 3] = 255;
  }
  return picture;
}

}  // namespace bookspin
