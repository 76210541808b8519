// A trajectory as CSV: one row a frame and book, "%.17g", so that every double survives; nan where there is no number.
//
// frame,t,book,c0x,c0y,c0z,...,c7z,qw,qx,qy,qz,Lx,Ly,Lz,kinetic_energy,elastic_energy,stretch,angle_error,
// omega_x,omega_y,omega_z, then every other quantity (scene/quantities.h) in the table's order.
// Corners are about the book's own center (its position in the picture is not part of its motion), world frame; q, L and
// omega are those of BookFrame, world frame.
#pragma once

#include <string>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] std::string trajectory_csv_header();  // without the line's end

// The rows of one frame, each with its line's end.
[[nodiscard]] std::string trajectory_csv_rows(const Scene& scene, const Trajectory& trajectory, int frame);

}  // namespace bookspin
