// The book at rest and what a script may say about how it moves.
//
// One body serves every method: eight particles of equal mass m at the corners of an a x b x c cuboid. Its principal
// moments are 2 m (b^2 + c^2, a^2 + c^2, a^2 + b^2): three times those of the solid cuboid of the same mass, and twice
// those that the original program used, so that from equal angular velocities the torque-free motion is the same for
// all of them.
// Units are the scene's own (length, time, mass); energies and angular momenta follow from them.
// Source: paper sections 3.1 and 4.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "dynamics/corners.h"

namespace bookspin {

// One row each in integrators.h.
enum class Integrator { explicit_euler, semi_implicit_euler, velocity_verlet, rk4, rkn6, stoermer10, dmv };

struct BookOptions {
  Eigen::Vector3d size{1.878, 2.9085, 0.5};            // full edge lengths a, b, c along the body axes; flat: one is 0
  Eigen::Vector3d omega_W{0.0, 0.0, 0.0};              // at the start, where W = B; radians per unit of time
  Integrator integrator = Integrator::explicit_euler;  // how the state is stepped
  int normalize_every = 1;                             // steps between two normalizations; 0: never
  double damping = 1.0;                                // springs only: multiple of the critical 2 sqrt(k m), >= 0
  double stiffness = 10.0;                             // springs only: k of each of the 28 springs, > 0
  double particle_mass = 1.0;                          // m of each of the eight particles, > 0
  Eigen::Vector3d moments{0.0, 0.0, 0.0};              // principal, of particles of mass 1; 0: those of `size`
  bool operator==(const BookOptions&) const = default;
};

struct Body {
  Corners corners_B;    // at rest, about the center
  Eigen::Vector3d I_B;  // principal moments, mass times length squared
  double reach;         // from the center to a corner: half the diagonal
};

// The only place that knows what body the options describe. A flat one's corners are a hundredth of its longest edge
// apart, to be seen; its moments are those of the plate.
[[nodiscard]] Body body_of(const BookOptions& options);

// The book, of particles of mass 1, that has these principal moments; none when no body has: each is at most the sum
// of the other two. An edge that rounding alone makes is 0.
[[nodiscard]] std::optional<Eigen::Vector3d> size_of(const Eigen::Vector3d& moments);

// Counts a book's steps: asked once after each, it says whether the state is to be normalized now.
struct Normalization {
  int every;  // 0: never
  int since = 0;
  [[nodiscard]] bool due() {
    if (every <= 0 || ++since < every) return false;
    since = 0;
    return true;
  }
};

}  // namespace bookspin
