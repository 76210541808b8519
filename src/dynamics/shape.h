// What the eight corners say: orientation, stretch, how far the book is from being a rotated copy of itself.
//
// The deformation F_WB is the least-squares linear map from the corners at rest to the corners now (about their mean);
// for the rigid methods it is the method's own R. The orientation is the rotation nearest to F_WB in the same
// least-squares sense (Kabsch, Acta Cryst. A32 (1976) 922, with each corner counting alike).
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/corners.h"

namespace bookspin {

[[nodiscard]] Eigen::Matrix3d deformation(const Corners& corners_W, const Corners& corners_B);

// Rotation R_WB that makes sum |x_i - R_WB b_i|^2 least; identity when a corner is not finite.
[[nodiscard]] Eigen::Quaterniond best_fit_orientation(const Corners& corners_W, const Corners& corners_B);

// Largest |distance now / distance at rest - 1| over the 28 pairs of corners; NaN when a corner is not finite.
[[nodiscard]] double stretch(const Corners& corners_W, const Corners& corners_B);

// Farthest corner from the origin, in lengths of half the diagonal at rest; NaN when a corner is not finite.
[[nodiscard]] double extent(const Corners& corners_W, const Corners& corners_B);

// Angle of the rotation that takes one orientation to the other, 0 ... pi radians; accurate near 0 and pi; any |q| > 0.
[[nodiscard]] double geodesic_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b);

// Angle between two vectors, 0 ... pi radians; accurate near 0 and pi; 0 when one of them is 0.
[[nodiscard]] double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

}  // namespace bookspin
