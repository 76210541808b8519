// How far away the camera is, so that all is in the picture; and when a book that has exploded is no longer.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "film/overlays.h"

namespace bookspin {

inline constexpr double film_fov = 0.5235987755982988;  // vertical: 30 degrees, as in the original program
inline constexpr double healthy_extent = 1.25;          // of a book that explodes: up to here it is framed

// A book's part of the picture.
struct Stand {
  Eigen::Vector2d place;        // of its center, right and up, world units
  std::vector<Sphere> spheres;  // all that is to be seen of it, about its center
};

// What all stands take up in the picture when the eye is this far away: right and up, in tangents.
[[nodiscard]] Eigen::AlignedBox2d picture_of(const std::vector<Stand>& stands, const Eigen::Matrix3d& R_CW,
                                             double distance);

// The least distance from which all stands are in the picture, of whose height they may take the share `band`.
[[nodiscard]] double distance_that_frames(const std::vector<Stand>& stands, const Eigen::Matrix3d& R_CW, double aspect,
                                          double band);

// How far a stand's picture is moved (render/shot.h), when the middle of the picture is to be at `middle`, in tangents.
[[nodiscard]] Eigen::Vector2d shift_of(const Stand& stand, double distance, const Eigen::Vector2d& middle);

// Whether its numbers have ended, or it comes as near as the camera, `too_near` half diagonals away.
[[nodiscard]] bool is_gone(const BookFrame& frame, double too_near);

}  // namespace bookspin
