// The trajectory as CSV: columns, rows, and every double as it was.
#include "scene/trajectory_csv.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

double number(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  EXPECT_EQ(*end, '\0') << text;
  return value;
}

Scene two_books(int frames) {
  return parse_scene("title = 'T'\nclip = { frames = " + std::to_string(frames) +
                         ", time_per_frame = 0.7, substeps = 3 }\n" +
                         "[[book]]\nmethod = 'springs'\nangular_velocity = [0.3, 0.1, 0.2]\nposition = [5, 5, 5]\n"
                         "[[book]]\nmethod = 'quaternion'\nangular_velocity = [0.1, 0.1, 2]\nnormalize = false\n",
                     "s.toml");
}

std::string whole_csv(const Scene& scene, const Trajectory& trajectory) {
  std::string csv = trajectory_csv_header() + '\n';
  for (int n = 0; n < scene.clip.frames; ++n) csv += trajectory_csv_rows(scene, trajectory, n);
  return csv;
}

TEST(TrajectoryCsv, HasItsHeader) {
  EXPECT_EQ(
      trajectory_csv_header(),
      "frame,t,book,c0x,c0y,c0z,c1x,c1y,c1z,c2x,c2y,c2z,c3x,c3y,c3z,c4x,c4y,c4z,c5x,c5y,c5z,c6x,c6y,c6z,c7x,c7y,c7z,"
      "qw,qx,qy,qz,Lx,Ly,Lz,kinetic_energy,elastic_energy,stretch,angle_error,omega_x,omega_y,omega_z,tilt,flips,"
      "energy_ratio,angular_momentum_ratio,norm,largest_singular_value,orthogonality_defect,blend_defect,pulsations,"
      "exact_tilt,exact_flips,extent,floor_hits,exploded,omega_Bx,omega_By,omega_Bz,L_Bx,L_By,L_Bz");
}

TEST(TrajectoryCsv, HasARowAFrameAndBookWhoseNumbersComeBack) {
  const Scene scene = two_books(30);
  const Trajectory trajectory = simulate(scene);
  const std::vector<std::string> lines = split(whole_csv(scene, trajectory), '\n');
  ASSERT_EQ(lines.size(), 1U + 30U * 2U);
  for (int n = 0; n < 30; ++n) {
    for (std::size_t b = 0; b < 2; ++b) {
      const std::vector<std::string> cells = split(lines[1 + 2 * static_cast<std::size_t>(n) + b], ',');
      ASSERT_EQ(cells.size(), split(trajectory_csv_header(), ',').size());
      const BookFrame& f = trajectory.books[b].frames[static_cast<std::size_t>(n)];
      EXPECT_EQ(cells[0], std::to_string(n));
      EXPECT_EQ(number(cells[1]), n * 0.7);  // a product, never a sum
      EXPECT_EQ(cells[2], std::to_string(b));
      std::vector<double> expected;
      for (int i = 0; i < 8; ++i) {
        for (int d = 0; d < 3; ++d) expected.push_back(f.corners_W(d, i));
      }
      expected.insert(expected.end(), {f.q_WB.w(), f.q_WB.x(), f.q_WB.y(), f.q_WB.z(), f.L_W.x(), f.L_W.y(), f.L_W.z(),
                                       f[Q::kinetic_energy], f[Q::elastic_energy], f[Q::stretch], f[Q::angle_error],
                                       f.omega_W.x(), f.omega_W.y(), f.omega_W.z()});
      for (const char* name : {"tilt",
                               "flips",
                               "energy_ratio",
                               "angular_momentum_ratio",
                               "norm",
                               "largest_singular_value",
                               "orthogonality_defect",
                               "blend_defect",
                               "pulsations",
                               "exact_tilt",
                               "exact_flips",
                               "extent",
                               "floor_hits",
                               "exploded",
                               "omega_Bx",
                               "omega_By",
                               "omega_Bz",
                               "L_Bx",
                               "L_By",
                               "L_Bz"}) {
        for (const Quantity& q : quantities) {
          if (q.name == name) expected.push_back(f[q.id]);
        }
      }
      ASSERT_EQ(cells.size(), 3 + expected.size());
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if (std::isnan(expected[i])) {
          EXPECT_EQ(cells[3 + i], "nan");
        } else {
          EXPECT_EQ(number(cells[3 + i]), expected[i]) << "frame " << n << ", column " << 3 + i;
        }
      }
    }
  }
}

TEST(TrajectoryCsv, WritesSeventeenDigits) {
  Scene scene = two_books(2);
  scene.clip.time_per_frame = 0.1;
  const Trajectory trajectory = simulate(scene);
  EXPECT_EQ(split(trajectory_csv_rows(scene, trajectory, 1), ',')[1], "0.10000000000000001");
}

TEST(TrajectoryCsv, Frame0IsTheStart) {
  const Scene scene = two_books(2);
  const std::string row = split(trajectory_csv_rows(scene, simulate(scene), 0), '\n')[0];
  EXPECT_TRUE(row.starts_with("0,0,0,-0.93899999999999995,-1.45425,-0.25,0.93899999999999995,-1.45425,-0.25,")) << row;
}

TEST(TrajectoryCsv, OfTheSameSceneHasTheSameBytes) {
  const Scene scene = two_books(200);
  EXPECT_EQ(whole_csv(scene, simulate(scene)), whole_csv(scene, simulate(scene)));
}

TEST(TrajectoryCsv, SaysNanWhereThereIsNoNumber) {
  const Scene scene = two_books(400);  // the quaternion book explodes
  const Trajectory trajectory = simulate(scene);
  ASSERT_FALSE(trajectory.books[1].frames.back().corners_W.allFinite());
  const std::vector<std::string> rows = split(trajectory_csv_rows(scene, trajectory, 399), '\n');
  std::string expected = "399,279.29999999999995,1";
  for (int i = 0; i < 38; ++i) expected += ",nan";
  expected +=
      ",nan,0,nan,nan,nan,nan,nan,nan,0,nan,0,nan,0,1,nan,nan,nan,nan,nan,nan";  // counts stay, and it has exploded
  EXPECT_EQ(rows[1], expected);
  EXPECT_EQ(whole_csv(scene, trajectory).find("inf"), std::string::npos);
}

}  // namespace
}  // namespace bookspin
