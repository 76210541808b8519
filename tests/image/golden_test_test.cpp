#include "golden_test.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "image/png.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

bool accepting() {
  return std::getenv("BOOKSPIN_ACCEPT_GOLDENS") != nullptr;
}
fs::path failures() {
  return fs::path(BOOKSPIN_BINARY_DIR) / "golden" / "image";
}

Image disc() {
  Image image(32, 18);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const bool inside = (x - 16) * (x - 16) + (y - 9) * (y - 9) < 50;
      for (std::size_t c = 0; c < 4; ++c) {
        image.rgba[static_cast<std::size_t>(4 * (y * image.width + x)) + c] = inside || c == 3 ? 255 : 0;
      }
    }
  }
  return image;
}

// GoogleTest's macros for expected failures reach only statics.
Image& shown() {
  static Image image;
  return image;
}

TEST(Golden, OnePixelOrAllALittleIsADifferentPicture) {
  shown() = disc();
  expect_golden(shown(), "image", "disc");
  if (accepting()) return;
  EXPECT_FALSE(fs::exists(failures() / "disc.png"));

  shown().rgba[0] = 40;
  EXPECT_NONFATAL_FAILURE(expect_golden(shown(), "image", "disc"), "make -C");
  EXPECT_NONFATAL_FAILURE(expect_golden(shown(), "image", "disc"),
                          "     0     0     40    0   0   0 255    40   0   0 255\n");
  EXPECT_EQ(read_png(failures() / "disc.png").rgba, shown().rgba);
  EXPECT_TRUE(fs::exists(failures() / "disc.delta.png"));

  shown() = disc();  // all pixels, hardly
  for (std::uint8_t& level : shown().rgba) level = level == 0 ? 2 : level;
  EXPECT_NONFATAL_FAILURE(expect_golden(shown(), "image", "disc"), "picture differs");
  fs::remove_all(failures());
}

TEST(Golden, MissingFailsAndLeavesTheActualPicture) {
  if (accepting()) GTEST_SKIP() << "needs comparison, not acceptance";
  shown() = disc();
  EXPECT_NONFATAL_FAILURE(expect_golden(shown(), "image", "never_accepted"), "golden missing");
  EXPECT_TRUE(fs::exists(failures() / "never_accepted.png"));
  fs::remove_all(failures());
}

}  // namespace
}  // namespace bookspin

int main(int argc, char** argv) {
  return bookspin::run_tests_with_goldens(argc, argv, "image");
}
