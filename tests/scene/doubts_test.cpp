// Films that are wrong in silence are found, with the reason; those that say it themselves, or are right, are not.

#include "scene/doubts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

using testing::HasSubstr;

std::vector<Doubt> doubts(const std::string& clip, const std::string& book, const std::string& more = "") {
  const Scene scene = parse_scene("title = 'T'\nclip = {" + clip + "}\n" + more + "[[book]]\n" + book, "s.toml");
  return doubts_about(scene, simulate(scene));
}

const std::string tumble = "frames = 600, time_per_frame = 0.5, substeps = 1";
const std::string flipping = "method = 'matrix'\nangular_velocity = [0.115, 1e-3, 0]\n";

TEST(Doubts, SayWhyABookLeftTheTrueOne) {
  const auto why = [](const std::vector<Doubt>& found) { return found.empty() ? "no doubt" : found[0].why; };
  EXPECT_THAT(why(doubts(tumble, flipping)), HasSubstr("from the separatrix (2 E I / L^2 - 1) and has moved by"));
  EXPECT_THAT(why(doubts(tumble, "method = 'springs'\nangular_velocity = [0.115, 1e-3, 0]\n")),
              HasSubstr("a motion of their own"));
  EXPECT_THAT(why(doubts(tumble, "method = 'quaternion'\nintegrator = 'rk4'\nangular_velocity = [2.8, 0, 0.5]\n")),
              HasSubstr("a step turns it by 1.6 rad"));
  EXPECT_THAT(why(doubts("frames = 1300, time_per_frame = 1.0, substeps = 2",
                         "method = 'quaternion'\nintegrator = 'dmv'\nangular_velocity = [0.115, 1e-13, 0]\n")),
              HasSubstr("so near to the separatrix that rounding decides"));
  EXPECT_THAT(why(doubts("frames = 3000, time_per_frame = 1.0, substeps = 2",
                         "method = 'quaternion'\nintegrator = 'rk4'\nangular_velocity = [0, 0.5, 0.3]\n")),
              HasSubstr("the error of rk4 has added up"));
}

TEST(Doubts, BeginWhereTheErrorIsSeen) {
  const Scene scene = parse_scene("title = 'T'\nclip = {" + tumble + "}\n[[book]]\n" + flipping, "s.toml");
  const Trajectory trajectory = simulate(scene);
  const std::vector<Doubt> found = doubts_about(scene, trajectory);
  ASSERT_EQ(found.size(), 1U);
  const auto error_at = [&](int frame) {
    return trajectory.books[0].frames[static_cast<std::size_t>(frame)][Q::angle_error];
  };
  EXPECT_LE(error_at(found[0].frame - 1), visible_error);
  EXPECT_GT(error_at(found[0].frame), visible_error);
  EXPECT_GT(found[0].error, 3.0);  // measured 3.14
}

TEST(Doubts, NoneWhereItIsRightOrSaid) {
  EXPECT_TRUE(doubts(tumble, "method = 'exact'\nangular_velocity = [0.115, 1e-3, 0]\n").empty());
  EXPECT_TRUE(
      doubts(tumble, "method = 'quaternion'\nintegrator = 'dmv'\nangular_velocity = [0.115, 1e-3, 0]\n").empty());
  EXPECT_TRUE(doubts(tumble, flipping + "show = ['exact']\n").empty());
  EXPECT_TRUE(doubts(tumble, flipping, "view = { head_up = ['exact_flips'] }\n").empty());
  EXPECT_TRUE(doubts(tumble, flipping + "[[book]]\nmethod = 'exact'\nangular_velocity = [0.115, 1e-3, 0]\n").empty());
  EXPECT_TRUE(doubts(tumble, flipping + "[[expect]]\nsays = 'far'\nquantity = 'angle_error'\nrises_to = 1\n").empty());
  EXPECT_FALSE(doubts(tumble, flipping + "[[expect]]\nsays = 'it tilts'\nquantity = 'tilt'\nrises_to = 1\n").empty());
  // An explosion in frame 1, from where on the error is another matter.
  EXPECT_TRUE(doubts("frames = 20, time_per_frame = 5.0, substeps = 1",
                     "method = 'springs'\nnormalize = false\nangular_velocity = [3, 0, 0]\n")
                  .empty());
}

}  // namespace
}  // namespace bookspin
