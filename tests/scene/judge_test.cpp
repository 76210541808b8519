// Verdicts on made-up motions: what binds every frame, what some frame, and what no number does to either.
#include "scene/judge.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "scene/quantities.h"

namespace bookspin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

BookFrame still_frame() {
  BookFrame f{};
  f.corners_W.setZero();
  f.q_WB.setIdentity();
  f.L_W.setZero();
  return f;
}

struct Case {
  const char* name;
  std::vector<double> tilts;
  std::optional<double> at_least, at_most, rises_to, falls_to;
  int first_frame;
  std::optional<int> last_frame;
  bool met;
  const char* text;
};

class Judged : public testing::TestWithParam<Case> {};

TEST_P(Judged, is_met_or_not_and_says_why) {
  const Case& c = GetParam();
  Scene scene;
  scene.books.resize(2);
  Trajectory trajectory;
  trajectory.books.resize(2);
  for (const double tilt : c.tilts) {
    BookFrame f = still_frame();
    f.tilt = tilt;
    trajectory.books[1].frames.push_back(f);
    f.tilt = -1e9;  // book 0 must not be looked at
    trajectory.books[0].frames.push_back(f);
  }
  Expectation e;
  e.says = "the words";
  e.quantity = find_quantity("tilt");
  e.book = 1;
  e.first_frame = c.first_frame;
  e.last_frame = c.last_frame;
  e.at_least = c.at_least;
  e.at_most = c.at_most;
  e.rises_to = c.rises_to;
  e.falls_to = c.falls_to;
  scene.expectations.push_back(e);
  const std::vector<Verdict> verdicts = judge(scene, trajectory);
  ASSERT_EQ(verdicts.size(), 1U);
  EXPECT_EQ(verdicts[0].met, c.met);
  EXPECT_EQ(verdicts[0].text, c.text);
  EXPECT_EQ(verdicts[0].says, "the words");
}

const Case cases[] = {
    {"at_most_met",
     {1, 3, 2},
     {},
     3.0,
     {},
     {},
     0,
     {},
     true,
     "tilt at most 3 degrees in frames 0 to 2: found 3 in frame 1"},
    {"at_most_broken_once",
     {1, 3.5, 2},
     {},
     3.0,
     {},
     {},
     0,
     {},
     false,
     "tilt at most 3 degrees in frames 0 to 2: found 3.5 in frame 1"},
    {"at_least_met",
     {5, 4, 9},
     4.0,
     {},
     {},
     {},
     0,
     {},
     true,
     "tilt at least 4 degrees in frames 0 to 2: found 4 in frame 1"},
    {"at_least_broken_once",
     {5, 3, 9},
     4.0,
     {},
     {},
     {},
     0,
     {},
     false,
     "tilt at least 4 degrees in frames 0 to 2: found 3 in frame 1"},
    {"rises_to_met",
     {0, 8, 0},
     {},
     {},
     8.0,
     {},
     0,
     {},
     true,
     "tilt rises to 8 degrees in frames 0 to 2: found 8 in frame 1"},
    {"rises_to_missed",
     {0, 7, 1},
     {},
     {},
     8.0,
     {},
     0,
     {},
     false,
     "tilt rises to 8 degrees in frames 0 to 2: found 7 in frame 1"},
    {"falls_to_met",
     {9, 2, 9},
     {},
     {},
     {},
     2.0,
     0,
     {},
     true,
     "tilt falls to 2 degrees in frames 0 to 2: found 2 in frame 1"},
    {"falls_to_missed",
     {9, 3, 9},
     {},
     {},
     {},
     2.0,
     0,
     {},
     false,
     "tilt falls to 2 degrees in frames 0 to 2: found 3 in frame 1"},
    {"outside_the_range_nothing_counts",
     {99, 1, 2, 99},
     {},
     3.0,
     {},
     {},
     1,
     2,
     true,
     "tilt at most 3 degrees in frames 1 to 2: found 2 in frame 2"},
    {"range_includes_its_ends",
     {0, 9, 1, 9},
     {},
     3.0,
     {},
     {},
     2,
     3,
     false,
     "tilt at most 3 degrees in frames 2 to 3: found 9 in frame 3"},
    {"open_range_goes_to_the_end",
     {9, 1, 1, 9},
     {},
     3.0,
     {},
     {},
     1,
     {},
     false,
     "tilt at most 3 degrees in frames 1 to 3: found 9 in frame 3"},
    {"one_frame", {9, 1, 9}, {}, 3.0, {}, {}, 1, 1, true, "tilt at most 3 degrees in frame 1: found 1"},
    {"rise_outside_the_range",
     {9, 1, 1},
     {},
     {},
     8.0,
     {},
     1,
     2,
     false,
     "tilt rises to 8 degrees in frames 1 to 2: found 1 in frame 1"},
    {"no_number_breaks_at_most",
     {1, nan, 2},
     {},
     3.0,
     {},
     {},
     0,
     {},
     false,
     "tilt at most 3 degrees in frames 0 to 2: found nan in frame 1"},
    {"no_number_at_first_breaks_at_most",
     {nan, 1, 2},
     {},
     3.0,
     {},
     {},
     0,
     {},
     false,
     "tilt at most 3 degrees in frames 0 to 2: found nan in frame 0"},
    {"no_number_breaks_at_least",
     {7, nan, 9},
     3.0,
     {},
     {},
     {},
     0,
     {},
     false,
     "tilt at least 3 degrees in frames 0 to 2: found nan in frame 1"},
    {"no_number_does_not_hide_a_rise",
     {nan, 9, nan},
     {},
     {},
     8.0,
     {},
     0,
     {},
     true,
     "tilt rises to 8 degrees in frames 0 to 2: found 9 in frame 1"},
    {"no_numbers_at_all_do_not_rise",
     {nan, nan},
     {},
     {},
     8.0,
     {},
     0,
     {},
     false,
     "tilt rises to 8 degrees in frames 0 to 1: found nan in frame 0"},
    {"no_numbers_at_all_do_not_fall",
     {nan, nan},
     {},
     {},
     {},
     8.0,
     0,
     {},
     false,
     "tilt falls to 8 degrees in frames 0 to 1: found nan in frame 0"},
    {"frame_beyond_the_end",
     {1, 1},
     {},
     3.0,
     {},
     {},
     2,
     2,
     false,
     "tilt at most 3 degrees in frame 2: the film ends at frame 1"},
    {"range_beyond_the_end",
     {1, 1},
     {},
     3.0,
     {},
     {},
     0,
     2,
     false,
     "tilt at most 3 degrees in frames 0 to 2: the film ends at frame 1"},
    {"infinity_rises",
     {1, std::numeric_limits<double>::infinity()},
     {},
     {},
     8.0,
     {},
     0,
     {},
     true,
     "tilt rises to 8 degrees in frames 0 to 1: found inf in frame 1"},
};

