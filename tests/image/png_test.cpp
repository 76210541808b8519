#include "image/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

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
                  AllOf(HasSubstr("none.png"), HasSubstr("cannot be read"), HasSubstr("No such file or directory"))));
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

  std::ofstream(folder_ / "empty.png").flush();
  EXPECT_THAT([&] { (void)read_png(folder_ / "empty.png"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("empty.png: read PNG: is empty")));
  EXPECT_THAT([&] { (void)read_png(folder_); }, ThrowsMessage<std::runtime_error>(HasSubstr("is a folder")));
  ASSERT_EQ(mkfifo((folder_ / "fifo.png").c_str(), 0600), 0);  // whoever opens it waits for a writer
  EXPECT_THAT([&] { (void)read_png(folder_ / "fifo.png"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("is not a regular file")));
}

// Width and height stand in bytes 16 to 23, their checksum in 29 to 32.
TEST_F(Png, AbsurdSizesAreRefusedBeforeMemoryIsTaken) {
  write_png(folder_ / "a.png", gradient(255));
  const std::string good = bytes_of(folder_ / "a.png");
  const auto sized = [&good](std::uint32_t width, std::uint32_t height) {
    std::string bytes = good;
    const auto put = [&bytes](std::size_t at, std::uint32_t number) {
      for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(number >> (24U - 8U * i));
    };
    put(16, width);
    put(20, height);
    put(29, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(&bytes[12]), 17)));
    return bytes;
  };
  const std::vector<std::string> absurd{sized(100000, 100000), sized(16384, 16384), sized(1, 16385)};
  for (const std::string& bytes : absurd) {
    EXPECT_THAT(
        [&] { (void)parse_png(bytes, "a.png"); },
        ThrowsMessage<std::runtime_error>(HasSubstr("pixels; allowed: sides up to 16384, and up to 67108864 pixels")));
  }
}

}  // namespace
}  // namespace bookspin
