#include "video/palette.h"

#include <algorithm>
#include <array>

namespace bookspin {
namespace {

constexpr std::size_t most_frequent = 190;
constexpr std::array levels{0U, 85U, 170U, 255U};

std::size_t bin_of(const std::uint8_t* rgba) {
  return static_cast<std::size_t>(rgba[0] >> 3 << 10 | rgba[1] >> 3 << 5 | rgba[2] >> 3);
}

std::uint32_t argb_of(std::uint64_t r, std::uint64_t g, std::uint64_t b) {
  return static_cast<std::uint32_t>(0xff000000U | r << 16U | g << 8U | b);
}

int squared_distance(std::uint32_t argb, const std::uint8_t* rgba) {
  int sum = 0;
  for (unsigned c = 0; c < 3; ++c) {
    const int d = static_cast<int>(argb >> (16U - 8U * c) & 0xffU) - rgba[c];
    sum += d * d;
  }
  return sum;
}

}  // namespace

void Palette::sample(const Image& picture) {
  for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
    Sum& sum = sums_[bin_of(&picture.rgba[i])];
    ++sum.count;
    sum.r += picture.rgba[i];
    sum.g += picture.rgba[i + 1];
    sum.b += picture.rgba[i + 2];
  }
}

void Palette::choose() {
  std::stable_sort(sums_.begin(), sums_.end(), [](const Sum& a, const Sum& b) { return a.count > b.count; });
  for (std::size_t i = 0; i < most_frequent && sums_[i].count > 0; ++i) {
    const auto [n, r, g, b] = sums_[i];
    argb_.push_back(argb_of((r + n / 2) / n, (g + n / 2) / n, (b + n / 2) / n));
  }
  for (const unsigned r : levels) {
    for (const unsigned g : levels) {
      for (const unsigned b : levels) argb_.push_back(argb_of(r, g, b));
    }
  }
  opaque_ = static_cast<std::ptrdiff_t>(argb_.size());
  argb_.resize(256, 0);
  nearest_.assign(bins, -1);
}

void Palette::convert(const Image& image, const Rect& area, std::uint8_t* indices, std::ptrdiff_t stride) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    for (int x = area.x; x < area.x + area.width; ++x) {
      const std::uint8_t* pixel = image.pixel(x, y);
      std::int16_t& nearest = nearest_[bin_of(pixel)];
      if (nearest < 0) {
        const auto closer = [pixel](std::uint32_t a, std::uint32_t b) {
          return squared_distance(a, pixel) < squared_distance(b, pixel);
        };
        nearest =
            static_cast<std::int16_t>(std::min_element(argb_.begin(), argb_.begin() + opaque_, closer) - argb_.begin());
      }
      indices[y * stride + x] = static_cast<std::uint8_t>(nearest);
    }
  }
}

}  // namespace bookspin
