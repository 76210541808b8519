// What each frame shows: framing, names, explosions.

#include "film/storyboard.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "film/overlays.h"
#include "image/color.h"
#include "render/camera.h"
#include "render/renderer.h"
#include "render/text.h"
#include "scene/quantities.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "tolerance.h"

namespace bookspin {
namespace {

constexpr int width = 640;
constexpr int height = 360;

const std::string script(const char* name) {
  return std::string(BOOKSPIN_SOURCE_DIR) + "/videos/" + name + ".toml";
}

const Label* find_label(const Shot& shot, const std::string& beginning) {
  for (const Label& label : shot.labels) {
    if (label.text.starts_with(beginning)) return &label;
  }
  return nullptr;
}

class EveryFigure : public testing::TestWithParam<const char*> {};

// The whole motion stays in the picture, and the picture is not mostly empty.
TEST_P(EveryFigure, KeepsTheMotionInViewAndFillsThePicture) {
  const Scene scene = load_scene(script(GetParam()));
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, width, height);
  double farthest = 0.0;
  for (int n = 0; n < scene.clip.frames; n += 7) {
    const Shot shot = storyboard.shot(n);
    const BookTrack& first = trajectory.books[0];
    if (first.exploded_frame && first.frames[static_cast<std::size_t>(n)][Q::extent] > 1.25)
      break;  // no longer healthy
    for (const BookPose& book : shot.books) {
      for (int i = 0; i < 8; ++i) {
        const PixelPoint p = View(shot.camera, width, height).shifted(book.shift).project(book.corners_W.col(i));
        ASSERT_GT(p.depth, 0.0);
        const double x = std::abs(p.x / width - 0.5);
        const double y = std::abs(p.y / height - 0.5);
        EXPECT_LT(x, 0.5) << "frame " << n;
        EXPECT_LT(y, 0.5) << "frame " << n;
        farthest = std::max({farthest, x, y});
      }
    }
  }
  EXPECT_GT(farthest, 0.3) << "the books use less than three fifths of the picture";  // measured 0.34 to 0.49
}

INSTANTIATE_TEST_SUITE_P(Videos, EveryFigure,
                         testing::Values("fig02_experiment", "fig03_stable_z", "fig05_unstable_x", "fig07_unnormalized",
                                         "fig08_neither", "fig10_matrix_unnormalized", "fig11_quaternion_unnormalized",
                                         "fig12_pulsating_quaternion"));

TEST(Storyboard, AnExplosionIsSaidAndDrawnOnToItsEndAndASecondLaterTheFilmEnds) {
  for (const char* name :
       {"fig07_unnormalized", "fig08_neither", "fig10_matrix_unnormalized", "fig11_quaternion_unnormalized"}) {
    const Scene scene = load_scene(script(name));
    const Trajectory trajectory = simulate(scene);
    const Storyboard storyboard(scene, trajectory, width, height);
    const int exploded = trajectory.books[0].exploded_frame.value();
    EXPECT_EQ(find_label(storyboard.shot(exploded - 1), "exploded"), nullptr);
    EXPECT_NE(find_label(storyboard.shot(exploded), "exploded at t = "), nullptr);
    int gone = exploded;
    while (storyboard.shot(gone).books[0].style == BookStyle::solid) ++gone;
    EXPECT_GT(gone, exploded + 15) << name;  // measured 32 to 136
    const BookFrame& last = trajectory.books[0].frames[static_cast<std::size_t>(gone - 1)];
    EXPECT_GT(last[Q::extent], 4.0) << name;  // measured 5.0 to 5.7
    EXPECT_LT(last[Q::extent], 6.0) << name;
    EXPECT_EQ(storyboard.frames(), std::min(gone + scene.clip.fps, scene.clip.frames));
    EXPECT_EQ(storyboard.shot(gone).books.size(), 1U);  // the true book turns on
    EXPECT_NE(storyboard.shot(gone).books, storyboard.shot(gone + 30).books);
    EXPECT_EQ(storyboard.shot(exploded - 1).books[0].brightness, 1.0);
    EXPECT_LT(storyboard.shot(exploded + 12).books[0].brightness, 0.4);
  }
}

TEST(Storyboard, ABookThatIsFarOffIsSaidToBeWhereNothingElseSaysIt) {
  const std::vector<std::string> silent{"book.0.show=[]", "view.head_up=['tilt']",
                                        "expect=[{quantity='tilt', at_least=0}]"};
  const Scene scene = load_scene(script("fig09_matrix"), silent);
  const Trajectory trajectory = simulate(scene);
  const std::vector<Doubt> doubts = doubts_about(scene, trajectory);
  ASSERT_EQ(doubts.size(), 1U);
  const Storyboard storyboard(scene, trajectory, width, height);
  EXPECT_EQ(find_label(storyboard.shot(doubts[0].frame - 1), "error "), nullptr);
  EXPECT_NE(find_label(storyboard.shot(doubts[0].frame), "error 0.1"), nullptr);
  EXPECT_NE(find_label(storyboard.shot(doubts[0].frame), "tilt "), nullptr);
}

TEST(Storyboard, AFilmLastsAsLongAsOneOfItsBooks) {
  const std::string two = "book=[{}, {normalize=false, damping=0, angular_velocity=[0.9, 0, 0]}]";
  const Scene scene = load_scene(script("fig08_neither"), std::vector{two});
  const Trajectory trajectory = simulate(scene);
  ASSERT_TRUE(trajectory.books[1].exploded_frame.has_value());
  const Storyboard storyboard(scene, trajectory, width, height);
  EXPECT_EQ(storyboard.frames(), scene.clip.frames);
  EXPECT_EQ(storyboard.shot(scene.clip.frames - 1).books.size(), 1U);
}

TEST(Storyboard, BooksStandWhereTheScriptPutsThemWithTheirNames) {
  const Scene scene = load_scene(script("fig02_experiment"));
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, width, height).shot(100);
  ASSERT_EQ(shot.books.size(), 3U);
  const View view(shot.camera, width, height);
  const PixelPoint middle = view.project(Eigen::Vector3d::Zero());
  for (std::size_t b = 0; b < 3; ++b) {
    EXPECT_EQ(shot.books[b].corners_W, trajectory.books[b].frames[100].corners_W);  // each seen from its own front
    const Label* name = find_label(shot, scene.books[b].name);
    ASSERT_NE(name, nullptr);
    const PixelPoint book = view.shifted(shot.books[b].shift).project(Eigen::Vector3d::Zero());
    EXPECT_NEAR((book.x - middle.x) / height, shot.books[b].shift.x(), 0.5 / height + 1e-9);  // to whole pixels
    const PixelPoint below = view.project(*name->anchor_W);
    EXPECT_NEAR(below.x + name->position.x() * height, book.x, 0.5 + 1e-9);
    EXPECT_GT(below.y + name->position.y() * height, book.y);
    EXPECT_GT(shot.books[b].shift.x(), b == 0 ? -1.0 : shot.books[b - 1].shift.x() + 0.3);  // measured 0.51 apart
  }
}

