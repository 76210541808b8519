#include "dynamics/torque_free.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace bookspin {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using ExactVector = std::array<Expansion, 3>;
using DdVector = std::array<Dd, 3>;
using DdQuaternion = std::array<Dd, 4>;  // w, x, y, z

[[noreturn]] void refuse(const char* what) {
  throw std::invalid_argument(std::string("torque-free motion: ") + what);
}

// A power of two as great as the largest component, or a little greater.
int exponent_of(const Vector3d& v) {
  int exponent = 0;
  std::frexp(v.cwiseAbs().maxCoeff(), &exponent);
  return exponent;
}

Vector3d divided_by_power_of_2(const Vector3d& v, int exponent) {
  return v.unaryExpr([exponent](double x) { return std::ldexp(x, -exponent); });
}

DdQuaternion product(const DdQuaternion& p, const DdQuaternion& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

Dd squared_norm(const DdQuaternion& q) {
  return q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
}

Quaterniond normalized(const DdQuaternion& q) {
  const Dd scale = Dd(1.0) / sqrt(squared_norm(q));
  return {(q[0] * scale).hi, (q[1] * scale).hi, (q[2] * scale).hi, (q[3] * scale).hi};
}

// (alpha, beta) proportional to (re + i im) (L + L_3, L_2 - i L_1), as the quaternion w, x, y, z: section 2.
template <class Real>
std::array<Real, 4> cayley_klein(Real re, Real im, Real L1, Real L2, Real L_plus_L3) {
  return {L_plus_L3 * re, re * L2 + im * L1, im * L2 - re * L1, L_plus_L3 * im};
}

// Carlson's R_F(x^2, y^2, z^2) by duplication (DLMF 19.36.1), whose first step needs no squares: x and y may be 1e-300.
Dd carlson_rf(Dd x, Dd y, Dd z) {
  DdVector square{x * x, y * y, z * z};
  DdVector root{x, y, z};
  Dd mean;
  double spread = 1;
  for (int round = 0; round < 40 && spread > 2e-3 * mean.hi; ++round) {
    const Dd shift = root[0] * (root[1] + root[2]) + root[1] * root[2];
    for (std::size_t i = 0; i < 3; ++i) {
      square[i] = (square[i] + shift) * 0.25;
      root[i] = sqrt(square[i]);
    }
    mean = (square[0] + square[1] + square[2]) / 3.0;
    const auto [least, most] = std::minmax({square[0].hi, square[1].hi, square[2].hi});
    spread = most - least;
  }
  const double dx = (mean - square[0]).hi / mean.hi;
  const double dy = (mean - square[1]).hi / mean.hi;
  const double dz = -dx - dy;
  const double e2 = dx * dy - dz * dz;
  const double e3 = dx * dy * dz;
  const double series =
      -e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 - 5 * e2 * e2 * e2 / 208 + 3 * e3 * e3 / 104;
  return (Dd(1.0) + series) / sqrt(mean);
}

// The axes of section 1, and what cancels near equal moments or the separatrix, from the given numbers exactly.
struct Axes {
  std::size_t a = 0, b = 0, c = 0;  // circled, middle, other
  Dd gap_a, gap_b, gap_c;           // |I_b - I_a|, |I_c - I_a|, |I_c - I_b|
  Dd excess;                        // sqrt(G_a L_a^2 - G_c L_c^2)
  bool steady = false;              // L x omega is zero, or so small that it underflows
};

Axes axes_of(const ExactVector& I, const ExactVector& L_B) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&I](auto i, auto j) { return (I[i] - I[j]).rounded().hi < 0; });
  Axes axes;
  auto& [a, b, c, gap_a, gap_b, gap_c, excess, steady] = axes;
  a = order[0];
  b = order[1];
  c = order[2];
  const Expansion b_less_a = I[b] - I[a];
  const Expansion c_less_b = I[c] - I[b];
  gap_a = b_less_a.rounded();
  gap_b = (I[c] - I[a]).rounded();
  gap_c = c_less_b.rounded();
  const Dd L_a = abs(L_B[a].rounded());
  const Dd L_b = abs(L_B[b].rounded());
  const Dd L_c = abs(L_B[c].rounded());
  const Dd X_a = sqrt(gap_a * I[c].rounded()) * L_a;
  const Dd X_c = sqrt(gap_c * I[a].rounded()) * L_c;
  const auto coupled = [](Dd L_i, Dd L_j, Dd gap) { return L_i.hi != 0 && L_j.hi != 0 && gap.hi != 0; };
  steady = (X_a.hi == 0 && X_c.hi == 0) ||
           !(coupled(L_a, L_b, gap_a) || coupled(L_b, L_c, gap_c) || coupled(L_a, L_c, gap_b));

  Dd difference = X_a - X_c;
  if (std::abs(difference.hi) > 1e-6 * X_a.hi) {
    excess = sqrt(abs(difference)) * sqrt(X_a + X_c);
  } else {  // near the separatrix; L_a and L_c, which may be 1e-300, are brought near 1
    const int exponent = std::max(-1000, exponent_of({L_a.hi, L_c.hi, 0}));
    const double scale = std::ldexp(1.0, -exponent);
    const Expansion l_a = L_B[a] * scale;
    const Expansion l_c = L_B[c] * scale;
    difference = (b_less_a * I[c] * (l_a * l_a) - c_less_b * I[a] * (l_c * l_c)).rounded();
    excess = sqrt(abs(difference)) * std::ldexp(1.0, exponent);
  }
  if (difference.hi < 0) {
    std::swap(a, c);
    std::swap(gap_a, gap_c);
  }
  return axes;
}

