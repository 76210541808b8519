// One step of the free rigid body on the state (q_WB, L_B): the methods beyond the paper's.
//
//   q_WB' = q_WB omega_B / 2,  L_B' = L_B x omega_B,  omega_B = L_B / I_B.
//
// L_B keeps a small component's digits, which L_W would lose: a kick of 1e-15 still decides when the book flips.
// All but rk4 turn L_B by the inverse of what they turn q_WB by: L_W changes by rounding alone.
//   rk4         the classical method
//   splitting2  kick, free symmetric top, kick; splitting4: five of them (Suzuki)
//   dmv2        discrete Moser-Veselov: h [L_B] = F D - D F^T, L_B' = F^T L_B, q' = q F; dmv6, dmv10: the same with
//               moments preprocessed for the step (Hairer & Vilmart, J. Phys. A 39 (2006) 13225)
// Nothing throws. A DMV step beyond its reach leaves NaN: h |omega| over 0.9 to 1.1 (dmv2), over 1.2 to 1.5 (dmv6, 10),
// the more different the moments the sooner; dmv6 and dmv10 sooner still for very thin rods.
#pragma once

#include <Eigen/Core>

#include "dynamics/book.h"
#include "dynamics/rigid_state.h"

namespace bookspin {

using RigidStep = void (*)(RigidState& state, const Eigen::Vector3d& step_moments, double h);

void rk4_step(RigidState& state, const Eigen::Vector3d& I_B, double h);
void splitting2_step(RigidState& state, const Eigen::Vector3d& I_B, double h);
void splitting4_step(RigidState& state, const Eigen::Vector3d& I_B, double h);
void dmv_step(RigidState& state, const Eigen::Vector3d& step_moments, double h);

// The moments to step with: I_B itself, or what dmv6 and dmv10 put in its place for steps h of the motion through L_B;
// NaN where their series are not to be trusted: a moment would change by more than half.
[[nodiscard]] Eigen::Vector3d step_moments(Integrator integrator, const Eigen::Vector3d& I_B,
                                           const Eigen::Vector3d& L_B, double h);

}  // namespace bookspin
