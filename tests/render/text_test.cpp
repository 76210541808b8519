// Labels are judged by where their ink is, not by goldens: every release of the font draws them a little differently.

#include "render/text.h"

#include <gtest/gtest.h>

#include "poses.h"
#include "render/camera.h"
#include "render/renderer.h"

namespace bookspin {
namespace {

constexpr int width = 640;
constexpr int height = 360;
constexpr Color pale{236, 239, 244, 255};

Label label_at(const std::string& text, double x, double y, double size, Align align = Align::left,
               Weight weight = Weight::regular, bool tabular = false) {
  return {text, {x, y}, std::nullopt, size, pale, align, weight, tabular};
}

struct Text : testing::Test {
  TextPainter painter;
  TextLayout lay_out(const Label& label) {
    return painter.lay_out(label, View(Camera(), width, height), width, height);
  }

  // The letters without their rim.
  Rect ink(const Label& label) {
    Image picture(width, height);
    for (int y = 0; y < height; ++y) std::fill_n(picture.pixel(0, y), 4 * width, std::uint8_t{0});
    TextPainter::draw(lay_out(label), picture.bounds(), picture);
    Rect result;
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (*picture.pixel(x, y) > 118) result = union_of(result, {x, y, 1, 1});  // half of pale
      }
    }
    return result;
  }
};

// Capitals stand on the base line and are 0.727 em high; Inter has kept that. In pixels, an edge may fall either way.
TEST_F(Text, StandsOnItsBaseLineAndIsAsHighAsTold) {
  for (const double size : {0.04, 0.07, 0.2}) {
    for (const Weight weight : {Weight::regular, Weight::semibold}) {
      const double em = std::round(size * height);
      const Rect capitals = ink(label_at("HEZ", 0.1, 0.5, size, Align::left, weight));
      EXPECT_NEAR(capitals.y + capitals.height, 0.5 * height, 1) << em;
      EXPECT_NEAR(capitals.height, 0.727 * em, 1) << em;
      const Rect all = ink(label_at("HEZgjpqÅ|₀⁻", 0.1, 0.5, size, Align::left, weight));
      EXPECT_GT(all.y, 0.5 * height - 1.10 * em) << em;               // measured 1.00 em
      EXPECT_LT(all.y + all.height, 0.5 * height + 0.35 * em) << em;  // measured 0.24 em
    }
  }
}

TEST_F(Text, AlignsItsLeftEndItsMiddleOrItsRightEnd) {
  for (const char* const text : {"t = 111.11 s", "Quaternion, Euler, exact ghost"}) {
    const Rect left = ink(label_at(text, 0.2, 0.5, 0.04));
    const Rect middle = ink(label_at(text, 0.5, 0.5, 0.04, Align::center));
    const Rect right = ink(label_at(text, 0.8, 0.5, 0.04, Align::right));
    EXPECT_NEAR(left.x, 0.2 * width, 2);  // and the letters' own margins
    EXPECT_NEAR(middle.x + 0.5 * middle.width, 0.5 * width, 2);
    EXPECT_NEAR(right.x + right.width, 0.8 * width, 2);
    EXPECT_NEAR(left.width, right.width, 1);
    EXPECT_NEAR(left.width, lay_out(label_at(text, 0.2, 0.5, 0.04)).length, 3);
  }
}

TEST_F(Text, IsAsWideAsItsLetters) {
  const double em = std::round(0.04 * height);
  const std::string text = "Quaternion, Euler, exact ghost";
  const double letter = lay_out(label_at(text, 0.03, 0.5, 0.04)).length / em / static_cast<double>(text.size());
  EXPECT_GT(letter, 0.40);  // measured 0.476
  EXPECT_LT(letter, 0.55);
  const double bold = lay_out(label_at(text, 0.03, 0.5, 0.04, Align::left, Weight::semibold)).length;
  EXPECT_GT(bold, 1.01 * letter * em * static_cast<double>(text.size()));  // measured 1.027
}

TEST_F(Text, TabularFiguresAllHaveOneWidth) {
  for (const double size : {0.03, 0.04, 0.1}) {
    const auto length = [&](const std::string& text, bool tabular) {
      return lay_out(label_at(text, 0.1, 0.5, size, Align::left, Weight::regular, tabular)).length;
    };
    for (char digit = '0'; digit <= '9'; ++digit) {
      EXPECT_EQ(length(std::string(5, digit), true), length("88888", true)) << digit;
    }
    EXPECT_LT(length("11111", false), length("11111", true));
  }
}

// What the films write: not one character of it is a box.
TEST_F(Text, HasEveryCharacterThatTheProjectWrites) {
  EXPECT_TRUE(painter.lacks("E/E₀ = 1.0003   |L|/L₀ = 0.9998   Δθ = 3.2°   ω² α → ∞   10⁻¹⁵  –").empty());
  EXPECT_EQ(painter.lacks("漢ω漢"), std::vector<std::string>{"漢"});
  EXPECT_FALSE(ink(label_at("漢", 0.1, 0.5, 0.1)).empty());  // a box
}

// A label changes the picture within its bounds and nowhere else, and its letters have its color, on a book as well.
TEST_F(Text, IsDrawnWithinItsBoundsInItsColor) {
  Shot shot = shot_of(book_at(20, 35, 5));
  Renderer renderer(width, height, assets());
  const Image without = renderer.draw(shot);
  shot.labels.push_back(label_at("over the book", 0.5, 0.5, 0.045, Align::center, Weight::semibold));
  const Image with = renderer.draw(shot);
  const Rect bounds = painter.lay_out(shot.labels[0], View(shot.camera, width, height), width, height).bounds;
  int letters = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* const pixel = with.pixel(x, y);
      if (intersection(bounds, {x, y, 1, 1}).empty()) {
        ASSERT_TRUE(std::equal(pixel, pixel + 4, without.pixel(x, y))) << x << ", " << y;
      } else if (pixel[0] == pale.r && pixel[1] == pale.g && pixel[2] == pale.b) {
        ++letters;
      }
    }
  }
  const double share = static_cast<double>(letters) / (bounds.width * bounds.height);
  EXPECT_GT(share, 0.05);  // measured 0.088
  EXPECT_LT(share, 0.5);
}

}  // namespace
}  // namespace bookspin
