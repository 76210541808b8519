// The theta functions of the torque-free motion (torque_free.h has the formulas), prepared as short polynomials.
//
// theta_form: once a motion, in double-double and long double. theta_values: x (or X) -> sn, cn, dn and alpha.
// alpha is theta4(x + i s eta, Q), or theta2(-s eta' + i X, Q') / exp |X|: only its argument has a meaning.
// x is taken within half a period of 0, where the elliptic functions run over -K <= u <= K.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "dynamics/torque_free_dd.h"

namespace bookspin {

struct EllipticMotion {
  Dd k;             // modulus, 0 <= k <= 1
  Dd k_prime;       // complementary modulus; 0: on the separatrix
  Dd lambda;        // du/dt
  Dd tangent;       // A_c / (L + A_a), 0 < tangent <= 1
  Dd rate_at_zero;  // d(arg alpha)/dt where u = 0
  double s = 1;     // sign(I_c - I_a)
};

struct ThetaForm {
  bool hyperbolic = false;           // K > 2 K'
  Dd frequency;                      // periods of x = pi u / (2 K), or of X = pi u / (4 K'), per time
  double period = 1;                 // of x: pi, of X: Lambda = -ln Q'; 1 on the separatrix, where nothing is periodic
  double reduce = 1;                 // 0 on the separatrix: never drop periods
  Dd mu;                             // secular rate of arg alpha
  double kappa = 0;                  // 2 s eta' / Lambda; 0 in the trigonometric form
  double nome = 0;                   // Q', hyperbolic
  double limit = 350;                // of |X|: Lambda / 2, but at most 350, where L is along the middle axis to 1e-300
  std::array<double, 4> alpha_re{};  // in cos 2x, or in 2 Q' cosh 2X
  std::array<double, 4> alpha_im{};  //
  std::array<double, 5> theta1{};    // over sin x or sinh 2X, scaled to give sn
  std::array<double, 5> theta2{};    // over cos x (scaled to give cn) or cosh 2X
  std::array<double, 3> even{};      // theta3 = even + odd, theta4 = even - odd
  std::array<double, 2> odd{};       // over cos 2x; unused in the hyperbolic form
  double cn_scale = 1;               // hyperbolic form
  double dn_scale = 1;               // both
};

template <class Real>
struct ThetaValues {
  Real alpha_re, alpha_im;  // arg alpha, up to mu t - kappa X
  Real sn, cn, dn;
};

ThetaForm theta_form(const EllipticMotion& motion);

template <std::size_t Terms, class Real, std::size_t N>
Real polynomial(const std::array<double, N>& coefficient, Real x) {
  static_assert(Terms <= N);
  Real value = coefficient[Terms - 1];
  for (std::size_t i = Terms - 1; i-- > 0;) value = value * x + coefficient[i];
  return value;
}

template <class Real>
ThetaValues<Real> trigonometric_values(const ThetaForm& form, Real x) {
  const Real sine = std::sin(x);
  const Real cosine = std::cos(x);
  const Real cos2 = (cosine - sine) * (cosine + sine);
  const Real even = polynomial<3>(form.even, cos2 * cos2);
  const Real odd = cos2 * polynomial<2>(form.odd, cos2 * cos2);
  const Real inverse = 1 / (even - odd);
  return {polynomial<4>(form.alpha_re, cos2), sine * cosine * polynomial<3>(form.alpha_im, cos2),
          sine * polynomial<5>(form.theta1, cos2) * inverse, cosine * polynomial<5>(form.theta2, cos2) * inverse,
          (even + odd) * inverse * form.dn_scale};
}

template <class Real>
ThetaValues<Real> hyperbolic_values(const ThetaForm& form, Real x) {
  const Real growth = std::exp(2 * std::min(std::abs(x), static_cast<Real>(form.limit)));
  const Real decay = 1 / growth;
  const Real sign = x < 0 ? -1 : 1;
  const Real cosh2 = form.nome * (growth + decay);                     // 2 Q' cosh 2X, at most 1 + Q'^2
  const Real cosh4 = cosh2 * cosh2 - 2 * Real(form.nome) * form.nome;  // 2 q' cosh 4X, q' = Q'^2
  const Real even = polynomial<2>(form.even, cosh4 * cosh4);
  const Real square = decay * decay;
  const Real inverse = 1 / ((1 + square) * polynomial<3>(form.theta2, cosh4));
  const Real scale = 2 * decay * inverse;
  return {(1 + decay) * polynomial<4>(form.alpha_re, cosh2), sign * (1 - decay) * polynomial<4>(form.alpha_im, cosh2),
          sign * (1 - square) * polynomial<3>(form.theta1, cosh4) * inverse, (even - cosh4) * scale * form.cn_scale,
          (even + cosh4) * scale * form.dn_scale};
}

template <class Real>
ThetaValues<Real> theta_values(const ThetaForm& form, Real x) {
  return form.hyperbolic ? hyperbolic_values(form, x) : trigonometric_values(form, x);
}

}  // namespace bookspin
