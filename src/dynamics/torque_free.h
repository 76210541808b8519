// The free rigid body in closed form: orientation and angular momentum at any time, no stepping.
//
//   dL_B/dt = L_B x omega_B,   dq_WB/dt = q_WB omega_B / 2,   omega_B = L_B / I_B   (no torque: L_W is constant)
//
// Frames: W world, B body (principal axes). Units: any consistent set. Cost and error do not depend on t.
// Throws std::invalid_argument when a moment is not positive and finite, q_WB0 is zero, L_W is not finite, or |L| / I overflows.
// Moments need not satisfy the triangle inequality. q_WB0 is normalised here. t may be negative.
//
// THE MOTION OF L_B. Let b be the axis of the middle moment, a the outer axis that L_B circles and c the other one: with
//   G_a = |I_b - I_a| I_c,   G_c = |I_c - I_b| I_a,   G_b = |I_c - I_a| I_b = G_a + G_c,
// a is the axis for which sqrt(G_a) |L_a| > sqrt(G_c) |L_c|; equality is the separatrix 2 E I_b = L^2. Then
//   L_a = +-A_a dn(u, k),   L_b = +-A_b sn(u, k),   L_c = +-A_c cn(u, k),   u = lambda t + u0,
//   A_a^2 = L_a^2 + (G_c / G_b) L_b^2,   A_c^2 = L_c^2 + (G_a / G_b) L_b^2,   A_b^2 = (G_b / G_a) A_c^2,
//   k^2 = G_c A_c^2 / (G_a A_a^2),   k'^2 = (G_a L_a^2 - G_c L_c^2) / (G_a A_a^2),
//   lambda^2 = A_a^2 |I_b - I_a| |I_c - I_a| / (I_a^2 I_b I_c),   |u0| = |sn| R_F(cn^2, dn^2, 1).
// Nothing is taken from 2 E I_b - L^2, which would cancel; k'^2 is factored, so that a kick of 1e-170 still counts.
//
// THE ORIENTATION. Turn the axes into a right-handed frame 1, 2, 3 = b, c, a (up to sign) with L_3 > 0 and L_2(0) >= 0, and write
// the rotation that carries it to a frame whose third axis is L as the quaternion alpha + beta i, alpha = w + z k, beta = x + y k.
// Then (alpha, beta) is parallel to (L + L_3, L_2 - k L_1) and only arg alpha is left:
//   d(arg alpha)/dt = (2 E + omega_3 L) / (2 (L + L_3)).
// It integrates to theta functions of nome Q = exp(-2 pi K'/K), the square of the nome of sn, cn and dn:
//   alpha = |alpha| exp(k mu t) theta4(z, Q),   beta = |beta| (-+k) exp(k mu t) theta1(z, Q),   z = pi u / (2 K) + s k eta,
//   s = sign(I_c - I_a),   theta1(i eta) / theta4(i eta) = i A_c / (L + A_a),
//   mu = (2 E + A_a L / I_a) / (2 (L + A_a)) - s (pi lambda / (2 K)) Im(theta4'(i eta) / theta4(i eta)).
// No integral of the third kind and no quadrature: mu is the rate at u = 0 less what theta4 contributes to it there.
//
// TWO FORMS, so that a nome never exceeds exp(-pi) and four terms of each series reach 1e-16:
//   trigonometric, K <= 2 K' (k' >= (sqrt 2 - 1)^2): as above, with p = sqrt(Q) and x = pi u / (2 K) reduced by half turns n;
//   hyperbolic, K > 2 K': Jacobi's imaginary transformation (DLMF 20.7(viii)), Q' = exp(-pi K / (2 K')), Lambda = -ln Q',
//     X = pi u / (4 K') - n Lambda, theta4(z, Q) -> exp(-2 k s eta' X / Lambda) theta2(-s eta' + k X, Q'), and
//     tan-like theta1(eta', Q') / theta2(eta', Q') = A_c / (L + A_a).
// On the separatrix (|G_a L_a^2 - G_c L_c^2| within 2^-96, the rounding of the setup) Q' = 0 and Lambda is infinite: the hyperbolic
// form is then tanh and sech. A symmetric body has k = 0, p = 0: the trigonometric form is then sin and cos. Only motions with
// L x omega = 0 (a principal axis, two or three equal moments, L = 0) have a branch of their own: a steady rotation.
//
// PRECISION. The setup is in double-double, so lambda, K, mu and eta carry 31 digits and phases are reduced exactly: the error
// does not grow with t until t itself no longer resolves a turn (2^51 turns). The nome comes from its series in
// (1 - sqrt k') / (2 (1 + sqrt k')) after one Landen step (DLMF 19.5.6), eta from Newton's iteration on the theta quotient.
//
// SOURCES. van Zon & Schofield, J. Comput. Phys. 225 (2007) 145; Celledoni, Fasso, Safstrom & Zanna, SIAM J. Sci. Comput. 30
// (2008) 2084; Hairer & Vilmart, J. Phys. A 39 (2006) 13225; DLMF ch. 19, 20, 22.
// Against that literature: the nome is the square of the usual one, which makes alpha and beta single theta functions; the phase
// is a double-double and not a truncated series of the third-kind integral; the sign of the component on the circled axis
// enters through a rotation of the axes (the published formulas are for L_3 > 0); and k' is not formed from 1 - k^2.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "dynamics/torque_free_theta.h"

namespace bookspin {

struct TorqueFreeState {
  Eigen::Quaterniond q_WB;  // |q| = 1
  Eigen::Vector3d L_B;      // angular momentum in the body frame
};

class TorqueFree {
 public:
  TorqueFree(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W);

  [[nodiscard]] TorqueFreeState at(double t) const;

  // Time between two zeros of the middle-axis component of L_B: one flip of the book. Infinite on the separatrix and when steady.
  [[nodiscard]] double flip_period() const;
  // First t >= 0 at which that component is zero: the middle of the first flip. Infinite if it never is.
  [[nodiscard]] double first_flip() const;

 private:
  bool steady_ = true;
  double time_scale_ = 1;                  // a power of two: time -> scaled time, in which all rates are near 1
  double L_ = 0;                           // |L|
  ThetaForm theta_;                        // rates per scaled time
  Dd phase0_;                              // x or X at t = 0
  Dd turn_rate_;                           // mu / (2 pi), or |omega| / (4 pi) when steady; per scaled time
  Eigen::Vector3d amplitude_{0, 0, 0};     // of L_1, L_2, L_3 over |L|; when steady: L_B / |L|
  std::array<int, 3> axis_{0, 1, 2};       // body axis of 1, 2, 3
  Eigen::Vector3d L_axis_{0, 0, 0};        // |L|, negative where the body axis points the other way
  Eigen::Matrix4d frames_ = Eigen::Matrix4d::Identity();  // (w, z, x, y) of (alpha, beta) -> (x, y, z, w) of q_WB
};

// Rate sigma at which a small tilt from the middle axis grows, |L| / I_2 sqrt((I_2 - I_1)(I_3 - I_2) / (I_1 I_3)) for
// I_1 <= I_2 <= I_3; the same for a flip's exponential beginning and end.
double intermediate_axis_growth_rate(const Eigen::Vector3d& I_B, double L);

}  // namespace bookspin