// Of the largest component of L_B. What is smaller counts as zero: products of it would leave the range of double.
constexpr double negligible_kick = 1e-265;

}  // namespace

// What was given, over powers of two: every digit stays, and squares and products stay inside the range of double.
struct TorqueFree::Start {
  DdVector I, L_B;
  Dd L, twice_energy;
  Axes axes;
  DdQuaternion q_WB0;  // of any length
  int L_exponent;      // L is in units of 2^L_exponent
  int rate_exponent;   // L / I is in units of 2^rate_exponent

  Start(const ExactVector& exact_I, ExactVector exact_L_B, const DdQuaternion& q, int L_unit, int rate_unit)
      : q_WB0(q), L_exponent(L_unit), rate_exponent(rate_unit) {
    const auto size_of = [](const Expansion& x) { return std::abs(x.rounded().hi); };
    const double largest = std::max({size_of(exact_L_B[0]), size_of(exact_L_B[1]), size_of(exact_L_B[2])});
    for (Expansion& kick : exact_L_B) {
      if (size_of(kick) < negligible_kick * largest) kick = Expansion();
    }
    axes = axes_of(exact_I, exact_L_B);
    for (std::size_t i = 0; i < 3; ++i) {
      I[i] = exact_I[i].rounded();
      L_B[i] = exact_L_B[i].rounded();
      twice_energy = twice_energy + L_B[i] * L_B[i] / I[i];
    }
    L = hypot(hypot(abs(L_B[0]), abs(L_B[1])), abs(L_B[2]));
  }

  static Start of_body(const Vector3d& I_B, const Quaterniond& q_WB0, const Vector3d& L_W) {
    const int I_exponent = exponent_of(I_B);
    const int L_exponent = exponent_of(L_W);
    const Vector3d I = divided_by_power_of_2(I_B, I_exponent);
    const Vector3d L = divided_by_power_of_2(L_W, L_exponent);
    // L_B = q^-1 L_W q / |q|^2, to 31 digits; exactly where q_WB0 = 1.
    const DdQuaternion q{q_WB0.w(), q_WB0.x(), q_WB0.y(), q_WB0.z()};
    const DdQuaternion L_B = product(product({q[0], -q[1], -q[2], -q[3]}, {0.0, L.x(), L.y(), L.z()}), q);
    const Dd norm = squared_norm(q);
    return {{I.x(), I.y(), I.z()},
            {Expansion(L_B[1] / norm), Expansion(L_B[2] / norm), Expansion(L_B[3] / norm)},
            q,
            L_exponent,
            L_exponent - I_exponent};
  }

