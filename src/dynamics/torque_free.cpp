#include "dynamics/torque_free.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace bookspin {
namespace {

using QuaternionL = Eigen::Quaternion<long double>;
using Matrix3L = Eigen::Matrix<long double, 3, 3>;
using Vector3L = Eigen::Matrix<long double, 3, 1>;
using DdVector = std::array<Dd, 3>;

int binary_exponent(double largest) {
  int exponent = 0;
  std::frexp(largest, &exponent);
  return exponent;
}

// L_B = R_WB^T L_W with q_WB not yet normalised: q^-1 L q / |q|^2, exact to 31 digits.
DdVector to_body(const Eigen::Quaterniond& q, const Eigen::Vector3d& L_W) {
  const Dd w = q.w();
  const DdVector v{-Dd(q.x()), -Dd(q.y()), -Dd(q.z())};
  const DdVector L{L_W.x(), L_W.y(), L_W.z()};
  const auto cross = [](const DdVector& r, const DdVector& s) {
    return DdVector{r[1] * s[2] - r[2] * s[1], r[2] * s[0] - r[0] * s[2], r[0] * s[1] - r[1] * s[0]};
  };
  const Dd square = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const Dd along = v[0] * L[0] + v[1] * L[1] + v[2] * L[2];
  const DdVector turned = cross(v, L);
  const Dd norm = w * w + square;
  DdVector body;
  for (std::size_t i = 0; i < 3; ++i) {
    body[i] = ((w * w - square) * L[i] + (w * turned[i] + along * v[i]) * 2.0) / norm;
  }
  return body;
}

// (w, z, x, y) of g -> (x, y, z, w), Eigen's order, of left * g * right^-1.
Eigen::Matrix4d frames(const QuaternionL& left, const QuaternionL& right) {
  const std::array<QuaternionL, 4> basis{QuaternionL(1, 0, 0, 0), QuaternionL(0, 0, 0, 1), QuaternionL(0, 1, 0, 0),
                                         QuaternionL(0, 0, 1, 0)};
  Eigen::Matrix4d matrix;
  for (int column = 0; column < 4; ++column) {
    const QuaternionL q = left * basis[static_cast<std::size_t>(column)] * right.conjugate();
    matrix.col(column) = q.coeffs().cast<double>();
  }
  return matrix;
}

// x to the nearest integer, plus a constant that brings the integer's last bit to the last bit of the sum; |x| < 2^51.
constexpr double to_integer = 0x1.8p52;

// Carlson's R_F by duplication (DLMF 19.36.1); the arguments may be as small as the squares of 1e-170.
long double carlson_rf(long double x, long double y, long double z) {
  for (;;) {
    const long double mean = (x + y + z) / 3;
    const long double dx = 1 - x / mean;
    const long double dy = 1 - y / mean;
    const long double dz = -dx - dy;
    if (std::max({std::fabs(dx), std::fabs(dy), std::fabs(dz)}) < 2e-3L) {
      const long double e2 = dx * dy - dz * dz;
      const long double e3 = dx * dy * dz;
      const long double series = 1 - e2 / 10 + e3 / 14 + e2 * e2 / 24 - 3 * e2 * e3 / 44 - 5 * e2 * e2 * e2 / 208 +
                                 3 * e3 * e3 / 104 + e2 * e2 * e3 / 16;
      return series / std::sqrt(mean);
    }
    const long double rx = std::sqrt(x);
    const long double ry = std::sqrt(y);
    const long double rz = std::sqrt(z);
    const long double shift = rx * (ry + rz) + ry * rz;
    x = (x + shift) / 4;
    y = (y + shift) / 4;
    z = (z + shift) / 4;
  }
}

void check(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W) {
  if (!I_B.allFinite() || !(I_B.array() > 0).all()) {
    throw std::invalid_argument("torque-free motion: principal moments must be positive and finite");
  }
  const double q_max = q_WB0.coeffs().cwiseAbs().maxCoeff();
  if (!q_WB0.coeffs().allFinite() || !(q_max > 1e-140 && q_max < 1e140)) {
    throw std::invalid_argument("torque-free motion: the initial orientation is not a rotation");
  }
  if (!L_W.allFinite()) throw std::invalid_argument("torque-free motion: the angular momentum must be finite");
}

}  // namespace

