// Every figure: an early, the middle and the last frame as goldens, and the whole film end to end at a small size.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "film/shoot.h"
#include "film/storyboard.h"
#include "golden_test.h"
#include "image/png.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "scratch.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

const fs::path project = BOOKSPIN_SOURCE_DIR;

std::vector<std::string> figures() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(project / "videos")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path script(const std::string& figure) {
  return project / "videos" / (figure + ".toml");
}

class Figure : public testing::TestWithParam<std::string> {};

TEST_P(Figure, EarlyMiddleAndLastFrameAreTheGoldens) {
  constexpr int width = 320;
  constexpr int height = 180;
  const Scene scene = load_scene(script(GetParam()));
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, width, height);
  Renderer renderer(width, height, project);
  // An exploded book is soon gone: the last frame is that of its explosion.
  const int last = trajectory.books[0].exploded_frame.value_or(scene.clip.frames - 1);
  // Without labels: the fonts of two systems differ. Where those stand, storyboard_test.cpp sees to.
  const auto expect = [&](int frame, const char* which) {
    Shot shot = storyboard.shot(frame);
    shot.labels.clear();
    expect_golden(renderer.draw(shot), "film", GetParam() + which);
  };
  expect(last / 8, "_early");
  if (last == 0) return;
  expect(last / 2, "_middle");
  expect(last, "_last");
}

TEST_P(Figure, FilmHasEveryFrameAndMeetsEveryExpectation) {
  const Scratch scratch;
  FilmSettings settings;
  settings.width = 160;
  settings.height = 90;
  const Film film = load_film(script(GetParam()), settings);
  Renderer renderer(160, 90, project);
  Progress progress;
  const FilmReceipt receipt = shoot(
      film, scratch.folder(), [&]() -> Renderer& { return renderer; }, progress);
  const Scene& scene = film.scene;
  EXPECT_EQ(progress.frames_drawn, scene.clip.frames);
  for (const Verdict& verdict : receipt.verdicts) EXPECT_TRUE(verdict.met) << verdict.says << ": " << verdict.text;

  const auto data = nlohmann::json::parse(read_text(scratch / (GetParam() + ".json")));
  EXPECT_TRUE(data["met"].get<bool>());
  EXPECT_EQ(data["books"].size(), scene.books.size());
  for (const auto& book : data["books"]) {
    for (const auto& [name, values] : book["data"].items()) {
      EXPECT_EQ(values.size(), static_cast<std::size_t>(scene.clip.frames)) << name;
    }
  }
  const Image poster = read_png(scratch / (GetParam() + ".png"));
  EXPECT_EQ(poster.width, 160);
  if (scene.clip.frames == 1) {
    EXPECT_FALSE(fs::exists(scratch / (GetParam() + ".mp4")));
    return;
  }
  const Mp4Info info = read_mp4_info(scratch / (GetParam() + ".mp4"));
  EXPECT_EQ(info.frames, data["clip"]["drawn_frames"]);
  EXPECT_EQ(info.frames, receipt.frames);
  EXPECT_EQ(info.fps, scene.clip.fps);
  EXPECT_EQ(info.width, 160);
  EXPECT_EQ(info.height, 90);
  EXPECT_EQ(info.title, scene.title);
  // Within 10 to 20 s, as a film of the results section should be.
  EXPECT_GE(info.duration, 10.0 - 1e-6);
  EXPECT_LE(info.duration, 20.0 + 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Videos, Figure, testing::ValuesIn(figures()),
                         [](const auto& param_info) { return param_info.param; });

TEST(Figures, AllOfThePapersAreThere) {
  using testing::IsSupersetOf;
  EXPECT_THAT(figures(), IsSupersetOf({"fig01_axes", "fig02_experiment", "fig03_stable_z", "fig04_stable_y",
                                       "fig05_unstable_x", "fig06_undamped", "fig07_unnormalized", "fig08_neither",
                                       "fig09_matrix", "fig09b_matrix_large_step", "fig10_matrix_unnormalized",
                                       "fig11_quaternion_unnormalized", "fig12_pulsating_quaternion"}));
}

}  // namespace
}  // namespace bookspin

int main(int argc, char** argv) {
  return bookspin::run_tests_with_goldens(argc, argv, "film");
}