// The four books are one picture at the start; in the first flip matrix and quaternion, 2e-4 radians apart, still are.
TEST(Storyboard, EqualPosesAreEqualPictures) {
  const Scene scene = load_scene(script("compare_methods"));
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, width, height);
  Renderer renderer(width, height, BOOKSPIN_SOURCE_DIR);
  const auto different_pixels = [&](int frame, std::size_t a, std::size_t b) {
    Shot shot = storyboard.shot(frame);
    shot.labels.clear();
    const Image picture = renderer.draw(shot);
    const auto middle = [&](std::size_t book) {
      return width / 2 + static_cast<int>(std::round(shot.books[book].shift.x() * height));
    };
    int different = 0;
    for (int y = 0; y < height; ++y) {
      for (int x = -70; x < 70; ++x) {
        const std::uint8_t* here = picture.pixel(middle(a) + x, y);
        const std::uint8_t* there = picture.pixel(middle(b) + x, y);
        if (std::abs(here[0] - there[0]) + std::abs(here[1] - there[1]) + std::abs(here[2] - there[2]) > 24)
          ++different;
      }
    }
    return different;
  };
  for (const std::size_t b : {1U, 2U, 3U}) EXPECT_EQ(different_pixels(0, 0, b), 0);
  EXPECT_LE(different_pixels(239, 1, 2), 10);    // measured 0
  EXPECT_GE(different_pixels(480, 2, 3), 1000);  // the exact book is elsewhere: measured
}