  static Start of_book(const Vector3d& size, const Vector3d& omega_W) {
    const int size_exponent = exponent_of(size);
    const int rate_exponent = exponent_of(omega_W);
    const Vector3d edge = divided_by_power_of_2(size, size_exponent);
    const Vector3d omega = divided_by_power_of_2(omega_W, rate_exponent);
    ExactVector half_I, half_L;
    for (int i = 0; i < 3; ++i) {
      const double b = edge[(i + 1) % 3];
      const double c = edge[(i + 2) % 3];
      const auto axis = static_cast<std::size_t>(i);
      half_I[axis] = Expansion(two_product(b, b)) + Expansion(two_product(c, c));
      half_L[axis] = half_I[axis] * omega[i];
    }
    return {half_I, half_L, {1.0, 0.0, 0.0, 0.0}, rate_exponent + 2 * size_exponent + 1, rate_exponent};
  }
};

TorqueFree::TorqueFree(const Vector3d& I_B, const Quaterniond& q_WB0, const Vector3d& L_W)
    : TorqueFree([&] {
        if (!I_B.allFinite() || !(I_B.array() > 0).all()) refuse("principal moments must be positive and finite");
        const double q_max = q_WB0.coeffs().cwiseAbs().maxCoeff();
        if (!q_WB0.coeffs().allFinite() || !(q_max > 1e-140 && q_max < 1e140)) {
          refuse("the initial orientation is not a rotation");
        }
        if (!L_W.allFinite()) refuse("the angular momentum must be finite");
        return Start::of_body(I_B, q_WB0, L_W);
      }()) {}

TorqueFree TorqueFree::of_book(const Vector3d& size, const Vector3d& omega_W) {
  const auto flat = (size.array() == 0).count();
  if (!size.allFinite() || size.minCoeff() < 0 || flat > 1)
    refuse("the edges must be positive and finite; one may be 0");
  if (!omega_W.allFinite()) refuse("the angular velocity must be finite");
  return TorqueFree(Start::of_book(size, omega_W));
}

TorqueFree::TorqueFree(const Start& start)
    : steady_(start.axes.steady),
      time_scale_(std::ldexp(1.0, start.rate_exponent)),
      L_(std::ldexp(start.L.hi, start.L_exponent)) {
  if (!std::isfinite(L_)) refuse("|L| overflows");
  frames_.fill(Eigen::Vector4d::Zero());
  if (steady_) {
    rotate_steadily(start);
  } else {
    tumble(start);
  }
  if (!std::isfinite(time_scale_)) refuse("|L| / I overflows");
  if (!std::isfinite(turn_rate_.hi) || !std::isfinite(theta_.frequency.hi) || !std::isfinite(phase0_.hi) ||
      !frames_[0].allFinite()) {
    refuse("the moments, or the components of L, are too many orders of magnitude apart");
  }
}

// q = q_WB0 (cos, sin l), l the direction of L_B, of half the angle turned.
void TorqueFree::rotate_steadily(const Start& start) {
  const Quaterniond q = normalized(start.q_WB0);
  frames_[0] = q.coeffs();
  if (!(start.L.hi > 0)) return;
  turn_rate_ = start.twice_energy / (start.L * dd_pi);
  const auto& [x, y, z] = start.L_B;
  frames_[3] = normalized(product(start.q_WB0, {0.0, x, y, z})).coeffs();
  amplitude_ = {(x / start.L).hi, (y / start.L).hi, (z / start.L).hi};
}

