// Pictures and folders for the tests of this room.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "image/image.h"

namespace bookspin {

inline Image flat_picture(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
    image.rgba[i] = r;
    image.rgba[i + 1] = g;
    image.rgba[i + 2] = b;
    image.rgba[i + 3] = 255;
  }
  return image;
}

inline Image random_picture(int width, int height, std::mt19937& generator) {
  Image image(width, height);
  for (std::uint8_t& byte : image.rgba) byte = static_cast<std::uint8_t>(generator());
  return image;
}

// A colored, patterned box that drifts over a calm background: frame k.
struct MovingBox {
  int width;
  int height;

  [[nodiscard]] Rect box(int k) const {
    const int side = height / 2;
    const int free_x = width - side;
    const int free_y = height - side;
    return {3 * k % free_x, k % free_y, side, side};
  }

  [[nodiscard]] Image draw(int k) const {
    Image image = flat_picture(width, height, 236, 233, 226);
    const Rect b = box(k);
    for (int y = 0; y < b.height; ++y) {
      for (int x = 0; x < b.width; ++x) {
        const auto at = 4 * (static_cast<std::size_t>(b.y + y) * static_cast<std::size_t>(width) +
                             static_cast<std::size_t>(b.x + x));
        const int light = y / 6 % 3 == 1 && x > 6 && x < b.width - 6 ? 110 : 0;
        image.rgba[at] = static_cast<std::uint8_t>(light + 40 + x * 60 / b.width);
        image.rgba[at + 1] = static_cast<std::uint8_t>(light + 60 + y * 80 / b.height);
        image.rgba[at + 2] = static_cast<std::uint8_t>(light + 120);
      }
    }
    return image;
  }

  // Covers where frame k differs from frame k - 1.
  [[nodiscard]] Rect changed(int k) const {
    if (k == 0) return {0, 0, width, height};
    const Rect a = box(k - 1);
    const Rect b = box(k);
    const int x = std::min(a.x, b.x);
    const int y = std::min(a.y, b.y);
    return {x, y, std::max(a.x, b.x) + a.width - x, std::max(a.y, b.y) + a.height - y};
  }
};

inline std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// An empty folder of this name in the build tree.
inline std::filesystem::path empty_folder(const std::string& name) {
  std::filesystem::path folder = std::filesystem::path(BOOKSPIN_BINARY_DIR) / "tests" / "video_films" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

inline std::ptrdiff_t files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

}  // namespace bookspin
