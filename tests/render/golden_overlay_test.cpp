#include <gtest/gtest.h>

#include <cmath>

#include "golden_test.h"
#include "poses.h"
#include "render/renderer.h"

namespace bookspin {
namespace {

constexpr Color red{230, 97, 60, 255}, green{92, 200, 160, 255}, blue{90, 160, 240, 255};

TEST(GoldenOverlay, Axes) {
  Shot shot = shot_of(book_at(25, 40, 0));
  shot.camera.eye_W = {0, 0, 9.5};
  const Corners& corners_W = shot.books[0].corners_W;
  const std::array<Color, 3> colors{red, green, blue};
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d axis_W = (corners_W.col(1 << d) - corners_W.col(0)).normalized();
    shot.arrows.push_back({{0, 0, 0}, 2.0 * axis_W, colors[static_cast<std::size_t>(d)], 0.03});
  }
  Renderer renderer(480, 270, assets());
  expect_golden(renderer.draw(shot), "render", "axes");
}

TEST(GoldenOverlay, SpringsAndTrace) {
  Shot shot = shot_of(book_at(25, 40, 0));
  shot.books[0].style = BookStyle::ghost;
  const Corners& corners_W = shot.books[0].corners_W;
  for (int i = 0; i < 8; ++i) {
    for (int j = 0; j < i; ++j) {
      const int tension = (i * 7 + j * 3) % 11;  // 0 ... 10
      const Color color{static_cast<std::uint8_t>(80 + 15 * tension), static_cast<std::uint8_t>(160 - 6 * tension),
                        static_cast<std::uint8_t>(230 - 18 * tension), 255};
      shot.lines.push_back({corners_W.col(i), corners_W.col(j), color, 2});
    }
  }
  const auto on_trace = [](int k) {
    return Eigen::Vector3d(2.6 * std::cos(0.05 * k), 1.3 + 0.25 * std::sin(0.12 * k), 1.5 * std::sin(0.05 * k));
  };
  for (int k = 0; k < 120; ++k) {
    shot.lines.push_back({on_trace(k), on_trace(k + 1), {255, 210, 120, static_cast<std::uint8_t>(2 * k)}, 2.5});
  }
  Renderer renderer(480, 270, assets());
  expect_golden(renderer.draw(shot), "render", "springs_and_trace");
}

TEST(GoldenOverlay, ArrowsThroughTheBook) {
  Shot shot = shot_of(book_at(10, -30, 10));
  shot.camera.eye_W = {2, 3, 8};
  shot.arrows.push_back({{0, -2.1, 0}, {0.4, 2.1, 0.5}, {250, 200, 70, 255}, 0.05});
  shot.arrows.push_back({{1.4, 0, 0}, {1.5, 0.05, 0}, green, 0.05});  // shorter than a head: all head
  Renderer renderer(480, 270, assets());
  expect_golden(renderer.draw(shot), "render", "arrows_through_the_book");
}

}  // namespace
}  // namespace bookspin