INSTANTIATE_TEST_SUITE_P(Cases, Judged, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

TEST(Judge, gives_one_verdict_a_bound_in_the_scenes_order) {
  Scene scene;
  scene.books.resize(1);
  Trajectory trajectory;
  trajectory.books.resize(1);
  trajectory.books[0].frames.assign(3, still_frame());
  trajectory.books[0].frames[2].exploded = true;
  Expectation e;
  e.quantity = find_quantity("exploded");
  e.at_least = 0.0;
  e.at_most = 0.5;
  e.rises_to = 1.0;
  e.falls_to = 0.0;
  scene.expectations = {e, e};
  scene.expectations[1].at_least.reset();
  const std::vector<Verdict> verdicts = judge(scene, trajectory);
  std::vector<bool> met;
  for (const Verdict& v : verdicts) met.push_back(v.met);
  EXPECT_EQ(met, (std::vector<bool>{true, false, true, true, false, true, true}));
  EXPECT_EQ(verdicts[1].text, "exploded at most 0.5 in frames 0 to 2: found 1 in frame 2");  // no unit, no space
  EXPECT_EQ(verdicts[1].found, 1.0);
  EXPECT_EQ(verdicts[1].frame, 2);
}

TEST(Quantities, have_names_of_their_own_and_can_be_found) {
  for (const Quantity& q : quantities()) {
    EXPECT_EQ(find_quantity(q.name), &q);
    EXPECT_FALSE(q.meaning.empty());
  }
  EXPECT_EQ(find_quantity("tlt"), nullptr);
  EXPECT_EQ(find_quantity(""), nullptr);
}

// Each quantity reads its own field: fields are given values of their own and come back under their names.
TEST(Quantities, read_the_field_of_their_name) {
  BookFrame f = still_frame();
  f.tilt = 1;
  f.flips = 2;
  f.stretch = 3;
  f.kinetic_energy = 4;
  f.elastic_energy = 5;
  f.energy_ratio = 6;
  f.angular_momentum_ratio = 7;
  f.norm = 8;
  f.largest_singular_value = 9;
  f.orthogonality_defect = 10;
  f.blend_defect = 11;
  f.pulsations = 12;
  f.angle_error = 13;
  f.extent = 14;
  f.floor_hits = 15;
  f.exploded = true;
  const char* names[] = {"tilt",
                         "flips",
                         "stretch",
                         "kinetic_energy",
                         "elastic_energy",
                         "energy_ratio",
                         "angular_momentum_ratio",
                         "norm",
                         "largest_singular_value",
                         "orthogonality_defect",
                         "blend_defect",
                         "pulsations",
                         "angle_error",
                         "extent",
                         "floor_hits"};
  double expected = 0;
  for (const char* name : names) EXPECT_EQ(find_quantity(name)->of(f), ++expected) << name;
  EXPECT_EQ(find_quantity("exploded")->of(f), 1.0);
  EXPECT_EQ(quantities().size(), std::size(names) + 1);
}

}  // namespace
}  // namespace bookspin
