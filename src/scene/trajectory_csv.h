// A trajectory as CSV: one row a frame and book, "%.17g", so that every double survives; nan where there is no number.
//
// frame,t,book,c0x,c0y,c0z,...,c7z,qw,qx,qy,qz,Lx,Ly,Lz,kinetic_energy,elastic_energy,stretch,angle_error
// Corners are about the book's own centre (its position in the picture is not part of its motion), world frame; q is
// the best-fit orientation, body to world; angle_error is its angle to the exact rigid motion from the same start,
// radians.
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] std::string trajectory_csv_header();  // without the line's end

// The rows of one frame, each with its line's end.
[[nodiscard]] std::string trajectory_csv_rows(const Scene& scene, const Trajectory& trajectory, int frame);

}  // namespace bookspin
