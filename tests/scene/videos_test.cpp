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

std::vector<std::string> scripts() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder())) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
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
  const Trajectory trajectory = simulate(scene);
  ASSERT_EQ(trajectory.books.size(), scene.books.size());
  for (const BookTrack& track : trajectory.books)
    ASSERT_EQ(track.frames.size(), static_cast<std::size_t>(scene.clip.frames));
  if (scene.clip.frames > 1) {  // a film: 10 to 20 s, with a claim
    EXPECT_FALSE(scene.expectations.empty());
    EXPECT_GE(scene.clip.frames, 10 * scene.clip.fps);
    EXPECT_LE(scene.clip.frames, 20 * scene.clip.fps);
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

// The scripts' expectations are claims: with the repair left out, or the axis changed, they break.
TEST(Videos, ExpectationsBreakWhenTheClaimIsWrong) {
  struct Wrong {
    const char* figure;
    const char* override_text;
  };
  const Wrong wrongs[] = {{"fig03_stable_z", "book.0.angular_velocity=[0.11482, 0, 0]"},
                          {"fig05_unstable_x", "book.0.jiggle=0"},
                          {"fig06_undamped", "book.0.damping=1"},
                          {"fig07_unnormalized", "book.0.normalize=true"},
                          {"fig08_neither", "book.0.damping=1"},
                          {"fig09_matrix", "book.0.normalize=false"},
                          {"fig10_matrix_unnormalized", "book.0.normalize=true"},
                          {"fig11_quaternion_unnormalized", "book.0.normalize=true"},
                          {"fig12_pulsating_quaternion", "book.0.normalize=true"}};
  for (const Wrong& wrong : wrongs) {
    const std::vector<std::string> overrides{wrong.override_text};
    const Scene scene = load_scene(folder() / (std::string(wrong.figure) + ".toml"), overrides);
    const std::vector<Verdict> verdicts = judge(scene, simulate(scene));
    EXPECT_TRUE(std::any_of(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.met; })) << wrong.figure;
  }
}

}  // namespace
}  // namespace bookspin
