#include "image/compare.h"

#include <gtest/gtest.h>

#include "golden_test.h"

namespace bookspin {
namespace {

Image gray(int width, int height, std::uint8_t level) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); ++i) image.rgba[i] = i % 4 == 3 ? 255 : level;
  return image;
}

TEST(Compare, EqualPictures) {
  const ImageDelta delta = compare(gray(8, 4, 100), gray(8, 4, 100), 0);
  EXPECT_TRUE(delta.same_size);
  EXPECT_EQ(delta.max_delta, 0);
  EXPECT_EQ(delta.mean_delta, 0);
  EXPECT_EQ(delta.share_above, 0);
}

TEST(Compare, AnyChannelCounts) {
  const Image a = gray(8, 4, 100);
  Image b = a;
  b.rgba[0] = 90;           // red of the first pixel, 10 down
  b.rgba[4 * 5 + 2] = 103;  // blue of another, 3 up
  b.rgba[4 * 6 + 3] = 251;  // alpha of a third, 4 down
  const ImageDelta delta = compare(a, b, 3);
  EXPECT_EQ(delta.max_delta, 10);
  EXPECT_DOUBLE_EQ(delta.mean_delta, 17.0 / 32);
  EXPECT_DOUBLE_EQ(delta.share_above, 2.0 / 32);
}

TEST(Compare, TheWorstPixelsComeFirst) {
  const Image a = gray(8, 4, 100);
  Image b = a;
  b.pixel(3, 2)[1] = 107;
  b.pixel(7, 3)[2] = 80;
  b.pixel(0, 0)[0] = 99;
  const std::string all = worst_pixels(a, b, 10);
  EXPECT_EQ(all.substr(all.find('\n') + 1),
            "     7     3     20  100 100 100 255   100 100  80 255\n"
            "     3     2      7  100 100 100 255   100 107 100 255\n"
            "     0     0      1  100 100 100 255    99 100 100 255\n");
  EXPECT_EQ(worst_pixels(a, b, 2), all.substr(0, all.rfind("     0     0")));
  EXPECT_EQ(worst_pixels(a, a, 10), "");
}

TEST(Compare, DifferentSizes) {
  EXPECT_FALSE(compare(gray(8, 4, 0), gray(4, 8, 0), 0).same_size);
}

TEST(Compare, DeltaPictureShowsWhatDiffers) {
  Image a(96, 54);
  Image b(96, 54);
  for (int y = 0; y < a.height; ++y) {
    for (int x = 0; x < a.width; ++x) {
      const std::size_t i = a.offset(x, y);
      for (std::size_t c = 0; c < 3; ++c) a.rgba[i + c] = static_cast<std::uint8_t>(2 * x);
      a.rgba[i + 3] = 255;
      for (std::size_t c = 0; c < 4; ++c) b.rgba[i + c] = a.rgba[i + c];
      if (x > 60 && y > 30) b.rgba[i + 1] = static_cast<std::uint8_t>(b.rgba[i + 1] + 1);  // hardly
      if (x < 20 && y < 20) b.rgba[i + 2] = 200;                                           // plainly
    }
  }
  expect_golden(delta_picture(a, b), "image", "delta_slight_and_strong");
}

}  // namespace
}  // namespace bookspin
