// The free rigid body in closed form: orientation and angular momentum at any time, no stepping.
//
//   dL_B/dt = L_B x omega_B,   dq_WB/dt = q_WB omega_B / 2,   omega_B = L_B / I_B   (no torque: L_W is constant)
//
// Frames: W world, B body (principal axes). Units: any consistent set. t may be negative; moments need not satisfy the
// triangle inequality. Cost and error do not depend on t: 8e-16 rad in q_WB, 5e-16 |L| in L_B (the largest measured),
// for the motion of the very doubles given, however near the separatrix 2 E I_b = L^2; components below 1e-265 |L| count
// as zero. Beyond 2^51 turns a double t resolves no turn: the result is then arbitrary. Every machine with IEEE doubles
// gets the same bits (-ffp-contract=off). Throws std::invalid_argument when a moment or edge is not positive and finite
// (one edge may be 0), q_WB0 is no rotation, L_W or omega_W is not finite, or these lead out of the range of double.
// Derivation and sources: docs/torque_free.md, to whose sections the code refers.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "dynamics/rigid_state.h"
#include "dynamics/torque_free_theta.h"

namespace bookspin {

class TorqueFree {
 public:
  // q_WB0 is normalized here.
  TorqueFree(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W);

  // The book of book.h with particles of mass 1 and W = B at t = 0. Its moments and L_W are not rounded to doubles: a
  // rod 1 x 2e-6 x 1e-6 would lose 0.016 rad by t = 1e5.
  [[nodiscard]] static TorqueFree of_book(const Eigen::Vector3d& size, const Eigen::Vector3d& omega_W);

  [[nodiscard]] RigidState at(double t) const;  // |q| = 1
  // states[i] = at(t[i]), to the last bit, in about half the time.
  void at(std::size_t count, const double* t, RigidState* states) const;

  // 2 K / lambda, the time between zeros of the middle-axis component of L_B: one flip of the book. Infinite on the
  // separatrix and when steady.
  [[nodiscard]] double flip_period() const;
  // First t >= 0 at which that component is zero: the middle of the first flip. Infinite if it never is.
  [[nodiscard]] double first_flip() const;

 private:
  struct Start;
  struct Sample;
  explicit TorqueFree(const Start& start);
  void rotate_steadily(const Start& start);
  void tumble(const Start& start);
  template <bool hyperbolic>
  [[nodiscard]] Sample tumbled(double t) const;
  [[nodiscard]] RigidState state_of(const Sample& s) const;

  bool steady_ = true;
  double time_scale_ = 1;                  // a power of two: time -> scaled time, in which all rates are near 1
  double L_ = 0;                           // |L|
  ThetaForm theta_;                        // rates per scaled time
  Dd phase0_;                              // flips since u = 0 at t = 0
  Dd turn_rate_;                           // mu, or |omega| / 2 when steady: quarter turns per scaled time
  Eigen::Vector3d amplitude_{0, 0, 0};     // of sn, cn, dn in L_1, L_2, L_3 over |L|; when steady: L_B / |L|
  std::array<int, 3> axis_{0, 1, 2};       // body axis of 1, 2, 3
  Eigen::Vector3d L_axis_{0, 0, 0};        // |L|, negative where the body axis points the other way
  std::array<Eigen::Vector4d, 4> frames_;  // columns: w, x, y, z of (alpha, beta) -> x, y, z, w of q_WB
};

// Rate sigma at which a small tilt from the middle axis grows, |L| / I_2 sqrt((I_2 - I_1)(I_3 - I_2) / (I_1 I_3)) for
// I_1 <= I_2 <= I_3 and L >= 0; the same for a flip's exponential beginning and end.
[[nodiscard]] double intermediate_axis_growth_rate(const Eigen::Vector3d& I_B, double L);

}  // namespace bookspin