// The path of omega and the red curves lie on the ellipsoid of the energy, and on those of L^2 and of the separatrix.
TEST(Storyboard, APolhodeIsWhereTwoEllipsoidsMeet) {
  const Scene scene = load_scene(script("polhodes"));
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, width, height).shot(500);
  ASSERT_EQ(shot.arrows.size(), 3U);
  for (std::size_t b = 0; b < 3; ++b) {
    const Body body = body_of(scene.books[b].options);
    const BookFrame& now = trajectory.books[b].frames[500];
    const double inertia = now.L_W.squaredNorm() / now.L_W.dot(now.omega_W);
    const double middle = body.I_B(0);
    std::map<std::uint8_t, int> lines;  // by their green
    for (const Line& line : shot.lines) {
      if (line.shift != shot.books[b].shift) continue;
      const Eigen::Vector3d w_B = now.q_WB.conjugate() * line.to_W / (1.25 * body.reach);
      const double energy = w_B.cwiseAbs2().dot(body.I_B) / body.I_B.minCoeff();
      const double momentum = w_B.cwiseProduct(body.I_B).squaredNorm() / w_B.cwiseAbs2().dot(body.I_B);
      ++lines[line.color.g];
      if (line.color.g == palette::light.g) continue;
      EXPECT_LE(std::abs(energy - 1.0), tolerance(1e-13));  // measured 6.2e-15
      const double wanted = line.color.g == palette::yellow.g ? inertia : middle;
      EXPECT_LE(std::abs(momentum - wanted), tolerance(1e-12));  // measured 1.4e-14
    }
    EXPECT_EQ(lines[palette::yellow.g], 500);
    EXPECT_EQ(lines[palette::vermilion.g], 144);
  }
}

// Whatever the order of the edges: the mesh's thickness along the shortest, its spine along the longest, no mirror image.
TEST(Storyboard, TheCoverLiesOnTheLargestFace) {
  BookSetup setup;
  EXPECT_EQ(as_bound(setup, body_of(setup.options).corners_B), body_of(setup.options).corners_B);
  std::array<double, 3> edges{0.5, 1.878, 2.9085};
  do {
    setup.options.size = Eigen::Vector3d(edges[0], edges[1], edges[2]);
    const Corners bound = as_bound(setup, body_of(setup.options).corners_B);
    Eigen::Matrix3d uvw;
    for (int d = 0; d < 3; ++d) uvw.col(d) = bound.col(1 << d) - bound.col(0);
    EXPECT_EQ(uvw.colwise().norm(), Eigen::RowVector3d(1.878, 2.9085, 0.5));
    EXPECT_GT(uvw.determinant(), 0.0);
    EXPECT_EQ(bound.col(7), bound.col(0) + uvw.rowwise().sum());
  } while (std::next_permutation(edges.begin(), edges.end()));
  setup.options.size = Eigen::Vector3d::Ones();
  EXPECT_EQ(as_bound(setup, body_of(setup.options).corners_B), body_of(setup.options).corners_B);
}

