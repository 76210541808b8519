#include "render/renderer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>

#include "golden_test.h"
#include "image/compare.h"
#include "poses.h"
#include "render/camera.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Pixel {
  int r, g, b;
};

Pixel pixel_at(const Image& image, const PixelPoint& point) {
  const std::uint8_t* const pixel = image.pixel(static_cast<int>(point.x), static_cast<int>(point.y));
  return {pixel[0], pixel[1], pixel[2]};
}

bool is_yellow(const Pixel& p) {
  return p.r > 100 && p.g > 70 && p.b < 80;
}
bool is_blue(const Pixel& p) {
  return p.b > 80 && p.b > p.r + 40;
}
bool is_paper(const Pixel& p) {
  return p.r > 80 && std::abs(p.r - p.b) < 60 && p.r >= p.b;
}

Image draw(const Shot& shot, int width = 480, int height = 270) {
  Renderer renderer(width, height, assets());
  return renderer.draw(shot);
}

// A film's worth of everything that can change, and frames in which nothing does.
Shot scene_at(int frame) {
  Shot shot = shot_of(book_at(7.0 * frame, 11.0 * frame, 3.0 * frame, {-0.9, 0, 0}));
  if (frame > 3)
    shot.books.push_back({book_at(7.5 * frame, 11.0 * frame, 3.0 * frame, {-0.9, 0, 0}), BookStyle::ghost});
  shot.books.push_back({book_at(20, 35, 5, {1.9, 0, 0}), BookStyle::solid});  // stands still
  shot.arrows.push_back({{-0.9, 0, 0}, {-0.9 + std::cos(0.3 * frame), 1.8, 0.4}, {250, 200, 70, 255}, 0.03});
  shot.arrows.back().shift = {0.02 * frame, -0.01 * frame};
  for (int k = 0; k < frame; ++k) {
    shot.lines.push_back({{-1.5, 0.1 * k, 1}, {-1.4, 0.1 * k + 0.1, 1}, {255, 210, 120, 180}, 2, {0, 0.01 * frame}});
  }
  shot.labels.push_back(
      {"t = " + std::to_string(frame / 2), {0.03, 0.1}, {}, 0.06, {}, Align::left, Weight::regular, true});
  shot.labels.push_back({"stands still, over both", {0.5, 0.55}, {}, 0.06, {}, Align::center, Weight::semibold, false});
  return shot;
}

// Where the pictures are of one size: the largest difference of a level.
int largest_difference(const Image& a, const Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  return largest;
}

Image part(const Image& image, const Rect& rect) {
  Image result(rect.width, rect.height);
  for (int y = 0; y < rect.height; ++y) {
    std::copy_n(image.pixel(rect.x, rect.y + y), 4 * static_cast<std::size_t>(rect.width), result.pixel(0, y));
  }
  return result;
}

int pixels_of(const std::vector<Rect>& rects) {
  int pixels = 0;
  for (const Rect& rect : rects) pixels += rect.width * rect.height;
  return pixels;
}

// Four books in a row, all in one pose but the last, each with an arrow and a line.
TEST(Renderer, BooksInARowLookAlikeWhenTheirPosesAre) {
  constexpr int width = 800;
  constexpr int height = 200;
  Shot row;
  row.camera.eye_W = {0, 2, 10};
  std::vector<Shot> alone(4, row);
  for (int b = 0; b < 4; ++b) {
    const Eigen::Vector2d shift(b - 1.5 + 1e-3, 0.0);  // not a whole number of pixels
    const Corners corners_W = book_at(b < 3 ? 25 : 75, 40, 10);
    alone[static_cast<std::size_t>(b)].books.push_back(
        {corners_W, b == 1 ? BookStyle::ghost : BookStyle::solid, shift});
    alone[static_cast<std::size_t>(b)].arrows.push_back({{0, 0, 0}, {1.0, 1.0, 1.0}, {250, 200, 70, 255}, 0.03, shift});
    alone[static_cast<std::size_t>(b)].lines.push_back({{-1, 1, 0}, {1, 1.5, 0}, {255, 210, 120, 255}, 2, shift});
  }
  for (const Shot& one : alone) {
    row.books.push_back(one.books[0]);
    row.arrows.push_back(one.arrows[0]);
    row.lines.push_back(one.lines[0]);
  }
  const Image picture = draw(row, width, height);
  const auto place = [](int b) { return Rect{200 * b, 0, 200, height}; };
  for (int b = 0; b < 4; ++b) {
    const Image by_itself = draw(alone[static_cast<std::size_t>(b)], width, height);
    EXPECT_EQ(part(by_itself, place(b)).rgba, part(picture, place(b)).rgba) << b;
  }
  EXPECT_LE(largest_difference(part(picture, place(0)), part(picture, place(2))), 16);  // measured 0
  EXPECT_GT(largest_difference(part(picture, place(0)), part(picture, place(3))), 100);
}

