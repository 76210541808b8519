#include <gtest/gtest.h>

#include <cmath>

#include "golden_test.h"
#include "poses.h"
#include "render/renderer.h"

namespace bookspin {
namespace {

constexpr Color red{230, 97, 60, 255}, green{92, 200, 160, 255}, blue{90, 160, 240, 255}, pale{236, 239, 244, 255};

TEST(GoldenOverlay, LabeledAxes) {
  Shot shot = shot_of(book_at(25, 40, 0));
  shot.camera.eye_W = {0, 0, 9.5};
  const Corners& corners_W = shot.books[0].corners_W;
  const std::array<Color, 3> colors{red, green, blue};
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d axis_W = (corners_W.col(1 << d) - corners_W.col(0)).normalized();
    const auto i = static_cast<std::size_t>(d);
    shot.arrows.push_back({{0, 0, 0}, 2.0 * axis_W, colors[i], 0.03});
    shot.labels.push_back({names[i], {0, 0.02}, 2.2 * axis_W, 0.07, colors[i], Align::center, Weight::semibold, false});
  }
  Renderer renderer(480, 270, assets());
  expect_golden(renderer.draw(shot), "render", "axes_labelled");
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

TEST(GoldenOverlay, TextLegibleAtSmallSize) {
  Shot shot = shot_of(book_at(20, 35, 5));
  const auto add = [&](const char* text, double x, double y, double height, Align align, Weight weight, bool tabular) {
    shot.labels.push_back({text, {x, y}, std::nullopt, height, pale, align, weight, tabular});
  };
  add("Quaternion, Euler, exact ghost", 0.03, 0.08, 0.05, Align::left, Weight::semibold, false);
  add("t = 111.11 s", 0.97, 0.08, 0.04, Align::right, Weight::regular, true);
  add("t = 888.88 s", 0.97, 0.14, 0.04, Align::right, Weight::regular, true);
  add("E/E₀ = 1.0003   |L|/L₀ = 0.9998   Δθ = 3.2°   ω² α → ∞   10⁻¹⁵", 0.5, 0.95, 0.04, Align::center, Weight::regular,
      true);
  add("over the book", 0.5, 0.5, 0.045, Align::center, Weight::semibold, false);
  Renderer renderer(640, 360, assets());
  expect_golden(renderer.draw(shot), "render", "text_640x360");
}

}  // namespace
}  // namespace bookspin