TEST(Storyboard, AxesAreDrawnAndNamedOnRequest) {
  const Scene scene = load_scene(script("fig01_axes"));
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, width, height).shot(0);
  ASSERT_EQ(shot.arrows.size(), 3U);
  for (int d = 0; d < 3; ++d) {
    const Arrow& arrow = shot.arrows[static_cast<std::size_t>(d)];
    EXPECT_EQ((arrow.to_W - arrow.from_W).normalized(), Eigen::Vector3d::Unit(d));
    const Label* name = find_label(shot, std::string(1, "xyz"[d]));
    ASSERT_NE(name, nullptr);
    PixelPoint p = View(shot.camera, width, height).project(*name->anchor_W);
    p.x += name->position.x() * height;
    p.y += name->position.y() * height;
    EXPECT_GT(p.x, 0.05 * width);
    EXPECT_LT(p.x, 0.95 * width);
    EXPECT_GT(p.y, 0.05 * height);
    EXPECT_LT(p.y, 0.95 * height);
  }
}

// One book: the figures stand in one line. Several: below each book's name.
TEST(Storyboard, FiguresOnRequest) {
  const Scene one = load_scene(script("fig06_undamped"));
  const Trajectory motion = simulate(one);
  const Shot shot = Storyboard(one, motion, width, height).shot(100);
  const Label* energy = find_label(shot, "E/E₀ ");
  ASSERT_NE(energy, nullptr);
  EXPECT_TRUE(energy->tabular);
  EXPECT_EQ(energy->text, "E/E₀ " + std::to_string(motion.books[0].frames[100][Q::energy_ratio]).substr(0, 5));
  EXPECT_EQ(find_label(shot, "t 2.5")->position.x(), energy->position.x());

  const Scene three = load_scene(script("fig02_experiment"));
  const Trajectory motions = simulate(three);
  EXPECT_TRUE(find_label(Storyboard(three, motions, width, height).shot(100), "tilt ")->anchor_W.has_value());
}

// Arrows: L keeps its place in space while omega wanders. The trace grows, ends at the tip of the spin axis, and fades.
TEST(Storyboard, ArrowsTraceAndSpringsOnRequest) {
  const std::vector<std::string> show{"book.0.show=['angular_velocity', 'angular_momentum', 'trace', 'springs']"};
  const Scene scene = load_scene(script("fig09_matrix"), show);
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, width, height);
  const Shot start = storyboard.shot(0);
  const Shot later = storyboard.shot(420);  // in the middle of a flip
  ASSERT_EQ(later.arrows.size(), 3U);
  EXPECT_GT((later.arrows[0].to_W - start.arrows[0].to_W).norm(), 0.3);   // omega: measured 0.85
  EXPECT_LT((later.arrows[1].to_W - start.arrows[1].to_W).norm(), 1e-9);  // L: measured 0
  EXPECT_EQ(start.lines.size(), 2U + 28U);  // what the two vectors were at the start, and the springs
  ASSERT_EQ(later.lines.size(), 2U + 240U + 28U);
  EXPECT_LT(later.lines[2].color.a, later.lines[241].color.a);
  const Eigen::Vector3d tip = later.lines[241].to_W;
  EXPECT_EQ(later.arrows[2].to_W, tip);
  const Eigen::Vector3d x_W = trajectory.books[0].frames[420].q_WB * Eigen::Vector3d::UnitX();
  EXPECT_LT((tip.normalized() - x_W).norm(), 1e-12);  // measured 0
}

struct Size {
  int width, height;
};
constexpr Size sizes[] = {{1280, 720}, {1080, 1920}, {720, 720}, {640, 480}, {108, 192}};

// Where a label's ink is, also beyond the picture's edges.
Rect ink(TextPainter& painter, const Label& label, const Shot& shot, const Size& size) {
  Rect result;
  for (const TextLayout::Place& place :
       painter.lay_out(label, View(shot.camera, size.width, size.height), size.width, size.height).glyphs) {
    result = union_of(
        result, {place.x + place.glyph->left, place.y + place.glyph->top, place.glyph->width, place.glyph->height});
  }
  return result;
}

