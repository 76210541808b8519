// Every script in videos/: it loads, and its film would meet what it expects.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/judge.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

const char* const figures[] = {"fig01_axes",
                               "fig02_experiment",
                               "fig03_stable_z",
                               "fig04_stable_y",
                               "fig05_unstable_x",
                               "fig06_undamped",
                               "fig07_unnormalized",
                               "fig08_neither",
                               "fig09_matrix",
                               "fig09b_matrix_large_step",
                               "fig10_matrix_unnormalized",
                               "fig11_quaternion_unnormalized",
                               "fig12_pulsating_quaternion"};

fs::path folder() {
  return fs::path(BOOKSPIN_SOURCE_DIR) / "videos";
}

// The figures', and those of the gallery as "more/NAME".
std::vector<std::string> scripts() {
  std::vector<std::string> names;
  for (const char* part : {"", "more/"}) {
    for (const auto& entry : fs::directory_iterator(folder() / part)) {
      if (entry.path().extension() == ".toml") names.push_back(part + entry.path().stem().string());
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

TEST(Videos, HoldsEveryFigureOfThePaper) {
  const std::vector<std::string> names = scripts();
  for (const char* figure : figures)
    EXPECT_TRUE(std::find(names.begin(), names.end(), figure) != names.end()) << figure;
}

class Video : public testing::TestWithParam<std::string> {};

TEST_P(Video, MeetsWhatItsScriptExpects) {
  const Scene scene = load_scene(folder() / (GetParam() + ".toml"));
  EXPECT_FALSE(scene.title.empty());
  EXPECT_FALSE(scene.caption.empty());
  EXPECT_TRUE(remarks_on(scene).empty());
  const Trajectory trajectory = simulate(scene);
  ASSERT_EQ(trajectory.books.size(), scene.books.size());
  for (const BookTrack& track : trajectory.books)
    ASSERT_EQ(track.frames.size(), static_cast<std::size_t>(scene.clip.frames));
  if (scene.clip.frames > 1) {  // a film: 10 to 20 s, in the gallery up to 31, with a claim
    EXPECT_FALSE(scene.expectations.empty());
    EXPECT_GE(scene.clip.frames, 10 * scene.clip.fps);
    EXPECT_LE(scene.clip.frames, (GetParam().starts_with("more/") ? 31 : 20) * scene.clip.fps);
  }
  for (const Verdict& verdict : judge(scene, trajectory))
    EXPECT_TRUE(verdict.met) << verdict.says << "\n  " << verdict.text;
}

INSTANTIATE_TEST_SUITE_P(All, Video, testing::ValuesIn(scripts()), [](const testing::TestParamInfo<std::string>& one) {
  std::string name = one.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
});

// Every expectation of every film with what takes its cause away: then it must fail.
struct Cause {
  std::string film;
  std::vector<std::string> taken_away;  // overrides
  std::vector<std::string> claims;      // their words, as many from the beginning as tell which
};

const std::string about_x = "angular_velocity=[0.11482, 0, 0]";
const std::string about_y = "angular_velocity=[0, 0.11482, 0]";

const std::vector<Cause>& causes() {
  static const std::vector<Cause> table{
      {"fig02_experiment", {"book.0." + about_x}, {"the spin about z"}},
      {"fig02_experiment", {"book.1." + about_x}, {"the spin about y"}},
      {"fig02_experiment", {"book.2." + about_y}, {"the book spun about x"}},
      {"fig03_stable_z", {"book.0." + about_x}, {"the spin axis stays"}},
      {"fig03_stable_z", {"book.0.jiggle=0.01"}, {"the book wobbles"}},
      {"fig03_stable_z", {"book.0.damping=0"}, {"the book keeps its shape"}},
      {"fig04_stable_y", {"book.0." + about_x}, {"the spin axis stays"}},
      {"fig04_stable_y", {"book.0.jiggle=0.01"}, {"the book wobbles"}},
      {"fig04_stable_y", {"book.0.damping=0"}, {"the book keeps its shape"}},
      {"fig05_unstable_x", {"book.0.jiggle=1e-2"}, {"for the first quarter", "where the exact book turns over once"}},
      {"fig05_unstable_x", {"book.0." + about_y}, {"then it turns over, as"}},
      {"fig05_unstable_x", {"clip.substeps=6"}, {"through most of that flip"}},
      {"fig05_unstable_x", {"book.0.method=exact"}, {"then it turns over again and again"}},
      {"fig05_unstable_x", {"book.0.damping=0"}, {"the book keeps its shape"}},
      {"fig06_undamped", {"book.0.damping=1"}, {"the angular momentum falls", "for half of the energy"}},
      {"fig06_undamped", {"book.0.normalize=false"}, {"while the energy stays"}},
      {"fig07_unnormalized",
       {"book.0.normalize=true"},
       {"the energy has doubled", "it turns faster and faster", "it explodes before"}},
      {"fig07_unnormalized", {"book.0.damping=0"}, {"the book looks healthy", "no explosion in the first half"}},
      {"fig08_neither", {"book.0.damping=1"}, {"it explodes"}},
      {"fig08_neither", {"clip.time_per_frame=0.06"}, {"after a second"}},
      {"fig09_matrix", {"clip.substeps=3"}, {"almost to the end"}},
      {"fig09_matrix", {"book.0.method=exact"}, {"it turns over and back", "and the two end as far apart"}},
      {"fig09_matrix", {"book.0.jiggle=0.1"}, {"where the true book"}},
      {"fig09_matrix", {"book.0.normalize=false"}, {"the matrix stays a rotation"}},
      {"fig09b_matrix_large_step", {"book.0." + about_y}, {"the first flip comes"}},
      {"fig09b_matrix_large_step", {"book.0.method=exact"}, {"it turns over and back", "from the third on"}},
      {"fig09b_matrix_large_step", {"book.0.jiggle=0.1"}, {"where the true book"}},
      {"fig09b_matrix_large_step", {"book.0.normalize=false"}, {"the matrix stays a rotation"}},
      {"fig10_matrix_unnormalized", {"book.0.normalize=true"}, {"the book grows", "it blows up before"}},
      {"fig10_matrix_unnormalized", {"clip.time_per_frame=1"}, {"it has not blown up"}},
      {"fig11_quaternion_unnormalized",
       {"book.0.normalize=true"},
       {"the norm drifts", "the shape goes", "it blows up before"}},
      {"fig11_quaternion_unnormalized", {"clip.substeps=1"}, {"it has not blown up"}},
      {"fig12_pulsating_quaternion", {"clip.substeps=1"}, {"at first it swells"}},
      {"fig12_pulsating_quaternion", {"book.0.normalize=true"}, {"in the end by more", "five pulsations"}},
      {"fig12_pulsating_quaternion",
       {"book.0.method=matrix"},
       {"in between it always comes back", "the shape is the book blended"}},
      {"fig12_pulsating_quaternion", {"book.0." + about_x}, {"the axis stays"}},
      {"compare_methods",
       {"clip.substeps=1"},
       {"springs: with the exact", "matrix: with the exact", "quaternion: with the exact"}},
      {"compare_methods",
       {"book.0.method=exact", "book.1.method=exact", "book.2.method=exact"},
       {"springs: sooner", "matrix: sooner", "quaternion: sooner"}},
      {"compare_methods", {"book.3.jiggle=0.1"}, {"the exact book has turned over once"}},
      {"euler_loses_the_book", {"clip.substeps=3"}, {"almost to the end"}},
      {"euler_loses_the_book",
       {"book.0.integrator=rk4"},
       {"then they part", "the Euler book turns over", "for an energy"}},
      {"euler_loses_the_book", {"book.0.jiggle=0.1"}, {"where the true one"}},
      {"normalization_hides", {"book.0.normalize=false"}, {"the energy looks right"}},
      {"normalization_hides", {"book.0.damping=1"}, {"while nine tenths"}},
      {"polhodes", {"book.0.angular_velocity=[0.115, 0.03, 0.03]"}, {"about z"}},
      {"polhodes", {"book.1.angular_velocity=[0.115, 0.03, 0.03]"}, {"about y"}},
      {"polhodes", {"book.2.angular_velocity=[0.03, 0.115, 0.03]"}, {"beside x: the tip", "beside x: and back"}},
      {"more/feynman_plate", {"book.0.moments=[1, 1, 1.9]"}, {"after one wobble", "after two wobbles"}},
      {"more/oumuamua", {"book.0.moments=[36.9, 2, 36.9]"}, {"8.67 h", "17.34 h", "a quarter of 54.48 h"}},
      {"more/satellite_goes_flat", {"book.1.normalize=true"}, {"no torque"}},
      {"more/satellite_goes_flat", {"book.1.damping=0"}, {"its springs", "the long axis"}},
      {"more/t_handle", {"book.0.moments=[62.1, 171.5, 210.5]"}, {"in the middle of a flip", "half a period later"}},
      {"separatrix", {"book.0.jiggle=1e-1"}, {"kick 10⁻²"}},
      {"separatrix", {"book.0.jiggle=1e-4"}, {"past it at t = 88"}},
      {"separatrix", {"book.1.jiggle=1e-2"}, {"kick 10⁻⁴"}},
      {"separatrix", {"book.1.jiggle=1e-6"}, {"past it at t = 154.8"}},
      {"separatrix", {"book.2.jiggle=1e-4"}, {"kick 10⁻⁶"}},
      {"separatrix", {"book.2.jiggle=1e-8"}, {"past it at t = 222"}}};
  return table;
}

TEST(Videos, EveryExpectationFailsWithoutItsCause) {
  for (const Cause& cause : causes()) {
    const Scene scene = load_scene(folder() / (cause.film + ".toml"), cause.taken_away);
    const std::vector<Verdict> verdicts = judge(scene, simulate(scene));
    for (const std::string& claim : cause.claims) {
      EXPECT_TRUE(std::any_of(verdicts.begin(), verdicts.end(),
                              [&](const Verdict& v) { return !v.met && v.says.starts_with(claim); }))
          << cause.film << " with " << cause.taken_away.front() << " still meets: " << claim;
    }
  }
}

TEST(Videos, EveryExpectationHasItsCause) {
  for (const std::string& film : scripts()) {
    for (const Expectation& e : load_scene(folder() / (film + ".toml")).expectations) {
      const auto names_it = [&](const Cause& cause) {
        return cause.film == film && std::any_of(cause.claims.begin(), cause.claims.end(),
                                                 [&](const std::string& claim) { return e.says.starts_with(claim); });
      };
      EXPECT_EQ(std::count_if(causes().begin(), causes().end(), names_it), 1) << film << ": " << e.says;
    }
  }
}

}  // namespace
}  // namespace bookspin
