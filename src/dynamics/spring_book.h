// The book as eight particles and 28 springs, one between each pair (paper section 3).
//
//   F_ij = -(c xhat_ij . (v_i - v_j) + k (|x_i - x_j| - l_ij)) xhat_ij,   F_ji = -F_ij,   c = damping 2 sqrt(k m)
//
// Explicit Euler as in the original: forces from the old x and v, spring by spring; x += h v; v += h F / m. All others
// use that corner 7 - i is and stays the mirror image of corner i: 16 springs. Semi-implicit Euler: x with the new v.
// Velocity Verlet, rkn6 (Blanes & Moan, J. Comput. Appl. Math. 142 (2002) 313) and stoermer10 (multistep, one force a
// step; the first step needs nine of rkn6, and so does the one after a normalization) have no damping.
// Normalization, every n-th step: v is scaled so that the kinetic energy becomes max(0.1 E0, E0 - elastic energy)
// (explicit Euler: of the OLD positions), then mean position and mean velocity are taken away. The floor answers the
// printed formula's root of a negative number; `floor_hits` counts how often it bites. Coincident particles have no
// direction: their spring pulls nothing. World frame. Overflow stays NaN. Throws std::invalid_argument for an
// integrator without a spring step (integrators.h).
#pragma once

#include <array>
#include <vector>

#include "dynamics/book.h"

namespace bookspin {

struct SpringForces {
  Corners F_W;            // force on each particle, world frame
  double elastic_energy;  // sum of k r^2 / 2 over the 28 springs
};

class SpringBook {
 public:
  using Steps = void (SpringBook::*)(double h, long n);
  using Half = std::array<double, 12>;  // corners 0 ... 3: x of the four, y, z

  explicit SpringBook(const BookOptions& options);

  // h: unit of time; n such steps by the integrator of the options, normalized when it is time
  void step(double h, long n = 1);

  [[nodiscard]] const Corners& corners_W() const { return x_W_; }
  [[nodiscard]] const Corners& velocities_W() const { return v_W_; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const;  // about the origin
  [[nodiscard]] double kinetic_energy() const;
  [[nodiscard]] double elastic_energy() const { return forces(x_W_, v_W_).elastic_energy; }
  [[nodiscard]] long floor_hits() const { return floor_hits_; }

  [[nodiscard]] SpringForces forces(const Corners& x_W, const Corners& v_W) const;

  [[nodiscard]] Half accelerations(const Half& x, const Half& v) const;  // of a book that is its own mirror image

  // The steps of each integrator, never normalized.
  void explicit_euler_steps(double h, long n);
  void semi_implicit_euler_steps(double h, long n);
  void verlet_steps(double h, long n);
  void rk4_steps(double h, long n);
  void rkn6_steps(double h, long n);
  void stoermer10_steps(double h, long n);

 private:
  void normalize(double elastic_energy);
  void start_multistep(double h);
  void keep(const Half& x, const Half& v);

  double stiffness_;
  double stiffness_over_mass_;
  double particle_mass_;
  double damping_;  // c, mass over time
  Steps steps_;
  Normalization normalization_;
  std::array<double, 28> rest_length_;                  // pairs (i, j), i < j, row by row
  std::array<std::array<double, 4>, 4> packet_length_;  // of the 16 springs of `accelerations`
  Corners x_W_;
  Corners v_W_;
  double old_elastic_energy_ = 0.0;  // explicit Euler: before the last step
  double start_energy_;              // E0: kinetic, since the springs start at rest
  long floor_hits_ = 0;

  double multistep_h_ = 0.0;  // stoermer10: the step of what follows; 0: to be started
  Half advance_;              // x now - x one step ago
  std::vector<Half> past_;    // accelerations at multiples of h, the newest at newest_ and the older ones behind it
  std::size_t newest_ = 0;
};

}  // namespace bookspin