void TorqueFree::tumble(const Start& start) {
  const auto& [I, L_B, L, twice_energy, axes, q_WB0, L_exponent, rate_exponent] = start;
  const auto [a, b, c, gap_a, gap_b, gap_c, excess, steady] = axes;

  // Amplitudes, moduli and rates: section 1.
  const Dd G_a = gap_a * I[c];
  const Dd G_b = gap_b * I[b];
  const Dd G_c = gap_c * I[a];
  const Dd A_a = hypot(abs(L_B[a]), sqrt(G_c / G_b) * abs(L_B[b]));
  const Dd A_c = hypot(abs(L_B[c]), sqrt(G_a / G_b) * abs(L_B[b]));
  const Dd A_b = sqrt(G_b / G_a) * A_c;
  EllipticMotion motion;
  motion.k_prime = excess / (sqrt(G_a) * A_a);
  motion.k = sqrt(G_c / G_a) * A_c / A_a;
  motion.lambda = A_a * sqrt(gap_a / I[b] / I[a]) * sqrt(gap_b / I[c] / I[a]);
  motion.tangent = A_c / (L + A_a);
  motion.rate_at_zero = (twice_energy + A_a * L / I[a]) / ((L + A_a) * 2.0);
  motion.s = I[a] < I[c] ? 1.0 : -1.0;
  theta_ = theta_form(motion);
  turn_rate_ = theta_.mu * 2.0 / dd_pi;
  amplitude_ = {(A_b / L * theta_.sn_scale).hi * motion.s, (A_c / L * theta_.cn_scale).hi,
                (A_a / L * theta_.dn_scale).hi};

  // The axes 1, 2, 3: right-handed, L_3 > 0, L_2(0) >= 0: section 2.
  axis_ = {static_cast<int>(b), static_cast<int>(c), static_cast<int>(a)};
  std::array<double, 3> sign{0, L_B[c].hi < 0 ? -1.0 : 1.0, L_B[a].hi < 0 ? -1.0 : 1.0};
  sign[0] = sign[1] * sign[2] * ((b + 1) % 3 == c ? 1 : -1);
  L_axis_ = {sign[0] * L_, sign[1] * L_, sign[2] * L_};
  const Dd L1 = L_B[b] * sign[0];
  const Dd L2 = L_B[c] * sign[1];
  const Dd L3 = L_B[a] * sign[2];
  const Dd u0 = L1 / A_b * motion.s * carlson_rf(L2 / A_c, L3 / A_a, 1.0);
  phase0_ = u0 * theta_.frequency / motion.lambda;

  // The frame of L, seen from the body at t = 0: the inverse of what alpha and beta give there.
  const ThetaValues<Dd> theta =
      theta_.hyperbolic ? theta_at<Dd, true>(theta_, phase0_) : theta_at<Dd, false>(theta_, phase0_);
  const auto [sine, cosine] = sincos_of_quarters<Dd>(theta.quarters);
  const DdQuaternion g = cayley_klein(theta.alpha_re * cosine - theta.alpha_im * sine,
                                      theta.alpha_im * cosine + theta.alpha_re * sine, L1, L2, L + L3);
  DdQuaternion q_BL{g[0], 0.0, 0.0, 0.0};
  for (std::size_t i = 0; i < 3; ++i) q_BL[static_cast<std::size_t>(axis_[i]) + 1] = -(g[i + 1] * sign[i]);
  const Quaterniond q_WL = normalized(product(q_WB0, q_BL));
  frames_[0] = q_WL.coeffs();
  for (std::size_t i = 0; i < 3; ++i) {  // the same four numbers in another order and sign
    Quaterniond unit(0, 0, 0, 0);
    unit.vec()[axis_[i]] = sign[i];
    frames_[i + 1] = (q_WL * unit).coeffs();
  }
}

// The state at one time, as numbers: without branches, so that wide instructions can take a loop of it.
struct TorqueFree::Sample {
  std::array<double, 4> q_WB;  // w, x, y, z
  double L_1, L_2, L_3;
};

