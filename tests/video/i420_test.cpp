#include "video/i420.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "video/test_pictures.h"

namespace bookspin {
namespace {

std::size_t index(int width, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

struct Planes {
  int width;
  std::vector<std::uint8_t> y, cb, cr;

  Planes(int w, int h)
      : width(w), y(static_cast<std::size_t>(w * h)), cb(static_cast<std::size_t>(w * h / 4)), cr(cb.size()) {}
  I420Planes view() { return {y.data(), cb.data(), cr.data(), width, width / 2, width / 2}; }
  bool operator==(const Planes&) const = default;
};

struct Color {
  double y, cb, cr;
};

// BT.709-6, 3.2 to 3.5, written straight down: from R', G', B' in 0 ... 255 to unrounded limited-range levels.
Color bt709(double r, double g, double b) {
  const double luma = 0.2126 * r / 255 + 0.7152 * g / 255 + 0.0722 * b / 255;
  return {16 + 219 * luma, 128 + 224 * (b / 255 - luma) / 1.8556, 128 + 224 * (r / 255 - luma) / 1.5748};
}

double error_of(std::uint8_t got, double exact) {
  return std::abs(got - exact);
}

TEST(I420, EveryColorIsTheRoundedFormula) {
  // Blocks of four equal pixels: the second chroma sample of each sees one color only.
  Image image(4 * 256, 2);
  Planes planes(image.width, image.height);
  double worst = 0;
  std::int64_t other_rounding = 0;
  for (int r = 0; r < 256; ++r) {
    for (int g = 0; g < 256; ++g) {
      for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        image.rgba[i] = static_cast<std::uint8_t>(r);
        image.rgba[i + 1] = static_cast<std::uint8_t>(g);
        image.rgba[i + 2] = static_cast<std::uint8_t>(i / 16);
      }
      convert_to_i420(image, image.bounds(), planes.view());
      for (std::size_t b = 0; b < 256; ++b) {
        const Color exact = bt709(r, g, static_cast<double>(b));
        const std::array<std::uint8_t, 3> got{planes.y[4 * b + 1], planes.cb[2 * b + 1], planes.cr[2 * b + 1]};
        const std::array<double, 3> wanted{exact.y, exact.cb, exact.cr};
        for (std::size_t i = 0; i < 3; ++i) {
          worst = std::max(worst, error_of(got[i], wanted[i]));
          other_rounding += got[i] != std::lround(wanted[i]) ? 1 : 0;
        }
      }
    }
  }
  EXPECT_LE(worst, 0.503);                                                         // measured 0.50201
  EXPECT_LE(static_cast<double>(other_rounding) / (3 * 256.0 * 256 * 256), 1e-3);  // measured 5.8e-4
}

TEST(I420, ChromaIsSitedLeftAndBetweenTheRows) {
  std::mt19937 generator(1);
  double worst = 0;
  for (const auto& [width, height] : {std::pair{2, 2}, {4, 2}, {2, 6}, {34, 18}, {70, 4}}) {
    const Image image = random_picture(width, height, generator);
    Planes planes(width, height);
    convert_to_i420(image, image.bounds(), planes.view());
    const auto channel = [&, w = width](int x, int y, std::size_t i) {
      return static_cast<double>(image.rgba[4 * index(w, std::max(x, 0), y) + i]);
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const Color exact = bt709(channel(x, y, 0), channel(x, y, 1), channel(x, y, 2));
        worst = std::max(worst, error_of(planes.y[index(width, x, y)], exact.y));
        if (x % 2 != 0 || y % 2 != 0) continue;
        const auto mean = [&](std::size_t i) {
          double sum = 0;
          for (const int row : {y, y + 1}) {
            sum += channel(x - 1, row, i) + 2 * channel(x, row, i) + channel(x + 1, row, i);
          }
          return sum / 8;
        };
        const Color sample = bt709(mean(0), mean(1), mean(2));
        const auto at = index(width / 2, x / 2, y / 2);
        worst = std::max({worst, error_of(planes.cb[at], sample.cb), error_of(planes.cr[at], sample.cr)});
      }
    }
  }
  EXPECT_LE(worst, 0.503);  // measured 0.50022; against the plain mean of 2x2 pixels: 36
}

// Every rectangle of a small picture: converting only what changed leaves the planes of a whole conversion.
TEST(I420, ChangedRectangleGivesTheWholePicture) {
  constexpr int width = 12;
  constexpr int height = 6;
  std::mt19937 generator(2);
  const Image before = random_picture(width, height, generator);
  Planes start(width, height);
  convert_to_i420(before, before.bounds(), start.view());
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      for (int w = 0; w <= width - x; ++w) {
        for (int h = 0; h <= height - y; ++h) {
          Image after = before;
          for (int row = y; row < y + h; ++row) {
            for (std::size_t byte = 4 * index(width, x, row); byte < 4 * index(width, x + w, row); ++byte) {
              after.rgba[byte] ^= 0xff;
            }
          }
          Planes whole(width, height);
          convert_to_i420(after, after.bounds(), whole.view());
          Planes part = start;
          convert_to_i420(after, {x, y, w, h}, part.view());
          ASSERT_EQ(part, whole) << x << ' ' << y << ' ' << w << ' ' << h;
        }
      }
    }
  }
}

}  // namespace
}  // namespace bookspin
