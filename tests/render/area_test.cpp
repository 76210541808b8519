#include "render/area.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

namespace bookspin {
namespace {

constexpr Rect frame{0, 0, 640, 360};

int pixels_of(const std::vector<Rect>& rects) {
  int pixels = 0;
  for (const Rect& rect : rects) pixels += rect.width * rect.height;
  return pixels;
}

TEST(Area, HoldsAHullAndItsMarginAndLittleElse) {
  const std::array<Eigen::Vector2d, 4> points{{{20, 30}, {600, 340}, {610, 320}, {500, 300}}};
  Area area(frame);
  area.add(points, 2.0);
  const std::vector<Rect> rects = area.rects();
  for (const Eigen::Vector2d& from : points) {
    for (const Eigen::Vector2d& to : points) {
      for (int k = 0; k <= 1000; ++k) {
        const Eigen::Vector2d p = from + (to - from) * k / 1000;
        for (const Eigen::Vector2d& off : {Eigen::Vector2d{-1.9, -1.9}, {1.9, -1.9}, {-1.9, 1.9}, {1.9, 1.9}}) {
          const Rect pixel{static_cast<int>(p.x() + off.x()), static_cast<int>(p.y() + off.y()), 1, 1};
          ASSERT_TRUE(std::ranges::any_of(rects, [&](const Rect& r) { return !intersection(r, pixel).empty(); }))
              << p.transpose();
        }
      }
    }
  }
  EXPECT_LT(pixels_of(rects), 640 * 360 / 2);  // measured 0.37; the rectangle about it: 0.83
}

TEST(Area, OfWhatLiesOutsideTheFrameKeepsWhatIsInIt) {
  Area area(frame);
  area.add(Rect{-50, -50, 40, 40});
  area.add(std::array<Eigen::Vector2d, 2>{{{-1e9, -1e9}, {-10, -10}}}, 2.0);
  EXPECT_TRUE(area.rects().empty());
  area.add(std::array<Eigen::Vector2d, 3>{{{-1e9, -1e9}, {1e9, -1e9}, {0, 1e9}}}, 2.0);
  EXPECT_EQ(pixels_of(area.rects()), 640 * 360);
}

}  // namespace
}  // namespace bookspin
