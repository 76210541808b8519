// No film flashes more than three times in any second (WCAG 2.3.1): the drawn frames of every film in which a book
// explodes.
//
// A general flash is a pair of opposing changes of relative luminance by 10 % or more, the darker state below 0.8.
// Flashes count where together they cover a quarter of a field of view of 10 degrees, which for a film that fills a
// screen is a third of its width and height. Measured here: the mean luminance of the whole picture and of tiles of a
// sixth of its width and height, a quarter of such a field, each overlapping its neighbors by half. A tile changes by
// 10 % only if its whole area does so on average. Saturated red, which has a rule of its own, is in no film.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <vector>

#include "film/storyboard.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

const fs::path project = BOOKSPIN_SOURCE_DIR;
constexpr int most_flashes = 3;  // in any second

// Finds the changes of one luminance by 0.1 or more, each opposite to the one before.
class Changes {
 public:
  // Whether this luminance completes one.
  bool add(double luminance) {
    low_ = std::min(low_, luminance);
    high_ = std::max(high_, luminance);
    if (direction_ <= 0 && luminance - low_ >= 0.1 && low_ < 0.8)
      direction_ = 1;
    else if (direction_ >= 0 && high_ - luminance >= 0.1 && luminance < 0.8)
      direction_ = -1;
    else
      return false;
    low_ = high_ = luminance;
    return true;
  }

 private:
  double low_ = 2.0;    // least since the last change: what a change upwards is measured from
  double high_ = -1.0;  // largest since the last change
  int direction_ = 0;   // of the last change
};

double relative_luminance(const std::uint8_t* rgba) {
  static const std::array<double, 256> linear = [] {
    std::array<double, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
      const double c = static_cast<double>(i) / 255.0;
      table[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    }
    return table;
  }();
  return 0.2126 * linear[rgba[0]] + 0.7152 * linear[rgba[1]] + 0.0722 * linear[rgba[2]];
}

// The most flashes that any tile has had in any second so far.
class FlashMeter {
 public:
  FlashMeter(int width, int height, int fps) : width_(width), height_(height), fps_(fps) {
    tiles_.push_back({0, 0, width, height, {}, {}});
    const int w = width / 6;
    const int h = height / 6;
    for (int y = 0; y + h <= height; y += h / 2) {
      for (int x = 0; x + w <= width; x += w / 2) tiles_.push_back({x, y, w, h, {}, {}});
    }
  }

  void add(const Image& image) {
    // Sums over all rectangles that begin at the upper left corner.
    const auto at = [&](int x, int y) {
      return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_ + 1) + static_cast<std::size_t>(x);
    };
    std::vector<double> sums(at(width_, height_) + 1);
    for (int y = 1; y <= height_; ++y) {
      for (int x = 1; x <= width_; ++x) {
        const auto pixel = static_cast<std::size_t>((y - 1) * width_ + x - 1);
        sums[at(x, y)] = relative_luminance(&image.rgba[4 * pixel]) + sums[at(x - 1, y)] + sums[at(x, y - 1)] -
                         sums[at(x - 1, y - 1)];
      }
    }
    for (Tile& t : tiles_) {
      const double sum =
          sums[at(t.x + t.w, t.y + t.h)] - sums[at(t.x, t.y + t.h)] - sums[at(t.x + t.w, t.y)] + sums[at(t.x, t.y)];
      if (t.changes.add(sum / (t.w * t.h))) t.frames.push_back(frame_);
      while (!t.frames.empty() && frame_ - t.frames.front() >= fps_) t.frames.pop_front();
      worst_ = std::max(worst_, static_cast<int>(t.frames.size()) / 2);
    }
    ++frame_;
  }
  [[nodiscard]] int worst() const { return worst_; }

 private:
  struct Tile {
    int x, y, w, h;  // pixels
    Changes changes;
    std::deque<int> frames;  // of its changes within the last second
  };
  int width_;
  int height_;
  int fps_;
  int frame_ = 0;
  int worst_ = 0;
  std::vector<Tile> tiles_;
};

// A picture of which the upper left corner of side x side pixels goes on and off.
int worst_of_flicker(double per_second, std::uint8_t bright, int side) {
  FlashMeter meter(48, 48, 60);
  for (int n = 0; n < 120; ++n) {
    Image image(48, 48);
    const bool on = std::fmod(n * per_second / 60.0, 1.0) >= 0.5;
    const auto wide = static_cast<std::size_t>(side);
    for (std::size_t y = 0; on && y < wide; ++y)
      std::fill_n(&image.rgba[192 * y], 4 * wide, bright);  // 192 bytes a row
    meter.add(image);
  }
  return meter.worst();
}

TEST(FlashMeter, CountsFlashesThatAreStrongAndLargeEnough) {
  EXPECT_EQ(worst_of_flicker(5, 255, 48), 5);
  EXPECT_EQ(worst_of_flicker(3, 255, 48), 3);
  EXPECT_EQ(worst_of_flicker(5, 90, 48), 5);  // relative luminance 0.102
  EXPECT_EQ(worst_of_flicker(5, 88, 48), 0);  // 0.098
  EXPECT_EQ(worst_of_flicker(5, 255, 8), 5);  // a tile is 8 x 8
  EXPECT_EQ(worst_of_flicker(5, 255, 2), 0);  // a sixteenth of it
}

std::vector<std::string> scripts() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(project / "videos")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class Flashes : public testing::TestWithParam<std::string> {};

TEST_P(Flashes, AtMostThreeInAnySecondOfAnExplosion) {
  constexpr int width = 192;
  constexpr int height = 108;
  const Scene scene = load_scene(project / "videos" / (GetParam() + ".toml"));
  const Trajectory trajectory = simulate(scene);
  const bool explodes = std::any_of(trajectory.books.begin(), trajectory.books.end(),
                                    [](const BookTrack& b) { return b.exploded_frame.has_value(); });
  if (!explodes) return;
  const Storyboard storyboard(scene, trajectory, width, height);
  Renderer renderer(width, height, project);
  FlashMeter meter(width, height, scene.clip.fps);
  for (int n = 0; n < storyboard.frames(); ++n) meter.add(renderer.draw(storyboard.shot(n)));
  EXPECT_LE(meter.worst(), most_flashes);
}

INSTANTIATE_TEST_SUITE_P(Films, Flashes, testing::ValuesIn(scripts()),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace bookspin
