// The free rigid body in closed form: orientation and angular momentum at any time, no stepping.
//
//   dL_B/dt = L_B x omega_B,   dq_WB/dt = q_WB omega_B / 2,   omega_B = L_B / I_B   (no torque: L_W is constant)
//
// Frames: W world, B body (principal axes). Units: any consistent set. Cost and error do not depend on t, which may be
// negative. Moments need not satisfy the triangle inequality. q_WB0 is normalised here.
// Throws std::invalid_argument when a moment is not positive and finite, q_WB0 is no rotation, L_W is not finite, or
// |L| / I overflows.
//
// 1. L_B. Let b be the axis of the middle moment, a the outer axis that L_B circles and c the other one. With
//      G_a = |I_b - I_a| I_c,   G_c = |I_c - I_b| I_a,   G_b = |I_c - I_a| I_b = G_a + G_c,
//    a is the axis for which sqrt(G_a) |L_a| > sqrt(G_c) |L_c|; equality is the separatrix 2 E I_b = L^2. Then
//      L_a = +-A_a dn(u, k),   L_b = +-A_b sn(u, k),   L_c = +-A_c cn(u, k),   u = lambda t + u0,
//      A_a^2 = L_a^2 + (G_c / G_b) L_b^2,   A_c^2 = L_c^2 + (G_a / G_b) L_b^2,   A_b^2 = (G_b / G_a) A_c^2,
//      k^2 = G_c A_c^2 / (G_a A_a^2),   k'^2 = (G_a L_a^2 - G_c L_c^2) / (G_a A_a^2),
//      lambda^2 = A_a^2 |I_b - I_a| |I_c - I_a| / (I_a^2 I_b I_c),   |u0| = |sn| R_F(cn^2, dn^2, 1).
//    All are sums of squares but k'^2, whose difference is formed as a product of sum and difference: a kick of 1e-170
//    still counts. Nothing is taken from 2 E I_b - L^2 or 1 - k^2.
//
// 2. Orientation. Name the axes 1, 2, 3 = b, c, a, each up to sign, so that they are right-handed, L_3 > 0 and
//    L_2(0) >= 0. Let w + x i + y j + z k be the rotation that carries them to a frame whose third axis is L. As
//    complex numbers (i the imaginary unit from here on) alpha = w + i z and beta = x + i y satisfy
//      beta / alpha = (L_2 - i L_1) / (L + L_3),   d(arg alpha)/dt = (2 E + omega_3 L) / (2 (L + L_3)),
//    so only arg alpha is left to find. In theta functions of nome Q = exp(-2 pi K'/K), the square of that of sn,
//      alpha : beta = theta4(z) : -i s theta1(z),   arg alpha = mu t + arg theta4(z) + constant,
//      z = x + i s eta,   x = pi u / (2 K),   s = sign(I_c - I_a),   theta1(i eta) / theta4(i eta) = i A_c / (L + A_a),
//      mu = (2 E + A_a L / I_a) / (2 (L + A_a)) - s (dx/dt) Im(theta4'(i eta) / theta4(i eta)).
//    No integral of the third kind and no quadrature: mu is the rate at u = 0 less what theta4 contributes to it there.
//
// 3. Two forms, so that no nome exceeds exp(-pi) and four terms of a series reach 1e-16.
//    Trigonometric, K <= 2 K', that is k' >= (sqrt 2 - 1)^2: as above, x reduced by multiples of pi.
//    Hyperbolic, K > 2 K': Jacobi's imaginary transformation (DLMF 20.7.30 to 33) with Q' = exp(-pi K / (2 K')),
//      X = pi u / (4 K') reduced by multiples of Lambda = -ln Q',
//      arg alpha = mu t - (2 s eta' / Lambda) X + arg theta2(-s eta' + i X, Q') + constant,
//      theta1(eta', Q') / theta2(eta', Q') = A_c / (L + A_a).
//    On the separatrix (sqrt(G_a) |L_a| and sqrt(G_c) |L_c| equal to 2^-96, the rounding of the setup) Q' = 0 and
//    Lambda is infinite: this is then tanh and sech. A symmetric body has k = Q = 0: the trigonometric form is then sin
//    and cos. Only L x omega = 0 (a principal axis, equal moments, L = 0) has a branch of its own, a steady rotation.
//
// 4. Precision. The setup is in double-double: lambda, K, eta and mu have 30 digits and phases are reduced exactly,
//    so the error does not grow while t resolves a turn (up to 2^51 turns; beyond, the result is finite and arbitrary).
//    The nome comes from its series in (1 - sqrt k') / (2 (1 + sqrt k')) (DLMF 19.5.6) after a Landen step, eta from
//    Newton's iteration on the theta quotient, whose derivative is known at the root. Only u0, whose error does not
//    grow, is in long double.
//
// Sources: van Zon & Schofield, J. Comput. Phys. 225 (2007) 145; Celledoni, Fasso, Safstrom & Zanna, SIAM J. Sci.
// Comput. 30 (2008) 2084, with the corrections of P. Leroy, On an Article by Celledoni et al. (2020); Hairer & Vilmart,
// J. Phys. A 39 (2006) 13225; DLMF ch. 19, 20, 22. No formula is taken over as printed: all were derived in the
// convention above and checked against Taylor series of 50 digits. What differs: the squared nome, which makes alpha
// and beta single theta functions; no arc tangent of t, so no count of its branches; the sign on the circled axis as a
// rotation of the axes; and k'^2 on its own footing, not as 1 - k^2.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "dynamics/rigid_state.h"
#include "dynamics/torque_free_theta.h"

namespace bookspin {

class TorqueFree {
 public:
  TorqueFree(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W);

  [[nodiscard]] RigidState at(double t) const;  // |q| = 1

  // 2 K / lambda, the time between zeros of the middle-axis component of L_B: one flip of the book. Infinite on the
  // separatrix and when steady.
  [[nodiscard]] double flip_period() const;
  // First t >= 0 at which that component is zero: the middle of the first flip. Infinite if it never is.
  [[nodiscard]] double first_flip() const;

 private:
  bool steady_ = true;
  double time_scale_ = 1;               // a power of two: time -> scaled time, in which all rates are near 1
  double L_ = 0;                        // |L|
  ThetaForm theta_;                     // rates per scaled time
  Dd phase0_;                           // x or X at t = 0
  Dd turn_rate_;                        // mu / (2 pi), or |omega| / (4 pi) when steady; per scaled time
  Eigen::Vector3d amplitude_{0, 0, 0};  // of L_1, L_2, L_3 over |L|; when steady: L_B / |L|
  std::array<int, 3> axis_{0, 1, 2};    // body axis of 1, 2, 3
  Eigen::Vector3d L_axis_{0, 0, 0};     // |L|, negative where the body axis points the other way
  Eigen::Matrix4d frames_ = Eigen::Matrix4d::Identity();  // (w, z, x, y) of (alpha, beta) -> (x, y, z, w) of q_WB
};

// Rate sigma at which a small tilt from the middle axis grows, |L| / I_2 sqrt((I_2 - I_1)(I_3 - I_2) / (I_1 I_3)) for
// I_1 <= I_2 <= I_3; the same for a flip's exponential beginning and end.
double intermediate_axis_growth_rate(const Eigen::Vector3d& I_B, double L);

}  // namespace bookspin
