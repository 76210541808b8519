// One step of the free rigid body on the state (q_WB, L_B): the methods beyond the paper's.
//
//   q_WB' = q_WB omega_B / 2,  L_B' = L_B x omega_B,  omega_B = L_B / I_B.
//
// Carrying L_B keeps a small component's own digits, which L_W turned into the body frame would lose: a kick of 1e-15 still
// decides when the book flips. All but rk4 only rotate L_B, by the inverse of what they turn q_WB by: L_W changes by rounding alone.
//   rk4         the classical method of order 4
//   splitting2  kick, free symmetric top, kick; both flows exact. Order 2; splitting4: Suzuki's composition of five, order 4
//   dmv2        discrete Moser-Veselov: h [L_B] = F D - D F^T, L_B' = F^T L_B, q' = q F; dmv6, dmv10: the same with moments
//               that were preprocessed for the step, so that the order is 6 or 10 (Hairer & Vilmart, J. Phys. A 39 (2006) 13225)
// Nothing throws. A DMV step beyond its reach leaves a state of NaN: it ends at h |omega| between 0.9 and 1.1 for dmv2, 1.2 and 1.5
// for dmv6 and dmv10 (the more different the moments, the sooner); for rods thinner than about 1 : 300, dmv6 and dmv10 end sooner.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/book.h"

namespace bookspin {

struct RigidState {
  Eigen::Quaterniond q_WB;
  Eigen::Vector3d L_B;  // angular momentum, body frame
};

using RigidStep = void (*)(RigidState& state, const Eigen::Vector3d& step_moments, double h);

// The step of a rigid integrator other than explicit Euler.
[[nodiscard]] RigidStep rigid_step(Integrator integrator);

// The moments to step with: I_B itself, or what dmv6 and dmv10 put in its place for steps h of the motion through L_B; NaN where
// their series are not to be trusted: a moment would change by more than half.
[[nodiscard]] Eigen::Vector3d step_moments(Integrator integrator, const Eigen::Vector3d& I_B, const Eigen::Vector3d& L_B, double h);

}  // namespace bookspin
