// Steps of the free rigid body on the state (q_WB, L_B): the methods beyond the paper's.
//
//   q_WB' = q_WB omega_B / 2,  L_B' = L_B x omega_B,  omega_B = L_B / I_B.
//
// L_B keeps a small component's digits, which L_W would lose: a kick of 1e-15 still decides when the book flips.
// dmv turns L_B by the inverse of what it turns q_WB by: L_W changes by rounding alone.
//   rk4  the classical method
//   dmv  discrete Moser-Veselov: h [L_B] = F D - D F^T, L_B' = F^T L_B, q' = q F, with the moments for which the step is
//        the motion itself (that they exist: Hairer & Vilmart, J. Phys. A 39 (2006) 13225)
// Nothing throws. Beyond DMV's reach, h |omega| = pi / 2 at the fastest of this |L| and energy, the state is NaN.
#pragma once

#include <Eigen/Core>

#include "dynamics/book.h"
#include "dynamics/rigid_state.h"

namespace bookspin {

// What steps of one size need, from the motion that passes through one state.
struct RigidPlan {
  double h = 0.0;  // 0: of no step yet
  Eigen::Vector3d I_B{1.0, 1.0, 1.0};
  Eigen::Vector3d dmv_moments{1.0, 1.0, 1.0};  // dmv alone
};

[[nodiscard]] RigidPlan rigid_plan(Integrator integrator, const Eigen::Vector3d& I_B, const Eigen::Vector3d& L_B,
                                   double h);

// n steps; q_WB is normalized whenever it is due.
using RigidSteps = void (*)(RigidState& state, const RigidPlan& plan, long n, Normalization& normalization);

void rk4_steps(RigidState& state, const RigidPlan& plan, long n, Normalization& normalization);
void dmv_steps(RigidState& state, const RigidPlan& plan, long n, Normalization& normalization);

}  // namespace bookspin
