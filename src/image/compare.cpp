#include "image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstdlib>
#include <vector>

namespace bookspin {
namespace {

int pixel_delta(const Image& a, const Image& b, std::size_t byte) {
  int delta = 0;
  for (std::size_t i = byte; i < byte + 4; ++i) delta = std::max(delta, std::abs(int{a.rgba[i]} - int{b.rgba[i]}));
  return delta;
}

std::string color_text(const Image& image, std::size_t byte) {
  return fmt::format("{:3} {:3} {:3} {:3}", image.rgba[byte], image.rgba[byte + 1], image.rgba[byte + 2],
                     image.rgba[byte + 3]);
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

std::string worst_pixels(const Image& a, const Image& b, std::size_t count) {
  assert(a.width == b.width && a.height == b.height);
  std::vector<std::size_t> bytes;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    if (pixel_delta(a, b, i) > 0) bytes.push_back(i);
  }
  if (bytes.empty()) return "";
  const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(count, bytes.size()));
  std::partial_sort(bytes.begin(), end, bytes.end(), [&](std::size_t i, std::size_t j) {
    return std::pair(-pixel_delta(a, b, i), i) < std::pair(-pixel_delta(a, b, j), j);
  });
  std::string text = "     x     y  delta  red green blue alpha, first and second\n";
  const auto width = static_cast<std::size_t>(a.width);
  for (auto byte = bytes.begin(); byte != end; ++byte) {
    text += fmt::format("{:6}{:6}{:7}  {}   {}\n", *byte / 4 % width, *byte / 4 / width, pixel_delta(a, b, *byte),
                        color_text(a, *byte), color_text(b, *byte));
  }
  return text;
}

Image delta_picture(const Image& a, const Image& b) {
  assert(a.width == b.width && a.height == b.height);
  Image picture(a.width, a.height);
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    const int gray = (a.rgba[i] + 2 * a.rgba[i + 1] + a.rgba[i + 2]) / 16;
    const int delta = pixel_delta(a, b, i);
    // A difference of one level must be as visible as one of a hundred, and yet look smaller.
    const int red = delta == 0 ? gray : 128 + delta / 2;
    picture.rgba[i] = static_cast<std::uint8_t>(red);
    picture.rgba[i + 1] = static_cast<std::uint8_t>(gray);
    picture.rgba[i + 2] = static_cast<std::uint8_t>(gray);
    picture.rgba[i + 3] = 255;
  }
  return picture;
}

}  // namespace bookspin