template <bool hyperbolic>
[[gnu::always_inline]] inline TorqueFree::Sample TorqueFree::tumbled(double t) const {
  const double time = t * time_scale_;
  Dd quarters = two_product(turn_rate_.hi, time);
  quarters.lo += turn_rate_.lo * time;
  const Dd advance = two_product(theta_.frequency.hi, time);
  Dd phase = two_sum(advance.hi, phase0_.hi);
  phase.lo += advance.lo + theta_.frequency.lo * time + phase0_.lo;
  const ThetaValues<double> theta = theta_at<double, hyperbolic>(theta_, phase);
  const double l1 = amplitude_[0] * theta.sn;
  const double l2 = amplitude_[1] * theta.cn;
  const double l3 = amplitude_[2] * theta.dn;

  quarters.lo += theta.quarters;
  const auto [sine, cosine] = sincos_of_quarters<double>(quarters);
  const double square = theta.alpha_re * theta.alpha_re + theta.alpha_im * theta.alpha_im;
  const double up = 1 + l3;
  const double length = 1 / std::sqrt(square * (up * up + l1 * l1 + l2 * l2));
  const std::array<double, 4> g = cayley_klein((cosine * theta.alpha_re - sine * theta.alpha_im) * length,
                                               (cosine * theta.alpha_im + sine * theta.alpha_re) * length, l1, l2, up);
  const auto turned = [&](int i) {  // w, x, y, z; frames_ hold x, y, z, w
    const int at = (i + 3) % 4;
    return (frames_[0][at] * g[0] + frames_[1][at] * g[1]) + (frames_[2][at] * g[2] + frames_[3][at] * g[3]);
  };
  return {{turned(0), turned(1), turned(2), turned(3)}, L_axis_[0] * l1, L_axis_[1] * l2, L_axis_[2] * l3};
}

RigidState TorqueFree::state_of(const Sample& s) const {
  RigidState state{{s.q_WB[0], s.q_WB[1], s.q_WB[2], s.q_WB[3]}, {}};
  state.L_B[axis_[0]] = s.L_1;
  state.L_B[axis_[1]] = s.L_2;
  state.L_B[axis_[2]] = s.L_3;
  return state;
}

RigidState TorqueFree::at(double t) const {
  if (!steady_) return state_of(theta_.hyperbolic ? tumbled<true>(t) : tumbled<false>(t));
  const double time = t * time_scale_;
  Dd quarters = two_product(turn_rate_.hi, time);
  quarters.lo += turn_rate_.lo * time;
  const auto [sine, cosine] = sincos_of_quarters<double>(quarters);
  return {Quaterniond((frames_[0] * cosine + frames_[1] * 0) + (frames_[2] * 0 + frames_[3] * sine)), amplitude_ * L_};
}

void TorqueFree::at(std::size_t count, const double* t, RigidState* states) const {
  constexpr std::size_t lanes = 8;
  const auto together = [&, self = *this]<bool hyperbolic>(std::bool_constant<hyperbolic>) {
    std::array<std::array<double, lanes>, 7> x;  // component by component
    for (std::size_t i = 0; i < lanes; ++i) {
      const Sample s = self.template tumbled<hyperbolic>(t[i]);
      x[0][i] = s.q_WB[0];
      x[1][i] = s.q_WB[1];
      x[2][i] = s.q_WB[2];
      x[3][i] = s.q_WB[3];
      x[4][i] = s.L_1;
      x[5][i] = s.L_2;
      x[6][i] = s.L_3;
    }
    for (std::size_t i = 0; i < lanes; ++i)
      states[i] = self.state_of({{x[0][i], x[1][i], x[2][i], x[3][i]}, x[4][i], x[5][i], x[6][i]});
  };
  for (; !steady_ && count >= lanes; count -= lanes, t += lanes, states += lanes) {
    if (theta_.hyperbolic) {
      together(std::true_type());
    } else {
      together(std::false_type());
    }
  }
  std::transform(t, t + count, states, [this](double time) { return at(time); });
}

double TorqueFree::flip_period() const {
  if (steady_ || theta_.reduce == 0) return std::numeric_limits<double>::infinity();
  return 1 / theta_.frequency.hi / time_scale_;
}

double TorqueFree::first_flip() const {
  if (steady_ || (theta_.reduce == 0 && phase0_.hi > 0)) return std::numeric_limits<double>::infinity();
  if (phase0_.hi == 0) return 0;
  const Dd flips = phase0_.hi > 0 ? Dd(1.0) - phase0_ : -phase0_;
  return (flips / theta_.frequency).hi / time_scale_;
}

double intermediate_axis_growth_rate(const Vector3d& I_B, double L) {
  Vector3d I = I_B;
  std::sort(I.begin(), I.end());
  return L / I[1] * std::sqrt((I[1] / I[0] - 1) * (1 - I[1] / I[2]));
}

}  // namespace bookspin