TorqueFree::TorqueFree(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W) {
  check(I_B, q_WB0, L_W);
  const double L_max = L_W.cwiseAbs().maxCoeff();
  const QuaternionL q0 = q_WB0.cast<long double>().normalized();
  if (L_max == 0) {
    frames_ = frames(q0, QuaternionL::Identity());
    return;
  }

  // Powers of two leave every digit alone and keep squares and products inside the range of double.
  const int I_exponent = binary_exponent(I_B.maxCoeff());
  const int L_exponent = binary_exponent(L_max);
  time_scale_ = std::ldexp(1.0, L_exponent - I_exponent);
  if (!std::isfinite(time_scale_)) throw std::invalid_argument("torque-free motion: |L| / I overflows");
  DdVector I;
  for (std::size_t i = 0; i < 3; ++i) I[i] = std::ldexp(I_B[static_cast<int>(i)], -I_exponent);
  const DdVector L_B = to_body(q_WB0, L_W.unaryExpr([&](double x) { return std::ldexp(x, -L_exponent); }));
  const Dd L = hypot(hypot(abs(L_B[0]), abs(L_B[1])), abs(L_B[2]));
  const Dd twice_energy = L_B[0] * L_B[0] / I[0] + L_B[1] * L_B[1] / I[1] + L_B[2] * L_B[2] / I[2];
  L_ = std::ldexp(L.hi, L_exponent);
  Vector3L direction;
  for (int i = 0; i < 3; ++i) direction[i] = (L_B[static_cast<std::size_t>(i)] / L).wide();

  // b: the middle moment; a: the circled axis; c: the other.
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) { return I[i] < I[j]; });
  auto [a, b, c] = order;
  const auto weight = [&, b = b](std::size_t outer, std::size_t other) { return abs(I[b] - I[outer]) * I[other]; };
  if (sqrt(weight(a, c)) * abs(L_B[a]) < sqrt(weight(c, a)) * abs(L_B[c])) std::swap(a, c);
  const Dd G_a = weight(a, c);
  const Dd G_c = weight(c, a);
  const Dd X_a = sqrt(G_a) * abs(L_B[a]);
  const Dd X_c = sqrt(G_c) * abs(L_B[c]);

  // Steady when L x omega is zero, or so small that it underflows (X_a = 0).
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    if (X_a.hi > 0 && L_B[i].hi != 0 && L_B[j].hi != 0 && (I[i] - I[j]).hi != 0) steady_ = false;
  }
  if (steady_) {
    turn_rate_ = twice_energy / (L * dd_pi * 4.0);
    amplitude_ = direction.cast<double>();
    const QuaternionL q_BC = QuaternionL::FromTwoVectors(Vector3L::UnitZ(), direction);
    frames_ = frames(q0 * q_BC, q_BC);
    return;
  }

  // The formulas of torque_free.h, part 1.
  const Dd G_b = abs(I[c] - I[a]) * I[b];
  const Dd A_a = hypot(abs(L_B[a]), sqrt(G_c / G_b) * abs(L_B[b]));
  const Dd A_c = hypot(abs(L_B[c]), sqrt(G_a / G_b) * abs(L_B[b]));
  const Dd A_b = sqrt(G_b / G_a) * A_c;

  EllipticMotion motion;
  const Dd gap = X_a - X_c;
  if (gap.hi > 0x1p-96 * X_a.hi) motion.k_prime = sqrt(gap) * sqrt(X_a + X_c) / (sqrt(G_a) * A_a);
  motion.k = sqrt(G_c / G_a) * A_c / A_a;
  motion.lambda = A_a * sqrt(abs(I[b] - I[a]) / I[b] / I[a]) * sqrt(abs(I[c] - I[a]) / I[c] / I[a]);
  motion.tangent = A_c / (L + A_a);
  motion.rate_at_zero = (twice_energy + A_a * L / I[a]) / ((L + A_a) * 2.0);
  motion.s = I[a] < I[c] ? 1.0 : -1.0;
  theta_ = theta_form(motion);
  turn_rate_ = theta_.mu / (dd_pi * 2.0);
  if (!std::isfinite(turn_rate_.hi) || !std::isfinite(theta_.frequency.hi)) {
    throw std::invalid_argument("torque-free motion: |L| / I overflows");
  }
  amplitude_ = Eigen::Vector3d((A_b / L).hi * motion.s, (A_c / L).hi, (A_a / L).hi);

  // The frame 1, 2, 3: right-handed, L_3 > 0, L_2(0) >= 0.
  axis_ = {static_cast<int>(b), static_cast<int>(c), static_cast<int>(a)};
  Eigen::Vector3d axis_sign(0, L_B[c].hi < 0 ? -1 : 1, L_B[a].hi < 0 ? -1 : 1);
  axis_sign[0] = axis_sign[1] * axis_sign[2] * ((b + 1) % 3 == c ? 1 : -1);
  L_axis_ = axis_sign * L_;
  Matrix3L R_BC = Matrix3L::Zero();
  for (int i = 0; i < 3; ++i) R_BC(axis_[static_cast<std::size_t>(i)], i) = axis_sign[i];
  const Vector3L l = R_BC.transpose() * direction;

  const long double sn = l[0] * motion.s * (L / A_b).wide();
  const long double cn = l[1] * (L / A_c).wide();
  const long double dn = l[2] * (L / A_a).wide();
  const long double phase0 = sn * carlson_rf(cn * cn, dn * dn, 1.0L) * (theta_.frequency / motion.lambda).wide();
  phase0_ = quick_two_sum(static_cast<double>(phase0), static_cast<double>(phase0 - static_cast<double>(phase0)));
  const long double x0 = phase0 * theta_.period;

  // What the frame of 1, 2, 3 is turned by at t = 0, relative to the frame of L.
  const ThetaValues<long double> theta = theta_values(theta_, x0);
  const long double turn = -static_cast<long double>(theta_.kappa) * x0;
  const QuaternionL about_L = QuaternionL(theta.alpha_re, 0, 0, theta.alpha_im).normalized() *
                              QuaternionL(std::cos(turn), 0, 0, std::sin(turn));
  const QuaternionL tilt = QuaternionL(1 + l[2], l[1], -l[0], 0).normalized();
  const QuaternionL q_BC(R_BC);
  frames_ = frames(q0 * q_BC * (about_L * tilt).conjugate(), q_BC);
}

