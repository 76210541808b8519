// The numbers that the course page's own text names: each is computed anew, and the page must say what comes out.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <regex>

#include "dynamics/book.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path project = BOOKSPIN_SOURCE_DIR;
constexpr double spin = 0.11482;  // about x, in most films

std::string page() {
  return std::regex_replace(read_text(project / "videos/page/template.html"), std::regex("<[^>]*>"), "");
}

Scene script(const char* name, const std::vector<std::string>& overrides) {
  return load_scene(project / "videos" / name, overrides);
}

// When the tilt of a scene's first book passes the bound.
double time_of_tilt(const Scene& scene, double degrees) {
  const auto frames = simulate(scene).books[0].frames;
  const auto found =
      std::find_if(frames.begin(), frames.end(), [&](const BookFrame& f) { return f[Q::tilt] > degrees; });
  return static_cast<double>(found - frames.begin()) * scene.clip.time_per_frame;
}

struct PageNumbers : testing::Test {
  const Eigen::Array3d size = BookOptions().size.array();
  const double Ix = size.y() * size.y() + size.z() * size.z();
  const double Iy = size.x() * size.x() + size.z() * size.z();
  const double Iz = size.x() * size.x() + size.y() * size.y();
  const double sigma = spin * std::sqrt((Ix - Iy) * (Iz - Ix) / (Iy * Iz));
};

TEST_F(PageNumbers, MomentsOfInertia) {
  EXPECT_THAT(page(), HasSubstr(fmt::format("for the book {:.1f}, {:.1f} and {:.1f}, apart from", Ix, Iy, Iz)));
}

TEST_F(PageNumbers, ATurnAndItsGrowth) {
  const double turn = 2.0 * std::numbers::pi / spin;
  EXPECT_THAT(page(), HasSubstr(fmt::format("the book turns once in {:.0f} of them", turn)));
  EXPECT_THAT(page(), HasSubstr(fmt::format("error grows {:.0f}-fold", std::exp(sigma * turn))));
  EXPECT_THAT(page(), HasSubstr(fmt::format("≈{:.0f} units of time", std::log(100.0) / sigma)));
}

TEST_F(PageNumbers, WhatACarefulHandWouldSee) {
  const auto tilt_after_a_turn = [](const char* jiggle) {
    const Scene scene = script("separatrix.toml", {std::string("book.0.jiggle=") + jiggle, "clip.time_per_frame=0.547",
                                                   "clip.frames=101"});  // 54.7
    return simulate(scene).books[0].frames.back()[Q::tilt];
  };
  EXPECT_THAT(page(), HasSubstr(fmt::format("come round {:.1f} degrees off", tilt_after_a_turn("1e-4"))));
  EXPECT_THAT(page(), HasSubstr(fmt::format("one of a hundredth it is {:.0f} degrees off", tilt_after_a_turn("1e-2"))));
  EXPECT_THAT(page(), HasSubstr("it lies on its side"));
  EXPECT_NEAR(tilt_after_a_turn("0.1"), 90.0, 3.0);  // 89.7
}

TEST_F(PageNumbers, RoundingAloneTurnsTheBookOver) {
  const double t = time_of_tilt(script("fig05_unstable_x.toml", {"book.0.jiggle=0", "clip.frames=1400"}), 90.0);
  EXPECT_THAT(page(), HasSubstr(fmt::format("on its side after about {:.0f} units of time, ten turns",
                                            std::round(t / 50.0) * 50.0)));
  EXPECT_EQ(std::round(t * spin / (2.0 * std::numbers::pi)), 10.0);
}

// Damped springs blow up from the first step above the limit on.
TEST_F(PageNumbers, TheLongestStepOfDampedSprings) {
  std::smatch found;
  const std::string text = page();
  ASSERT_TRUE(std::regex_search(text, found, std::regex("explicit Euler needs h below about (0[.][0-9]+)")));
  const double limit = std::stod(found[1]);
  const auto stretch_after = [](double h) {
    const Scene scene =
        script("fig05_unstable_x.toml", {"book.0.normalize=false", "clip.frames=200", "clip.substeps=10",
                                         fmt::format("clip.time_per_frame={}", 10.0 * h)});
    const auto track = simulate(scene).books[0];
    return track.exploded_frame ? HUGE_VAL : track.frames.back()[Q::stretch];
  };
  EXPECT_LT(stretch_after(0.9 * limit), 0.01);
  EXPECT_GT(stretch_after(1.1 * limit), 0.01);
}

// r grows by sqrt(1 + h^2 omega^2) a step: as drawn.
TEST_F(PageNumbers, EulerLeavesTheCircleAsDrawn) {
  const std::string drawing = read_text(project / "videos/page/euler.svg");
  std::smatch found;
  ASSERT_TRUE(std::regex_search(
      drawing, found, std::regex("<circle class=\"thin\" cx=\"([0-9.]+)\" cy=\"([0-9.]+)\" r=\"([0-9.]+)\"")));
  const double cx = std::stod(found[1]);
  const double cy = std::stod(found[2]);
  double r = std::stod(found[3]);
  ASSERT_TRUE(std::regex_search(drawing, found, std::regex("class=\"strong\" points=\"([^\"]*)\"")));
  std::istringstream points(found[1]);
  double x = 0.0;
  double y = 0.0;
  char comma = 0;
  int count = 0;
  for (; points >> x >> comma >> y; ++count, r *= std::sqrt(1.25)) EXPECT_NEAR(std::hypot(x - cx, y - cy), r, 0.1);
  EXPECT_EQ(count, 8);
  EXPECT_THAT(page(), HasSubstr("Seven steps with hω=0.5"));
}

TEST_F(PageNumbers, TheDrawnBookHas28Springs) {
  const std::string drawing = read_text(project / "videos/page/springs.svg");
  const std::regex two_ends("points=\"[0-9.]+,[0-9.]+ [0-9.]+,[0-9.]+\"");
  EXPECT_EQ(std::distance(std::sregex_iterator(drawing.begin(), drawing.end(), two_ends), std::sregex_iterator()),
            28 + 3);  // and a key of three lines
}

}  // namespace
}  // namespace bookspin
