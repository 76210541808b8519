// The theta functions of the torque-free motion as short polynomials (docs/torque_free.md, sections 3 and 4).
//
// theta_form: once a motion, in double-double. theta_at: phase -> sn, cn, dn and alpha, in double at any time, in
// double-double at the start. alpha is theta4(x + i s eta, Q), or theta2(-s eta' + i X, Q') / exp |X|: only its
// argument has a meaning. Sine, cosine and exponential are series of their own, with 1 / n! for coefficients: where
// doubles are IEEE doubles, every machine gets the same bits.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

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
  bool hyperbolic = false;         // K > 2 K'
  Dd frequency;                    // flips, half periods of sn, per time; on the separatrix d(X)/dt
  double period = 1;               // of X in a flip: Lambda = -ln Q'
  double reduce = 1;               // 0 on the separatrix: never drop periods
  Dd mu;                           // secular rate of arg alpha
  double kappa = 0;                // 2 s eta' / Lambda, in quarter turns
  double nome = 0;                 // p = sqrt Q, or Q'
  double limit = 350;              // of |X|: Lambda / 2, but at most 350, where L is along the middle axis to 1e-300
  std::array<double, 4> alpha_re;  // over 2 p cos 2x, or 2 Q' cosh 2X
  std::array<double, 4> alpha_im;  //
  std::array<double, 5> theta12;   // theta1 / sin = even + odd part, theta2 / cos = even - odd; over 2 p cos 2x, or
  std::array<double, 5> theta34;   // theta3 = even + odd, theta4 = even - odd                 over 2 Q'^2 cosh 4X
  Dd sn_scale, cn_scale, dn_scale;
};

// motion: k^2 + k'^2 = 1, lambda > 0. Nothing throws; what is not finite comes back so.
[[nodiscard]] ThetaForm theta_form(const EllipticMotion& motion);

template <class Real>
struct ThetaValues {
  Real alpha_re, alpha_im;
  Real quarters;      // to be added to arg alpha besides mu t: -kappa X, in quarter turns
  double sn, cn, dn;  // without their scales
};

template <class Real>
struct SinCos {
  Real sin, cos;
};

// x to the nearest integer, plus a constant that brings the integer's last bit to the last bit of the sum; |x| < 2^51.
inline constexpr double to_integer = 0x1.8p52;

template <int First, int Step, int Terms, class Real>
constexpr std::array<Real, Terms> reciprocal_factorials() {  // 1 / (First + Step n)!
  std::array<Real, Terms> table;
  Dd term = 1.0;
  for (int n = 2; n <= First + Step * (Terms - 1); ++n) {
    term = term / static_cast<double>(n);
    if (n >= First && (n - First) % Step == 0) table[static_cast<std::size_t>((n - First) / Step)] = Real(term);
  }
  return table;
}

// Sum of x^n / (First + Step n)!, Terms even; in a Dd the first three terms are, and the others are small.
template <int First, int Step, int Terms, class Real>
Real factorial_series(Real x) {
  static constexpr auto terms = reciprocal_factorials<First, Step, Terms, double>();
  if constexpr (std::is_same_v<Real, double>) {  // even and odd powers side by side
    const double square = x * x;
    double even = terms[Terms - 2];
    double odd = terms[Terms - 1];
    for (std::size_t n = Terms - 2; n > 0; n -= 2) {
      even = even * square + terms[n - 2];
      odd = odd * square + terms[n - 1];
    }
    return even + x * odd;
  } else {
    static constexpr auto heads = reciprocal_factorials<First, Step, 3, Real>();
    double tail = terms[Terms - 1];
    for (std::size_t n = Terms - 1; n-- > 3;) tail = tail * x.hi + terms[n];
    Real sum = tail;
    for (std::size_t n = 3; n-- > 0;) sum = sum * x + heads[n];
    return sum;
  }
}

// Sine and cosine of r for square = -r^2, hyperbolic for square = r^2; |r| <= pi / 4.
template <int Terms, class Real>
[[gnu::always_inline]] inline SinCos<Real> odd_even_series(Real r, Real square) {
  return {r + r * (square * factorial_series<3, 2, Terms>(square)),
          Real(1.0) + square * factorial_series<2, 2, Terms>(square)};
}

// Sine and cosine of an angle in quarter turns, |quarters.hi| < 2^51, |quarters.lo| <= 1; beyond, of another angle.
template <class Real>
[[gnu::always_inline]] inline SinCos<Real> sincos_of_quarters(Dd quarters) {
  const double first = quarters.hi + to_integer;
  const Real rest = Real(quarters.hi - (first - to_integer)) + Real(quarters.lo);
  const double second = static_cast<double>(rest) + to_integer;
  const Real r = (rest - Real(second - to_integer)) * Real(dd_pi * 0.5);
  const auto [sine, cosine] = odd_even_series<8>(r, -(r * r));
  const std::uint64_t quadrant = std::bit_cast<std::uint64_t>(first) + std::bit_cast<std::uint64_t>(second);
  if constexpr (std::is_same_v<Real, double>) {  // branches would be mispredicted
    const auto sine_bits = std::bit_cast<std::uint64_t>(sine);
    const auto cosine_bits = std::bit_cast<std::uint64_t>(cosine);
    const std::uint64_t swap = (sine_bits ^ cosine_bits) & -(quadrant & 1);
    return {std::bit_cast<double>(sine_bits ^ swap ^ (quadrant >> 1 << 63)),
            std::bit_cast<double>(cosine_bits ^ swap ^ ((quadrant + 1) >> 1 << 63))};
  } else {
    SinCos<Real> turned{sine, cosine};
    if (quadrant % 2 == 1) std::swap(turned.sin, turned.cos);
    if (quadrant / 2 % 2 == 1) turned.sin = -turned.sin;
    if ((quadrant + 1) / 2 % 2 == 1) turned.cos = -turned.cos;
    return turned;
  }
}