RigidState TorqueFree::at(double t) const {
  const double time = t * time_scale_;
  const Dd turns = two_product(turn_rate_.hi, time);
  const double fraction = turns.hi - ((turns.hi + to_integer) - to_integer);
  double angle = 2 * std::numbers::pi * (fraction + (turns.lo + turn_rate_.lo * time));
  RigidState state;
  if (steady_) {
    state.q_WB.coeffs().noalias() = frames_.leftCols<2>() * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    state.L_B = amplitude_ * L_;
    return state;
  }

  // Periods since u = 0, and x or X within half a period of 0.
  const Dd advance = two_product(theta_.frequency.hi, time);
  const Dd phase = two_sum(advance.hi, phase0_.hi);
  const double shifted = phase.hi * theta_.reduce + to_integer;
  const double rest =
      (phase.hi - (shifted - to_integer)) + (phase.lo + (advance.lo + theta_.frequency.lo * time + phase0_.lo));
  const double x = rest * theta_.period;
  const double parity = std::bit_cast<std::uint64_t>(shifted) % 2 == 0 ? 1 : -1;

  const ThetaValues<double> theta = theta_values(theta_, x);
  const double l1 = amplitude_[0] * parity * theta.sn;
  const double l2 = amplitude_[1] * parity * theta.cn;
  const double l3 = amplitude_[2] * theta.dn;
  state.L_B[axis_[0]] = L_axis_[0] * l1;
  state.L_B[axis_[1]] = L_axis_[1] * l2;
  state.L_B[axis_[2]] = L_axis_[2] * l3;

  // (alpha, beta) = exp(i angle) alpha (1 + l3, l2 - i l1), of length 1.
  angle -= theta_.kappa * x;
  const double square = theta.alpha_re * theta.alpha_re + theta.alpha_im * theta.alpha_im;
  const double length = 1 / std::sqrt(square * ((1 + l3) * (1 + l3) + l1 * l1 + l2 * l2));
  const double cosine = std::cos(angle) * length;
  const double sine = std::sin(angle) * length;
  const double re = cosine * theta.alpha_re - sine * theta.alpha_im;
  const double im = cosine * theta.alpha_im + sine * theta.alpha_re;
  state.q_WB.coeffs().noalias() =
      frames_ * Eigen::Vector4d((1 + l3) * re, (1 + l3) * im, re * l2 + im * l1, im * l2 - re * l1);
  return state;
}

double TorqueFree::flip_period() const {
  if (steady_ || theta_.reduce == 0) return std::numeric_limits<double>::infinity();
  return 1 / theta_.frequency.hi / time_scale_;
}

double TorqueFree::first_flip() const {
  if (steady_ || (theta_.reduce == 0 && phase0_.hi > 0)) return std::numeric_limits<double>::infinity();
  const Dd periods = phase0_.hi > 0 ? Dd(1.0) - phase0_ : -phase0_;
  return (periods / theta_.frequency).hi / time_scale_;
}

double intermediate_axis_growth_rate(const Eigen::Vector3d& I_B, double L) {
  Eigen::Vector3d I = I_B;
  std::sort(I.begin(), I.end());
  return L / I[1] * std::sqrt((I[1] / I[0] - 1) * (1 - I[1] / I[2]));
}

}  // namespace bookspin
