// Literal poses for the renderer's tests: no physics, so that a change of physics cannot break a picture.
#pragma once

#include <Eigen/Geometry>
#include <filesystem>
#include <numbers>

#include "render/shot.h"

namespace bookspin {

inline std::filesystem::path assets() {
  return BOOKSPIN_SOURCE_DIR;
}

// The paper's book, turned by angles in degrees about body y, then world x, then world z.
inline Corners book_at(double about_x, double about_y, double about_z, const Eigen::Vector3d& center_W = {0, 0, 0}) {
  const auto turn = [](double degrees, const Eigen::Vector3d& axis) {
    return Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis);
  };
  const Eigen::Matrix3d R_WB = (turn(about_z, Eigen::Vector3d::UnitZ()) * turn(about_x, Eigen::Vector3d::UnitX()) *
                                turn(about_y, Eigen::Vector3d::UnitY()))
                                   .toRotationMatrix();
  const Eigen::Vector3d size(1.878, 2.9085, 0.5);
  Corners corners_W;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
    corners_W.col(i) = center_W + R_WB * (0.5 * sign.cwiseProduct(size));
  }
  return corners_W;
}

inline Shot shot_of(const Corners& corners_W) {
  Shot shot;
  shot.camera.eye_W = {0, 0, 7};
  shot.books.push_back({corners_W, BookStyle::solid});
  return shot;
}

}  // namespace bookspin