// At no error a ghost traces its book's edges and changes nothing else: not a pixel beside the book, none of its cover.
TEST(Renderer, AGhostInItsBooksPoseTracesItsEdges) {
  Shot shot = shot_of(book_at(20, 30, 5));
  const Image solid = draw(shot);
  shot.books.push_back({shot.books[0].corners_W, BookStyle::ghost});
  const Image traced = draw(shot);
  const View view(shot.camera, solid.width, solid.height);
  const Corners& corners_W = shot.books[0].corners_W;
  const std::array<std::uint8_t, 3> background{shot.background.r, shot.background.g, shot.background.b};
  int changed = 0;
  for (int y = 0; y < solid.height; ++y) {
    for (int x = 0; x < solid.width; ++x) {
      if (std::equal(solid.pixel(x, y), solid.pixel(x, y) + 3, traced.pixel(x, y))) continue;
      ++changed;
      EXPECT_FALSE(std::equal(background.begin(), background.end(), solid.pixel(x, y))) << x << ", " << y;
    }
  }
  EXPECT_GT(changed, 500);
  EXPECT_LT(changed, 4000);
  for (double u = 0.15; u < 0.9; u += 0.01) {  // the front cover, 5 % from its edges
    for (double v = 0.05; v < 0.95; v += 0.01) {
      const PixelPoint p = view.project(corners_W.col(4) + u * (corners_W.col(5) - corners_W.col(4)) +
                                        v * (corners_W.col(6) - corners_W.col(4)));
      const auto x = static_cast<int>(p.x), y = static_cast<int>(p.y);
      ASSERT_TRUE(std::equal(solid.pixel(x, y), solid.pixel(x, y) + 3, traced.pixel(x, y))) << x << ", " << y;
    }
  }
}

TEST(Renderer, DrawsOnlyWhatChangedAndYetTheSameBytes) {
  Renderer incremental(480, 270, assets());
  Image previous(480, 270);
  for (const int frame : {0, 1, 2, 3, 4, 5, 5, 6, 12, 12, 13, 1, 0}) {
    const Image picture = incremental.draw(scene_at(frame));
    ASSERT_EQ(picture.rgba, draw(scene_at(frame)).rgba) << "frame " << frame;

    const std::vector<Rect>& changed = incremental.changed();
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const auto holds = [&](const Rect& rect) { return !intersection({x, y, 1, 1}, rect).empty(); };
        if (std::ranges::any_of(changed, holds)) continue;
        ASSERT_TRUE(std::equal(picture.pixel(x, y), picture.pixel(x, y) + 4, previous.pixel(x, y)))
            << "frame " << frame << ", pixel " << x << ", " << y << " changed outside changed()";
      }
    }
    previous = picture;
  }
}

TEST(Renderer, ABookAloneNeedsNoDepthBuffer) {
  Renderer renderer(480, 270, assets());
  for (int i = 0; i < 60; ++i) {
    Shot shot = shot_of(book_at(37.0 * i, 59.0 * i, 23.0 * i));
    shot.books[0].corners_W.col(i % 8) *= 1 + 0.0005 * i;  // a vibrating book: bent by up to 3 %
    const Image without = renderer.draw(shot);
    // An arrow that hides nothing, outside the frame: now depth decides.
    shot.arrows.push_back({{50, 0, 0}, {51, 0, 0}, {}, 0.02});
    const ImageDelta delta = compare(without, renderer.draw(shot), 8);
    EXPECT_LE(delta.share_above, 1e-4) << "pose " << i;  // measured at most 4.6e-5
  }
}

