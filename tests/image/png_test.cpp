#include "image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

Image gradient(std::uint8_t alpha) {
  Image image(37, 19);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      auto* const pixel = image.pixel(x, y);
      pixel[0] = static_cast<std::uint8_t>(6 * x);
      pixel[1] = static_cast<std::uint8_t>(13 * y);
      pixel[2] = static_cast<std::uint8_t>(255 - 6 * x);
      pixel[3] = alpha;
    }
  }
  return image;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

class Png : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(BOOKSPIN_BINARY_DIR) / "tests" / "png_test";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(Png, ComesBackAsItWasWritten) {
  for (const std::uint8_t alpha : std::initializer_list<std::uint8_t>{255, 128, 0}) {
    const Image written = gradient(alpha);
    write_png(folder_ / "a.png", written);
    const Image read = read_png(folder_ / "a.png");
    EXPECT_EQ(read.width, written.width);
    EXPECT_EQ(read.height, written.height);
    EXPECT_EQ(read.rgba, written.rgba);
  }
}

TEST_F(Png, HasAnAlphaChannelOnlyWhenItNeedsOne) {
  constexpr std::size_t color_type = 25;  // in the IHDR chunk: 2 RGB, 6 RGBA
  write_png(folder_ / "opaque.png", gradient(255));
  write_png(folder_ / "translucent.png", gradient(254));
  EXPECT_EQ(bytes_of(folder_ / "opaque.png").at(color_type), 2);
  EXPECT_EQ(bytes_of(folder_ / "translucent.png").at(color_type), 6);
}

TEST_F(Png, SameImageSameBytes) {
  write_png(folder_ / "a.png", gradient(255));
  write_png(folder_ / "b.png", gradient(255));
  EXPECT_EQ(bytes_of(folder_ / "a.png"), bytes_of(folder_ / "b.png"));
}

TEST_F(Png, LeavesNothingHalfWritten) {
  const Image image = gradient(255);
  write_png(folder_ / "good.png", image);
  fs::create_directories(folder_ / "taken.png");
  EXPECT_THAT([&] { write_png(folder_ / "taken.png", image); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("taken.png"), HasSubstr("is a folder"))));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 2);
}

TEST_F(Png, ErrorsNameFileOperationAndReason) {
  EXPECT_THAT([&] { (void)read_png(folder_ / "none.png"); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("none.png"), HasSubstr("open PNG"), HasSubstr("No such file or directory"))));
  EXPECT_THAT([&] { write_png(folder_ / "no" / "folder.png", gradient(255)); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("folder.png"), HasSubstr("cannot be opened"),
                                                      HasSubstr("No such file or directory"))));

  std::ofstream(folder_ / "text.png") << "this is not a picture";
  EXPECT_THAT([&] { (void)read_png(folder_ / "text.png"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("text.png"), HasSubstr("read PNG"), HasSubstr("PNG"))));

  write_png(folder_ / "cut.png", gradient(255));
  fs::resize_file(folder_ / "cut.png", fs::file_size(folder_ / "cut.png") / 2);
  EXPECT_THAT([&] { (void)read_png(folder_ / "cut.png"); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("cut.png"), HasSubstr("read PNG"))));
}

}  // namespace
}  // namespace bookspin