// All text stands within the picture, and no two lines over one another.
void expect_text_apart(const Scene& scene, const Size& size) {
  TextPainter painter;
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, size.width, size.height);
  for (int frame = 0; frame < scene.clip.frames; frame += 97) {
    const Shot shot = storyboard.shot(frame);
    std::vector<Rect> inks;
    for (const Label& label : shot.labels) {
      const Rect here = ink(painter, label, shot, size);
      ASSERT_FALSE(here.empty()) << label.text;
      EXPECT_EQ(intersection(here, {0, 0, size.width, size.height}), here)
          << label.text << " is cut at " << size.width << "x" << size.height << ", frame " << frame;
      for (std::size_t i = 0; i < inks.size(); ++i) {
        const Rect common = intersection(here, inks[i]);
        EXPECT_LE(common.height, 0.3 * here.height)  // a line's descenders may reach the next one's capitals
            << label.text << " stands over " << shot.labels[i].text << " at " << size.width << "x" << size.height;
      }
      inks.push_back(here);
    }
  }
}

TEST(Storyboard, TextIsNeverCutAndNeverOverOtherText) {
  const std::string title =
      "title='A title that is longer than any other, so that no picture holds it in one line as it is'";
  for (const Size& size : sizes) {
    for (const char* name : {"fig06_undamped", "fig08_neither", "fig09b_matrix_large_step"}) {
      expect_text_apart(load_scene(script(name), std::vector{title}), size);
    }
    for (const char* name : {"fig02_experiment", "compare_methods", "separatrix"}) {
      expect_text_apart(load_scene(script(name)), size);
      expect_text_apart(
          load_scene(script(name), std::vector{title, std::string("book.1.name='the one with a long name'"),
                                               std::string("view.head_up=['tilt', 'blend_defect', 'angle_error']")}),
          size);
    }
  }
}

TEST(Storyboard, TextOfOneKindHasOneSizeInTheWholeFilm) {
  const Scene scene =
      load_scene(script("compare_methods"), std::vector{std::string("book.1.name='the matrix with its long name'")});
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, 1080, 1920);
  std::map<std::string, std::set<double>> heights;
  for (const int frame : {0, 500, 959}) {
    for (const Label& label : storyboard.shot(frame).labels) {
      heights[label.anchor_W  ? label.tabular ? "figure" : "name"
              : label.tabular ? "time"
                              : "title"]
          .insert(label.height);
    }
  }
  for (const auto& [kind, found] : heights) EXPECT_EQ(found.size(), 1U) << kind;
  EXPECT_EQ(heights["figure"], heights["time"]);
  EXPECT_LT(*heights["name"].begin(), 0.03);   // measured 0.015
  EXPECT_EQ(*heights["title"].begin(), 0.04);  // as it should be: it has room
}

TEST(Storyboard, NamesOfBooksInOnePlaceStandBelowOneAnother) {
  const Scene scene = load_scene(script("fig02_experiment"), std::vector{std::string("book.1.position=[0, 0, 0]"),
                                                                         std::string("book.0.position=[0, 0, 0]")});
  const Trajectory trajectory = simulate(scene);
  const Shot shot = Storyboard(scene, trajectory, width, height).shot(0);
  EXPECT_GT(find_label(shot, scene.books[1].name)->position.y(), find_label(shot, scene.books[0].name)->position.y());
  for (const Size& size : sizes) expect_text_apart(scene, size);
}

TEST(Storyboard, NoFigureIsWrittenInBoxes) {
  const TextPainter painter;
  for (const Quantity& q : quantities) {
    EXPECT_TRUE(painter.lacks(std::string(q.symbol) + std::string(q.format)).empty()) << q.symbol;
  }
}

TEST(Storyboard, SaysWhatTheFontLacks) {
  const auto lacking = [](const std::string& title, const std::string& name) {
    return lacking_characters(
        load_scene(script("fig02_experiment"), std::vector{"title='" + title + "'", "book.1.name='" + name + "'"}));
  };
  EXPECT_TRUE(lacking("Größe, ω → ∞, 10⁻¹⁵", "Ærøskøbing Łódź").empty());
  EXPECT_EQ(lacking("漢字漢", "about 𒀀"), (std::vector<std::string>{"title: '漢', '字'", "book.1.name: '𒀀'"}));
}

}  // namespace
}  // namespace bookspin
