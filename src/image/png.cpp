#include "image/png.h"

#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>
#include <system_error>

namespace bookspin {
namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const char* operation, const char* reason) {
  throw std::runtime_error(fmt::format("{}: {}: {}", path.string(), operation, reason));
}

[[noreturn]] void fail_with_errno(const std::filesystem::path& path, const char* operation) {
  fail(path, operation, std::generic_category().message(errno).c_str());
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

// libpng's simplified interface: it reports through a message, not through longjmp.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

bool opaque(const Image& image) {
  for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
    if (image.rgba[i] != 255) return false;
  }
  return true;
}

std::vector<std::uint8_t> without_alpha(const Image& image) {
  std::vector<std::uint8_t> rgb;
  rgb.reserve(image.rgba.size() / 4 * 3);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    rgb.insert(rgb.end(), {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]});
  }
  return rgb;
}

}  // namespace

Image read_png(const std::filesystem::path& path) {
  const File file(std::fopen(path.c_str(), "rb"));
  if (!file) fail_with_errno(path, "open PNG");
  PngImage png;
  if (png_image_begin_read_from_stdio(&png, file.get()) == 0) fail(path, "read PNG", png.message);
  png.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) fail(path, "read PNG", png.message);
  return image;
}

void write_png(const Part& part, const Image& image) {
  assert(!image.bounds().empty());
  const bool rgb = opaque(image);
  const std::vector<std::uint8_t> pixels = rgb ? without_alpha(image) : image.rgba;

  PngImage png;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = rgb ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;

  File file(std::fopen(part.path().c_str(), "wb"));
  if (!file) fail_with_errno(part.file(), "open PNG");
  if (png_image_write_to_stdio(&png, file.get(), 0, pixels.data(), 0, nullptr) == 0) {
    fail(part.file(), "write PNG", png.message);
  }
  if (std::fclose(file.release()) != 0) fail_with_errno(part.file(), "close PNG");
}

void write_png(const std::filesystem::path& path, const Image& image) {
  Part part(path);
  write_png(part, image);
  publish({&part});
}

}  // namespace bookspin
