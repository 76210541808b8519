// What a simulation leaves behind: the corners of every book at every frame, and what was measured there.
//
// A book has exploded from the first frame on at which a corner is farther from its center than largest_extent times
// half its diagonal at rest, or is not finite. That is data, not an error, and the motion goes on. Once a number is not
// finite, or what is measured overflows, the corners and all measures of the book are NaN; counts stay.
//
// q_WB is the quaternion of a method that keeps one of unit norm; of any other book the rotation nearest to its corners.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "dynamics/corners.h"
#include "scene/quantities.h"

namespace bookspin {

inline constexpr double largest_extent = 2.0;  // in lengths of half the diagonal at rest

struct BookFrame {
  Corners corners_W = Corners::Zero();                             // about the book's own center, world frame
  Eigen::Quaterniond q_WB = Eigen::Quaterniond::Identity();        // |q| = 1, sign continuous from frame to frame
  Eigen::Quaterniond exact_q_WB = Eigen::Quaterniond::Identity();  // of the exact book from the same start
  Eigen::Vector3d L_W = Eigen::Vector3d::Zero();                   // angular momentum
  Eigen::Vector3d omega_W = Eigen::Vector3d::Zero();               // R_WB I_B^-1 R_WB^T L_W: R of q_WB, I_B at rest
  std::array<double, quantity_count> value{};                      // NaN where the book has no such number

  [[nodiscard]] double& operator[](Q q) { return value[static_cast<std::size_t>(q)]; }
  [[nodiscard]] double operator[](Q q) const { return value[static_cast<std::size_t>(q)]; }
  [[nodiscard]] bool exploded() const { return (*this)[Q::exploded] != 0.0; }
};

struct BookTrack {
  std::vector<BookFrame> frames;      // one a film frame
  std::optional<int> exploded_frame;  // the first exploded one
};

struct Trajectory {
  std::vector<BookTrack> books;
};

}  // namespace bookspin
