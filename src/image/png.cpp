#include "image/png.h"

#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <cstdint>

#include "files/files.h"

namespace bookspin {
namespace {

constexpr unsigned most_side = 16384;  // pixels, as OpenGL's textures
constexpr unsigned most_pixels = 1U << 26U;

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

std::string png_version() {
  return png_get_libpng_ver(nullptr);
}

Image parse_png(const std::string& bytes, const std::filesystem::path& name) {
  PngImage png;
  if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) {
    throw_file_error(name, "read PNG", bytes.empty() ? "is empty" : png.message);
  }
  if (png.width > most_side || png.height > most_side || std::uint64_t{png.width} * png.height > most_pixels) {
    throw_file_error(name, "read PNG",
                     fmt::format("found {}x{} pixels; allowed: sides up to {}, and up to {} pixels", png.width,
                                 png.height, most_side, most_pixels));
  }
  png.format = PNG_FORMAT_RGBA;
  Image image(static_cast<int>(png.width), static_cast<int>(png.height));
  if (png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr) == 0) {
    throw_file_error(name, "read PNG", png.message);
  }
  return image;
}

Image read_png(const std::filesystem::path& path) {
  return parse_png(read_file(path), path);
}

void write_png(const Part& part, const Image& image) {
  assert(!image.bounds().empty());
  const bool rgb = opaque(image);
  const std::vector<std::uint8_t> pixels = rgb ? without_alpha(image) : image.rgba;

  PngImage png;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = rgb ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, pixels.data(), 0, nullptr) == 0) {
    throw_file_error(part.file(), "write PNG", png.message);
  }
  write_part(part, std::string_view(bytes).substr(0, size));
}

void write_png(const std::filesystem::path& path, const Image& image) {
  Part part(path);
  write_png(part, image);
  publish({&part});
}

}  // namespace bookspin