TEST(Renderer, EqualShotsChangeNothing) {
  Renderer renderer(480, 270, assets());
  renderer.draw(scene_at(5));
  EXPECT_EQ(pixels_of(renderer.changed()), 480 * 270);
  renderer.draw(scene_at(5));
  EXPECT_TRUE(renderer.changed().empty());
}

TEST(Renderer, ALabelThatChangesLeavesTheRestAlone) {
  Shot shot = scene_at(5);
  Renderer renderer(480, 270, assets());
  renderer.draw(shot);
  shot.labels[0].text = "t = 9";
  renderer.draw(shot);
  EXPECT_FALSE(renderer.changed().empty());
  EXPECT_LT(pixels_of(renderer.changed()), 480 * 270 / 50);  // measured 1/200
}

TEST(Renderer, ThreadsDrawTheSameBytes) {
  constexpr int frames = 4;
  std::vector<Image> alone;
  alone.reserve(frames);
  for (int frame = 0; frame < frames; ++frame) alone.push_back(draw(scene_at(3 * frame)));

  std::vector<std::vector<Image>> together(4);
  std::vector<std::thread> threads;
  threads.reserve(together.size());
  for (auto& pictures : together) {
    threads.emplace_back([&pictures] {
      Renderer renderer(480, 270, assets());
      for (int frame = 0; frame < frames; ++frame) pictures.push_back(renderer.draw(scene_at(3 * frame)));
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& pictures : together) {
    ASSERT_EQ(pictures.size(), alone.size());
    for (std::size_t i = 0; i < alone.size(); ++i) EXPECT_EQ(pictures[i].rgba, alone[i].rgba);
  }
}

TEST(Renderer, FrontCoverFacesPlusZAndItsTitleIsAtTheBottom) {
  const Shot shot = shot_of(book_at(0, 0, 0));
  const Image image = draw(shot);
  const auto seen = [&](double x, double y) {
    return pixel_at(image, View(shot.camera, 480, 270).project({x, y, 0.25}));
  };
  EXPECT_TRUE(is_yellow(seen(-0.6, 1.3)));
  EXPECT_TRUE(is_yellow(seen(0.85, 1.3)));
  EXPECT_TRUE(is_blue(seen(0.85, -1.35)));
  // "Classical" is shorter than "Mechanics" below it: upright, not mirrored. Right of "Classical" there is blue, at the
  // same distance from the spine in "Mechanics" there is cream.
  const auto cream = [&](double x0, double x1, double y) {
    int count = 0;
    for (int i = 0; i < 20; ++i) count += is_paper(seen(x0 + (x1 - x0) * i / 20, y)) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(cream(0.55, 0.75, -0.78), 0);
  EXPECT_GT(cream(0.35, 0.75, -1.12), 5);
  EXPECT_EQ(cream(-0.8, -0.74, -0.78), 0);  // the margin is on the left
}

TEST(Renderer, SpineIsAtMinusXAndPagesOnTheOtherSides) {
  const auto side = [&](double about_x, double about_y) {
    return pixel_at(draw(shot_of(book_at(about_x, about_y, 0))), {240.5, 130.5, 0});
  };
  EXPECT_TRUE(is_paper(side(0, -90)));  // +x towards the eye
  EXPECT_TRUE(is_paper(side(90, 0)));   // +y
  EXPECT_TRUE(is_paper(side(-90, 0)));  // -y
  const Image spine = draw(shot_of(book_at(0, 90, 0)));
  EXPECT_TRUE(is_blue(pixel_at(spine, {240.5, 240, 0})));
  EXPECT_TRUE(is_blue(pixel_at(draw(shot_of(book_at(0, 180, 0))), {240.5, 225, 0})));  // the back cover, below its text
}

TEST(Renderer, SurvivesAnyCorners) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Image background = draw(Shot{});
  Renderer renderer(480, 270, assets());
  Shot shot = shot_of(book_at(20, 30, 0));
  for (const double bad : {nan, inf, -inf, 1e300, 1e12}) {  // not drawn
    shot.books[0].corners_W = book_at(20, 30, 0);
    shot.books[0].corners_W(1, 3) = bad;
    EXPECT_EQ(renderer.draw(shot).rgba, background.rgba) << bad;
  }
  for (const double scale : {0.0, 1e-300, 1e-9, 5.0, 1e3, 1e5, -1.0, -1e4}) {  // drawn, whatever comes of it
    shot.books[0].corners_W = scale * book_at(20, 30, 0);
    EXPECT_NO_THROW(renderer.draw(shot)) << scale;
  }
  Corners flat = book_at(20, 30, 0);
  flat.row(2).setZero();
  shot.books[0].corners_W = flat;
  shot.arrows.push_back({{0, 0, 0}, {nan, 0, 0}, {}, 0.1});
  shot.arrows.push_back({{0, 0, 0}, {0, 0, 0}, {}, 0.1});
  shot.lines.push_back({{inf, 0, 0}, {0, 0, 0}, {}, 2});
  shot.lines.push_back({{0, 0, -5}, {0.1, 0, 50}, {255, 0, 0, 255}, 2});  // from before to behind the eye
  shot.labels.push_back({"nowhere", {0, 0}, Eigen::Vector3d(nan, 0, 0), 0.05, {}, Align::left, Weight::regular, false});
  shot.labels.push_back({"\xff\xe2\x82", {0.5, 0.5}, {}, 0.05, {}, Align::left, Weight::regular, false});  // no UTF-8
  const Image picture = renderer.draw(shot);
  EXPECT_EQ(picture.rgba, draw(shot).rgba);
}

TEST(Renderer, TabularFiguresDoNotMove) {
  Shot shot;
  shot.labels.push_back({"1117", {0.1, 0.5}, {}, 0.2, {255, 255, 255, 255}, Align::left, Weight::regular, true});
  const Image ones = draw(shot);
  shot.labels[0].text = "8887";
  const Image eights = draw(shot);
  // The last digit, the same in both, starts 3 digits of 0.65 em on.
  int first_column = 480;
  for (int x = 48 + 3 * 34; x < 480; ++x) {
    for (int y = 0; y < 270; ++y) {
      if (*ones.pixel(x, y) > 200) first_column = std::min(first_column, x);
    }
  }
  ASSERT_LT(first_column, 480);
  for (int y = 0; y < 270; ++y) {
    for (int x = first_column; x < 480; ++x) {
      ASSERT_EQ(*ones.pixel(x, y), *eights.pixel(x, y)) << x << ", " << y;
    }
  }
}

class Assets : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(BOOKSPIN_BINARY_DIR) / "tests" / "assets_test";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    fs::copy(assets() / "shaders", folder_ / "shaders");
    fs::copy(assets() / "textures", folder_ / "textures");
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_F(Assets, BadShaderIsNamedWithItsLog) {
  std::ofstream(folder_ / "shaders" / "book.frag") << "#version 330 core\nvoid main() { color = nothing; }\n";
  EXPECT_THAT([&] { Renderer(64, 64, folder_); },
              ThrowsMessage<std::runtime_error>(
                  AllOf(HasSubstr("book.frag"), HasSubstr("compile shader"), HasSubstr("nothing"))));
  fs::remove(folder_ / "shaders" / "book.frag");
  EXPECT_THAT([&] { Renderer(64, 64, folder_); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("book.frag"), HasSubstr("No such file"))));
}

TEST_F(Assets, MissingTextureIsNamed) {
  fs::remove(folder_ / "textures" / "spine.png");
  EXPECT_THAT([&] { Renderer(64, 64, folder_); },
              ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("spine.png"), HasSubstr("No such file"))));
}

}  // namespace
}  // namespace bookspin

int main(int argc, char** argv) {
  return bookspin::run_tests_with_goldens(argc, argv, "render");
}
