// Overrides: every key of a script can be set from outside, and a script's own words reach the scene.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/scene_file.h"

namespace bookspin {
namespace {

constexpr const char* small = R"(title = "T"
[[book]]
[[book]]
method = "matrix"
size = [1, 2, 3]
[[expect]]
quantity = "tilt"
at_most = 5
)";

Scene with(const std::vector<std::string>& overrides) {
  return parse_scene(small, "s.toml", overrides);
}

TEST(Overrides, ReachEveryKeyOfTheSceneTheClipAndTheView) {
  const Scene scene = with({"title=Another title", "caption=\"with = and # and 'quotes'\"", "seed=77", "clip.frames=12",
                            "clip.fps=25", "clip.time_per_frame=0.25", "clip.substeps=60", "view.from=[1, 2, -3]"});
  EXPECT_EQ(scene.title, "Another title");
  EXPECT_EQ(scene.caption, "with = and # and 'quotes'");
  EXPECT_EQ(scene.seed, 77U);
  EXPECT_EQ(scene.clip.frames, 12);
  EXPECT_EQ(scene.clip.fps, 25);
  EXPECT_EQ(scene.clip.time_per_frame, 0.25);
  EXPECT_EQ(scene.clip.substeps, 60);
  EXPECT_EQ(scene.view.from, Eigen::Vector3d(1, 2, -3));
}

TEST(Overrides, ReachEveryKeyOfABook) {
  const Scene scene = with({"book.1.name=left one", "book.1.method=quaternion", "book.1.integrator=explicit_euler",
                            "book.1.size=[2, 3, 0.25]", "book.1.angular_velocity=[0.5, -0.25, 1]", "book.1.jiggle=1e-3",
                            "book.1.normalize_every=7", "book.1.damping=0.5", "book.1.stiffness=20",
                            "book.1.particle_mass=0.125", "book.1.position=[-1, 0, 2]", "book.1.style=ghost",
                            "book.1.show=['axes', 'trace']", "view.head_up=['tilt', 'flips']"});
  const BookSetup& book = scene.books[1];
  EXPECT_EQ(book.name, "left one");
  EXPECT_EQ(book.method, Method::quaternion);
  EXPECT_EQ(book.options.integrator, Integrator::explicit_euler);
  EXPECT_EQ(book.options.size, Eigen::Vector3d(2, 3, 0.25));
  EXPECT_EQ(book.options.omega_W, Eigen::Vector3d(0.5, -0.25, 1));
  EXPECT_EQ(book.jiggle, 1e-3);
  EXPECT_EQ(book.options.normalize_every, 7);
  EXPECT_EQ(book.options.damping, 0.5);
  EXPECT_EQ(book.options.stiffness, 20.0);
  EXPECT_EQ(book.options.particle_mass, 0.125);
  EXPECT_EQ(book.position_W, Eigen::Vector3d(-1, 0, 2));
  EXPECT_EQ(book.style, Style::ghost);
  EXPECT_EQ(book.show, (std::set{Overlay::axes, Overlay::trace}));
  ASSERT_EQ(scene.view.head_up.size(), 2U);
  EXPECT_EQ(scene.view.head_up[1], Q::flips);

  const BookSetup untouched = scene.books[0];
  const BookSetup defaults;
  EXPECT_EQ(untouched.method, defaults.method);
  EXPECT_EQ(untouched.options.size, defaults.options.size);
  EXPECT_EQ(untouched.options.normalize_every, defaults.options.normalize_every);
}

TEST(Normalization, IsEveryStepUnlessTheScriptSaysOtherwise) {
  const auto every = [](const std::vector<std::string>& keys) { return with(keys).books[1].options.normalize_every; };
  EXPECT_EQ(every({}), 1);
  EXPECT_EQ(every({"book.1.normalize_every=7"}), 7);
  EXPECT_EQ(every({"book.1.normalize=true", "book.1.normalize_every=7"}), 7);
  EXPECT_EQ(every({"book.1.normalize=false"}), 0);
  EXPECT_EQ(every({"book.1.normalize=false", "book.1.normalize_every=7"}), 0);
  EXPECT_EQ(every({"book.1.normalize_every=7", "book.1.normalize=false"}), 0);
}

TEST(Overrides, ReachEveryKeyOfAnExpectation) {
  const Scene scene =
      with({"expect.0.says=new words", "expect.0.quantity=norm", "expect.0.book=1", "expect.0.frames=[3, 9]",
            "expect.0.at_least=-1", "expect.0.at_most=2.5", "expect.0.rises_to=3", "expect.0.falls_to=-4"});
  const Expectation& e = scene.expectations[0];
  EXPECT_EQ(e.says, "new words");
  EXPECT_EQ(e.quantity, Q::norm);
  EXPECT_EQ(e.book, 1);
  EXPECT_EQ(e.first_frame, 3);
  EXPECT_EQ(e.last_frame, 9);
  EXPECT_EQ(e.at_least, -1.0);
  EXPECT_EQ(e.at_most, 2.5);
  EXPECT_EQ(e.rises_to, 3.0);
  EXPECT_EQ(e.falls_to, -4.0);
  const Expectation one_frame = with({"expect.0.frame=4"}).expectations[0];
  EXPECT_EQ(one_frame.first_frame, 4);
  EXPECT_EQ(one_frame.last_frame, 4);
}

TEST(Overrides, ReachOneNumberOfAListAndWholeTables) {
  EXPECT_EQ(with({"book.1.size.2=0.5"}).books[1].options.size, Eigen::Vector3d(1, 2, 0.5));
  const Clip clip = with({"clip={frames = 3, substeps = 2}"}).clip;
  EXPECT_EQ(clip.frames, 3);
  EXPECT_EQ(clip.substeps, 2);
  EXPECT_EQ(clip.fps, 60);
  EXPECT_EQ(with({"book=[{method='springs'}, {}, {show=['axes']}]"}).books.size(), 3U);
  EXPECT_EQ(with({"book.1={name='b'}"}).books[1].options.size, BookOptions{}.size);
}

TEST(Overrides, TakeBareWordsAndAnyLettersAsTexts) {
  EXPECT_EQ(with({"title=Schütze & Söhne"}).title, "Schütze & Söhne");
  EXPECT_EQ(with({"title=a=b"}).title, "a=b");
  EXPECT_EQ(with({"title=\"7\""}).title, "7");
  EXPECT_EQ(with({R"(title=back\slash "and" 'quotes')"}).title, R"(back\slash "and" 'quotes')");
}

TEST(Overrides, OfTheSameKeyTheLastOneCounts) {
  EXPECT_EQ(with({"seed=1", "seed=2", "book.0.jiggle=0.5", "book.0.jiggle=0.25"}).seed, 2U);
  EXPECT_EQ(with({"book.0.jiggle=0.5", "book.0.jiggle=0.25"}).books[0].jiggle, 0.25);
}

TEST(Script, LeavesWhatItDoesNotSayAtItsDefault) {
  const Scene scene = parse_scene("title = 'T'\n[[book]]\n", "s.toml");
  const Scene defaults;
  EXPECT_EQ(scene.seed, defaults.seed);
  EXPECT_EQ(scene.clip.frames, defaults.clip.frames);
  EXPECT_EQ(scene.clip.substeps, defaults.clip.substeps);
  EXPECT_EQ(scene.view.from, defaults.view.from);
  EXPECT_TRUE(scene.expectations.empty());
  ASSERT_EQ(scene.books.size(), 1U);
  EXPECT_EQ(scene.books[0].jiggle, 0.0);
  EXPECT_EQ(scene.books[0].options.omega_W, Eigen::Vector3d(0, 0, 0));
}

TEST(Script, MomentsMomentumAndOrientation) {
  const Scene scene = parse_scene(
      "title = 'T'\n[[book]]\nmethod = 'exact'\nparticle_mass = 2\nmoments = [2, 4, 6]\nangular_momentum = [1, -8, 3]\n"
      "orientation = [0, 0, 3, 4]\n",
      "s.toml");
  const BookSetup& book = scene.books[0];
  EXPECT_EQ(body_of(book.options).I_B, Eigen::Vector3d(2, 4, 6));
  EXPECT_EQ(book.options.size, Eigen::Vector3d(1, std::sqrt(0.5), 0));
  EXPECT_EQ(book.options.omega_W, Eigen::Vector3d(0.5, -2, 0.5));
  EXPECT_EQ(book.q_WB0->coeffs(), Eigen::Vector4d(0, 0.6, 0.8, 0));
  EXPECT_FALSE(parse_scene("title = 'T'\n[[book]]\n", "s.toml").books[0].q_WB0.has_value());
}

TEST(Script, DampingMayBeTrueOrFalse) {
  EXPECT_EQ(with({"book.0.damping=true"}).books[0].options.damping, 1.0);
  EXPECT_EQ(with({"book.0.damping=false"}).books[0].options.damping, 0.0);
}

TEST(Script, TakesValuesAtTheirLimits) {
  const Scene scene =
      with({"clip.frames=1", "clip.fps=240", "clip.time_per_frame=1e6", "clip.substeps=1000000", "seed=2147483647",
            "book.0.jiggle=1", "book.0.size=[1e-6, 1e6, 1]", "book.0.damping=1000", "view.from=[1e-9, 1, 0]"});
  EXPECT_EQ(scene.seed, 2147483647U);
  EXPECT_EQ(scene.books[0].jiggle, 1.0);
}

TEST(Method, HasTheNameOfTheScript) {
  for (const char* name : {"springs", "matrix", "quaternion"}) {
    EXPECT_EQ(name_of(with({std::string("book.0.method=") + name}).books[0].method), name);
  }
}

}  // namespace
}  // namespace bookspin
