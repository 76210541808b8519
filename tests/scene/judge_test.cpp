// Verdicts on made-up motions: what binds every frame, what some frame, and what no number does to either.
#include "scene/judge.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace bookspin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

struct Case {
  const char* name;
  std::vector<double> tilts;
  std::optional<double> at_least = {}, at_most = {}, rises_to = {}, falls_to = {};
  int first_frame = 0;
  std::optional<int> last_frame = {};
  bool met = false;
  const char* text;
};

class Judged : public testing::TestWithParam<Case> {};

TEST_P(Judged, IsMetOrNotAndSaysWhy) {
  const Case& c = GetParam();
  Scene scene;
  scene.books.resize(2);
  Trajectory trajectory;
  trajectory.books.resize(2);
  for (const double tilt : c.tilts) {
    BookFrame f;
    f[Q::tilt] = tilt;
    trajectory.books[1].frames.push_back(f);
    f[Q::tilt] = -1e9;  // book 0 must not be looked at
    trajectory.books[0].frames.push_back(f);
  }
  Expectation e;
  e.says = "the words";
  e.quantity = Q::tilt;
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

// clang-format off
const Case cases[] = {
    {.name = "AtMostMet", .tilts = {1, 3, 2}, .at_most = 3.0, .met = true,
     .text = "tilt at most 3 degrees in frames 0 to 2: found 3 in frame 1"},
    {.name = "AtMostBrokenOnce", .tilts = {1, 3.5, 2}, .at_most = 3.0,
     .text = "tilt at most 3 degrees in frames 0 to 2: found 3.5 in frame 1"},
    {.name = "AtLeastMet", .tilts = {5, 4, 9}, .at_least = 4.0, .met = true,
     .text = "tilt at least 4 degrees in frames 0 to 2: found 4 in frame 1"},
    {.name = "AtLeastBrokenOnce", .tilts = {5, 3, 9}, .at_least = 4.0,
     .text = "tilt at least 4 degrees in frames 0 to 2: found 3 in frame 1"},
    {.name = "RisesToMet", .tilts = {0, 8, 0}, .rises_to = 8.0, .met = true,
     .text = "tilt rises to 8 degrees in frames 0 to 2: found 8 in frame 1"},
    {.name = "RisesToMissed", .tilts = {0, 7, 1}, .rises_to = 8.0,
     .text = "tilt rises to 8 degrees in frames 0 to 2: found 7 in frame 1"},
    {.name = "FallsToMet", .tilts = {9, 2, 9}, .falls_to = 2.0, .met = true,
     .text = "tilt falls to 2 degrees in frames 0 to 2: found 2 in frame 1"},
    {.name = "FallsToMissed", .tilts = {9, 3, 9}, .falls_to = 2.0,
     .text = "tilt falls to 2 degrees in frames 0 to 2: found 3 in frame 1"},
    {.name = "OutsideTheRangeNothingCounts", .tilts = {99, 1, 2, 99}, .at_most = 3.0, .first_frame = 1, .last_frame = 2, .met = true,
     .text = "tilt at most 3 degrees in frames 1 to 2: found 2 in frame 2"},
    {.name = "RangeIncludesItsEnds", .tilts = {0, 9, 1, 9}, .at_most = 3.0, .first_frame = 2, .last_frame = 3,
     .text = "tilt at most 3 degrees in frames 2 to 3: found 9 in frame 3"},
    {.name = "OpenRangeGoesToTheEnd", .tilts = {9, 1, 1, 9}, .at_most = 3.0, .first_frame = 1,
     .text = "tilt at most 3 degrees in frames 1 to 3: found 9 in frame 3"},
    {.name = "OneFrame", .tilts = {9, 1, 9}, .at_most = 3.0, .first_frame = 1, .last_frame = 1, .met = true,
     .text = "tilt at most 3 degrees in frame 1: found 1"},
    {.name = "RiseOutsideTheRange", .tilts = {9, 1, 1}, .rises_to = 8.0, .first_frame = 1, .last_frame = 2,
     .text = "tilt rises to 8 degrees in frames 1 to 2: found 1 in frame 1"},
    {.name = "NoNumberBreaksAtMost", .tilts = {1, nan, 2}, .at_most = 3.0,
     .text = "tilt at most 3 degrees in frames 0 to 2: found nan in frame 1"},
    {.name = "NoNumberAtFirstBreaksAtMost", .tilts = {nan, 1, 2}, .at_most = 3.0,
     .text = "tilt at most 3 degrees in frames 0 to 2: found nan in frame 0"},
    {.name = "NoNumberBreaksAtLeast", .tilts = {7, nan, 9}, .at_least = 3.0,
     .text = "tilt at least 3 degrees in frames 0 to 2: found nan in frame 1"},
    {.name = "NoNumberDoesNotHideARise", .tilts = {nan, 9, nan}, .rises_to = 8.0, .met = true,
     .text = "tilt rises to 8 degrees in frames 0 to 2: found 9 in frame 1"},
    {.name = "NoNumbersAtAllDoNotRise", .tilts = {nan, nan}, .rises_to = 8.0,
     .text = "tilt rises to 8 degrees in frames 0 to 1: found nan in frame 0"},
    {.name = "NoNumbersAtAllDoNotFall", .tilts = {nan, nan}, .falls_to = 8.0,
     .text = "tilt falls to 8 degrees in frames 0 to 1: found nan in frame 0"},
    {.name = "FrameBeyondTheEnd", .tilts = {1, 1}, .at_most = 3.0, .first_frame = 2, .last_frame = 2,
     .text = "tilt at most 3 degrees in frame 2: the film ends at frame 1"},
    {.name = "RangeBeyondTheEnd", .tilts = {1, 1}, .at_most = 3.0, .last_frame = 2,
     .text = "tilt at most 3 degrees in frames 0 to 2: the film ends at frame 1"},
    {.name = "FoundIsSaidToAsManyDigitsAsTellItsSide", .tilts = {56.42547}, .at_most = 56.426, .first_frame = 0, .last_frame = 0, .met = true,
     .text = "tilt at most 56.426 degrees in frame 0: found 56.425"},
    {.name = "InfinityRises", .tilts = {1, inf}, .rises_to = 8.0, .met = true,
     .text = "tilt rises to 8 degrees in frames 0 to 1: found inf in frame 1"},
};
// clang-format on

INSTANTIATE_TEST_SUITE_P(Cases, Judged, testing::ValuesIn(cases),
                         [](const testing::TestParamInfo<Case>& one) { return one.param.name; });

TEST(Judge, GivesOneVerdictABoundInTheScenesOrder) {
  Scene scene;
  scene.books.resize(1);
  Trajectory trajectory;
  trajectory.books.resize(1);
  trajectory.books[0].frames.assign(3, BookFrame{});
  trajectory.books[0].frames[2][Q::exploded] = 1.0;
  Expectation e;
  e.quantity = Q::exploded;
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

TEST(Quantities, HaveNamesOfTheirOwnAndAllThatIsShown) {
  std::set<std::string_view> names;
  for (const Quantity& q : quantities) {
    EXPECT_TRUE(names.insert(q.name).second) << q.name;
    for (const std::string_view text : {q.meaning, q.symbol, q.format, q.title}) EXPECT_FALSE(text.empty()) << q.name;
    EXPECT_NE(fmt::format(fmt::runtime(q.format), 1.0), "") << q.name;
    EXPECT_GT(q.shown_scale, 0.0) << q.name;
    EXPECT_LE(q.axis.low, q.axis.high) << q.name;
  }
}

}  // namespace
}  // namespace bookspin