template <class Real>
struct Exponentials {
  Real growth, decay;  // exp(x), exp(-x)
};

// 0 <= x <= 700.
template <class Real>
[[gnu::always_inline]] inline Exponentials<Real> exponentials(Real x) {
  constexpr double ln2_high = 0x1.62e42feep-1;  // 32 bits
  constexpr double ln2_low = 0x1.a39ef35793c76p-33;
  const double shifted = static_cast<double>(x) * 0x1.71547652b82fep+0 + to_integer;
  const double n = shifted - to_integer;
  const Real r = (x - Real(n * ln2_high)) - Real(n * ln2_low);
  const auto [sinh, cosh] = odd_even_series<6>(r, r * r);
  const auto power_of_2 = [](std::uint64_t exponent) { return Real(std::bit_cast<double>((exponent + 1023) << 52)); };
  const auto exponent = std::bit_cast<std::uint64_t>(shifted);
  return {(cosh + sinh) * power_of_2(exponent), (cosh - sinh) * power_of_2(-exponent)};
}

template <std::size_t Terms, class Real, std::size_t N>
Real polynomial(const std::array<double, N>& coefficient, Real x) {
  static_assert(Terms <= N);
  Real value = coefficient[Terms - 1];
  for (std::size_t i = Terms - 1; i-- > 0;) value = value * x + coefficient[i];
  return value;
}

struct EvenOdd {
  double even, odd;
};

template <std::size_t Terms>
EvenOdd even_odd(const std::array<double, 5>& c, double x) {
  const double square = x * x;
  if constexpr (Terms == 3) {
    return {c[0] + square * c[2], x * c[1]};
  } else {
    return {c[0] + square * (c[2] + square * c[4]), x * (c[1] + square * c[3])};
  }
}

// phase: flips since u = 0 (on the separatrix X). hyperbolic: as form.hyperbolic.
template <class Real, bool hyperbolic>
[[gnu::always_inline]] inline ThetaValues<Real> theta_at(const ThetaForm& form, Dd phase) {
  if constexpr (!hyperbolic) {
    const auto [sine, cosine] = sincos_of_quarters<Real>({2 * phase.hi, 2 * phase.lo});
    const Real argument = (cosine - sine) * (cosine + sine) * Real(2 * form.nome);
    const auto [even12, odd12] = even_odd<5>(form.theta12, static_cast<double>(argument));
    const auto [even34, odd34] = even_odd<5>(form.theta34, static_cast<double>(argument));
    const double inverse = 1 / (even34 - odd34);
    return {polynomial<4>(form.alpha_re, argument),
            sine * cosine * polynomial<3>(form.alpha_im, argument),
            0.0,
            static_cast<double>(sine) * (even12 + odd12) * inverse,
            static_cast<double>(cosine) * (even12 - odd12) * inverse,
            (even34 + odd34) * inverse};
  }
  const double shifted = phase.hi * form.reduce + to_integer;
  const Real x = (Real(phase.hi - (shifted - to_integer)) + Real(phase.lo)) * Real(form.period);
  const double sign = std::copysign(1.0, static_cast<double>(x));
  const auto parity =
      std::bit_cast<double>(std::bit_cast<std::uint64_t>(1.0) | std::bit_cast<std::uint64_t>(shifted) << 63);
  const Real distance = std::min(x * Real(sign), Real(form.limit));
  const auto [growth, decay] = exponentials(distance + distance);
  const Real cosh2 = (growth + decay) * Real(form.nome);  // 2 Q' cosh 2X, at most 1 + Q'^2
  const double nome2 = form.nome * form.nome;
  const auto H = static_cast<double>(cosh2);
  const double cosh4 = H * H - 2 * nome2;  // 2 Q'^2 cosh 4X
  const auto [even12, odd12] = even_odd<3>(form.theta12, cosh4);
  const auto [even34, odd34] = even_odd<3>(form.theta34, cosh4);
  const double square = static_cast<double>(decay) * static_cast<double>(decay);
  const double inverse = parity / ((1 + square) * (even12 - odd12));
  const double scale = 2 * static_cast<double>(decay) * inverse;
  return {(Real(1.0) + decay) * polynomial<4>(form.alpha_re, cosh2),
          (Real(1.0) - decay) * polynomial<4>(form.alpha_im, cosh2) * Real(sign),
          x * Real(-form.kappa),
          sign * (1 - square) * (even12 + odd12) * inverse,
          (even34 - odd34) * scale,
          (even34 + odd34) * scale * parity};
}

}  // namespace bookspin
