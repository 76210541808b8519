// The book as eight particles and 28 springs, one between each pair (paper section 3).
//
//   F_ij = -(c xhat_ij . (v_i - v_j) + k (|x_i - x_j| - l_ij)) xhat_ij,   F_ji = -F_ij,   c = damping 2 sqrt(k m)
//
// Explicit Euler as in the original: forces from the old x and v; x += h v; v += h F / m. Semi-implicit Euler: x with
// the new v. Velocity Verlet and its composition of 17 stages (stable for long up to h near 2.7 / sqrt(8 k / m)) need
// damping 0: half a kick that depends on v is not undone by half a kick backwards, and the order would fall to 1.
// Normalization, every n-th step: v is scaled so that the kinetic energy becomes max(0.1 E0, E0 - elastic energy)
// (explicit Euler: of the OLD positions), then mean position and mean velocity are taken away. The floor answers the
// printed formula's root of a negative number; `floor_hits` counts how often it bites. Coincident particles have no
// direction: their spring pulls nothing. World frame. Overflow stays NaN. Throws std::invalid_argument for an
// integrator without a spring step (integrators.h).
#pragma once

#include <array>

#include "dynamics/book.h"

namespace bookspin {

struct SpringForces {
  Corners F_W;            // force on each particle, world frame
  double elastic_energy;  // sum of k r^2 / 2 over the 28 springs
};

class SpringBook {
 public:
  using Step = void (SpringBook::*)(double h);

  explicit SpringBook(const BookOptions& options);

  void step(double h);  // h: unit of time; by the integrator of the options, normalized when it is time

  [[nodiscard]] const Corners& corners_W() const { return x_W_; }
  [[nodiscard]] const Corners& velocities_W() const { return v_W_; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const;  // about the origin
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double elastic_energy() const { return forces(x_W_, v_W_).elastic_energy; }
  [[nodiscard]] long floor_hits() const { return floor_hits_; }

  [[nodiscard]] SpringForces forces(const Corners& x_W, const Corners& v_W) const;

  // One step of each integrator, never normalized.
  void explicit_euler_step(double h);
  void semi_implicit_euler_step(double h);
  void verlet_step(double h);
  void rk4_step(double h);
  void composition8_step(double h);

 private:
  void normalize(double elastic_energy);

  double stiffness_;
  double particle_mass_;
  double damping_;  // c, mass over time
  Step step_;
  Normalization normalization_;
  std::array<double, 28> rest_length_;  // pairs (i, j), i < j, row by row
  Corners x_W_;
  Corners v_W_;
  Corners F_W_;                      // Verlet: the forces at x_W_
  double old_elastic_energy_ = 0.0;  // explicit Euler: before the last step
  double start_energy_;              // E0: kinetic, since the springs start at rest
  long floor_hits_ = 0;
};

}  // namespace bookspin
