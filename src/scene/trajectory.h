// What a simulation leaves behind: the corners of every book at every frame, and what was measured there.
//
// A book has exploded from the first frame on at which a corner is farther from its centre than largest_extent times
// half its diagonal at rest, or is not finite. That is data, not an error: a film holds on the frame before. Once a
// number is not finite, or what is measured overflows, the corners and all measures of the book are NaN; counts stay.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include "dynamics/corners.h"

namespace bookspin {

inline constexpr double largest_extent = 2.0;  // in lengths of half the diagonal at rest

struct BookFrame {
  Corners corners_W;              // about the book's own centre, world frame
  Eigen::Quaterniond q_WB;        // best-fit orientation, |q| = 1, sign continuous from frame to frame
  Eigen::Vector3d L_W;            // angular momentum, world frame
  double kinetic_energy;          // mass length^2 / time^2
  double elastic_energy;          // springs; 0 for the rigid methods
  double energy_ratio;            // (kinetic + elastic) / the same at frame 0
  double angular_momentum_ratio;  // |L| / the same at frame 0
  double stretch;                 // largest relative change of a distance between two corners
  double extent;                  // farthest corner, in half diagonals at rest
  double tilt;                    // degrees between the book's spin axis and where it was at the start, 0 ... 180
  int flips;                      // passages of the tilt so far, from below 10 degrees to above 170 or back
  int pulsations;                 // swellings by 10 % or more so far, each followed by an equal shrinking
  double norm;                    // |q| of the quaternion method; NaN for the others
  double largest_singular_value;  // of the deformation: how much the book has grown where it has grown most
  double orthogonality_defect;    // largest entry of |F^T F - 1|, F the deformation
  double blend_defect;  // largest entry of |F - ((1 - s^2) 1 + s^2 R(q / s))|, s = |q|; NaN but for quaternions
  double angle_error;   // radians from q_WB to the exact rigid motion from the same start, 0 ... pi
  long floor_hits;      // springs: how often the normalization's floor of 0.1 E0 has bitten so far
  bool exploded;
};

struct BookTrack {
  std::vector<BookFrame> frames;      // one a film frame
  std::optional<int> exploded_frame;  // the first exploded one

  // The frame that film frame n shows: n itself, or the last one before the explosion.
  [[nodiscard]] const BookFrame& shown(int n) const {
    return frames[static_cast<std::size_t>(exploded_frame ? std::clamp(*exploded_frame - 1, 0, n) : n)];
  }
};

struct Trajectory {
  std::vector<BookTrack> books;
};

}  // namespace bookspin
