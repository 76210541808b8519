// What each frame shows: framing, names, explosions.

#include "film/storyboard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "render/camera.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

using testing::HasSubstr;

constexpr int width = 640;
constexpr int height = 360;

const std::string script(const char* name) { return std::string(BOOKSPIN_SOURCE_DIR) + "/videos/" + name + ".toml"; }

class EveryFigure : public testing::TestWithParam<const char*> {};

// The whole motion stays in the picture, and the picture is not mostly empty.
TEST_P(EveryFigure, KeepsTheMotionInViewAndFillsThePicture) {
  const Scene scene = load_scene(script(GetParam()));
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, static_cast<double>(width) / height);
  double farthest = 0.0;
  for (int n = 0; n < scene.clip.frames; n += 7) {
    const Shot shot = storyboard.shot(n);
    for (const BookPose& book : shot.books) {
      for (int i = 0; i < 8; ++i) {
        const PixelPoint p = project(shot.camera, width, height, book.corners_W.col(i));
        ASSERT_GT(p.depth, 0.0);
        const double x = std::abs(p.x / width - 0.5);
        const double y = std::abs(p.y / height - 0.5);
        EXPECT_LT(x, 0.5) << "frame " << n;
        EXPECT_LT(y, 0.5) << "frame " << n;
        farthest = std::max({farthest, x, y});
      }
    }
  }
  EXPECT_GT(farthest, 0.3) << "the books use less than three fifths of the picture";  // measured 0.35 to 0.48
}

INSTANTIATE_TEST_SUITE_P(Videos, EveryFigure,
                         testing::Values("fig02_experiment", "fig03_stable_z", "fig05_unstable_x", "fig07_unnormalized",
                                         "fig08_neither", "fig10_matrix_unnormalized",
                                         "fig11_quaternion_unnormalized", "fig12_pulsating_quaternion"));

TEST(Storyboard, AnExplosionIsHeldAndSaid) {
  const Scene scene = load_scene(script("fig08_neither"));
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, 16.0 / 9.0);
  ASSERT_TRUE(trajectory.books[0].exploded_frame.has_value());
  const int exploded = *trajectory.books[0].exploded_frame;
  EXPECT_EQ(storyboard.shot(exploded - 1).labels.size(), 1U);  // the title
  const Shot held = storyboard.shot(exploded);
  ASSERT_EQ(held.labels.size(), 2U);
  EXPECT_THAT(held.labels[1].text, HasSubstr("exploded at t = "));
  EXPECT_EQ(held.books, storyboard.shot(exploded - 1).books);
  EXPECT_EQ(held, storyboard.shot(scene.clip.frames - 1));  // nothing moves any more, so nothing is drawn again
}

TEST(Storyboard, BooksStandWhereTheScriptPutsThemWithTheirNames) {
  const Scene scene = load_scene(script("fig02_experiment"));
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, 16.0 / 9.0).shot(100);
  ASSERT_EQ(shot.books.size(), 3U);
  ASSERT_EQ(shot.labels.size(), 4U);  // the title first
  for (std::size_t b = 0; b < 3; ++b) {
    const Eigen::Vector3d centre = shot.books[b].corners_W.rowwise().mean();
    EXPECT_LT((centre - scene.books[b].position_W).norm(), 1e-12);  // measured 1.3e-16
    EXPECT_EQ(shot.labels[b + 1].text, scene.books[b].name);
  }
}

TEST(Storyboard, AxesAreDrawnAndNamedOnRequest) {
  const Scene scene = load_scene(script("fig01_axes"));
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, 16.0 / 9.0).shot(0);
  ASSERT_EQ(shot.arrows.size(), 3U);
  ASSERT_EQ(shot.labels.size(), 4U);  // the title first
  for (int d = 0; d < 3; ++d) {
    const Arrow& arrow = shot.arrows[static_cast<std::size_t>(d)];
    EXPECT_EQ((arrow.to_W - arrow.from_W).normalized(), Eigen::Vector3d::Unit(d));
    const Label& name = shot.labels[static_cast<std::size_t>(d) + 1];
    EXPECT_EQ(name.text, std::string(1, "xyz"[d]));
    const PixelPoint p = project(shot.camera, width, height, *name.anchor_W);
    EXPECT_GT(p.x, 0.05 * width);
    EXPECT_LT(p.x, 0.95 * width);
    EXPECT_GT(p.y, 0.05 * height);
    EXPECT_LT(p.y, 0.95 * height);
  }
}

}  // namespace
}  // namespace bookspin
