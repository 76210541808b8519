#include "dynamics/rigid_steps.h"

#include <cmath>
#include <limits>

#include "dynamics/composition.h"

namespace bookspin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Turns the body by F in its own axes; F a unit quaternion.
void turn(RigidState& state, const Eigen::Quaterniond& F) {
  state.q_WB = state.q_WB * F;
  const Eigen::Vector3d t = 2.0 * F.vec().cross(state.L_B);
  state.L_B += F.vec().cross(t) - F.w() * t;
}

Eigen::Quaterniond rotation(const Eigen::Vector3d& angle) {
  const double size = angle.norm();
  Eigen::Quaterniond F;
  F.w() = std::cos(0.5 * size);
  F.vec() = (size > 0.0 ? std::sin(0.5 * size) / size : 0.5) * angle;
  return F;
}

Eigen::Quaterniond rotation_about(int axis, double angle) {
  Eigen::Quaterniond F(std::cos(0.5 * angle), 0.0, 0.0, 0.0);
  F.vec()(axis) = std::sin(0.5 * angle);
  return F;
}

using Rates = Eigen::Matrix<double, 7, 1>;  // of q (x, y, z, w) and L_B

Rates rates(const Rates& at, const Eigen::Vector3d& I_B) {
  const Eigen::Vector3d L_B = at.tail<3>();
  const Eigen::Vector3d omega_B = L_B.cwiseQuotient(I_B);
  const Eigen::Quaterniond q(at(3), at(0), at(1), at(2));
  Rates d;
  d.head<4>() = 0.5 * (q * Eigen::Quaterniond(0.0, omega_B.x(), omega_B.y(), omega_B.z())).coeffs();
  d.tail<3>() = L_B.cross(omega_B);
  return d;
}

}  // namespace

void rk4_step(RigidState& state, const Eigen::Vector3d& I_B, double h) {
  Rates s;
  s << state.q_WB.coeffs(), state.L_B;
  const Rates k1 = rates(s, I_B);
  const Rates k2 = rates(s + 0.5 * h * k1, I_B);
  const Rates k3 = rates(s + 0.5 * h * k2, I_B);
  const Rates k4 = rates(s + h * k3, I_B);
  s += (h / 6.0) * (k1 + 2.0 * (k2 + k3) + k4);
  state.q_WB.coeffs() = s.head<4>();
  state.L_B = s.tail<3>();
}

// H = top + kick: the top has the moment of axis i about axis j too; the kick is what that leaves out,
// (1/I_j - 1/I_i) L_j^2 / 2. The two axes with the nearest 1/I make the kick smallest: of the six choices never the
// worst, within 2.5 times the best error where the worst is 40 times (measured on the book and a less regular body).
// Rotating about the three axes in turn is no better.
void splitting2_step(RigidState& state, const Eigen::Vector3d& I_B, double h) {
  const Eigen::Vector3d a = I_B.cwiseInverse();
  int symmetry = 0;
  for (int d = 1; d < 3; ++d) {
    if (std::abs(a((d + 1) % 3) - a((d + 2) % 3)) < std::abs(a((symmetry + 1) % 3) - a((symmetry + 2) % 3)))
      symmetry = d;
  }
  const int i = (symmetry + 1) % 3;
  const int j = (symmetry + 2) % 3;
  const double kick = 0.5 * h * (a(j) - a(i));
  turn(state, rotation_about(j, kick * state.L_B(j)));
  state.q_WB = state.q_WB * rotation(h * a(i) * state.L_B);  // about L itself: L_B stays
  turn(state, rotation_about(symmetry, h * (a(symmetry) - a(i)) * state.L_B(symmetry)));
  turn(state, rotation_about(j, kick * state.L_B(j)));
}

void splitting4_step(RigidState& state, const Eigen::Vector3d& I_B, double h) {
  for (const double fraction : suzuki_order_4) splitting2_step(state, I_B, fraction * h);
}

// With F = (1, e) / sqrt(1 + e^2) the matrix equation reads, and cyclically,
//   e_1 I_1 + (I_3 - I_2) e_2 e_3 = (1 + e^2) h L_1 / 2.
// Newton's iteration from the second-order guess converges in 2 or 3 rounds; the solution that tends to 0 with h has
// |e| < 1.
void dmv_step(RigidState& state, const Eigen::Vector3d& I, double h) {
  const Eigen::Vector3d half = 0.5 * h * state.L_B;
  const Eigen::Vector3d omega = state.L_B.cwiseQuotient(I);
  Eigen::Vector3d e = (half + 0.5 * h * half.cross(omega)).cwiseQuotient(I);
  const Eigen::Vector3d gap(I.z() - I.y(), I.x() - I.z(), I.y() - I.x());
  bool solved = false;
  for (int round = 0; round < 20 && !solved && e.allFinite(); ++round) {
    const Eigen::Vector3d coupling(e.y() * e.z(), e.z() * e.x(), e.x() * e.y());
    const Eigen::Vector3d residual = e.cwiseProduct(I) + gap.cwiseProduct(coupling) - (1.0 + e.squaredNorm()) * half;
    Eigen::Matrix3d J;
    J << I.x(), gap.x() * e.z(), gap.x() * e.y(),  //
        gap.y() * e.z(), I.y(), gap.y() * e.x(),   //
        gap.z() * e.y(), gap.z() * e.x(), I.z();
    J -= 2.0 * half * e.transpose();
    const Eigen::Vector3d correction = J.inverse() * residual;
    e -= correction;
    solved = correction.squaredNorm() <= 1e-18 * e.squaredNorm();  // the error is now the square of the correction
  }
  if (!solved || !(e.squaredNorm() < 1.0)) {
    state = {Eigen::Quaterniond(nan, nan, nan, nan), Eigen::Vector3d::Constant(nan)};
    return;
  }
  const double w = 1.0 / std::sqrt(1.0 + e.squaredNorm());
  turn(state, Eigen::Quaterniond(w, w * e.x(), w * e.y(), w * e.z()));
}

// 1 / moment_j = s / I_j + d, with s = 1 + h^2 s3 + h^4 s5 + ..., d = h^2 d3 + h^4 d5 + ...; s_k and d_k are
// polynomials in H = sum L_j^2 / (2 I_j), C = sum L_j^2 / 2 and the elementary symmetric functions of the 1 / I_j.
// s3 and d3 are as Hairer & Vilmart print them; tools/dmv_moments.py derives all of them.
Eigen::Vector3d step_moments(Integrator integrator, const Eigen::Vector3d& I_B, const Eigen::Vector3d& L_B, double h) {
  if (integrator != Integrator::dmv6 && integrator != Integrator::dmv10) return I_B;
  const Eigen::Vector3d a = I_B.cwiseInverse();
  const double e1 = a.sum();
  const double e2 = a.x() * a.y() + a.y() * a.z() + a.z() * a.x();
  const double e3 = a.prod();
  const double C = 0.5 * h * h * L_B.squaredNorm();  // with the powers of h
  const double H = 0.5 * h * h * L_B.dot(L_B.cwiseProduct(a));
  // A thin rod: the terms cancel, only rounding is left.
  if (!(C * e2 + H * e1 < 100.0)) return Eigen::Vector3d::Constant(nan);
  double s = 1.0 + C * e2 / 6 - H * e1 / 3;
  double d = -C * e3 / 3 + H * e2 / 6;
  s += C * C * (e2 * e2 / 30 - e1 * e3 / 10) + H * C * (-e1 * e2 / 30 + e3 * 2 / 15) + H * H * (e1 * e1 / 30 - e2 / 60);
  d += -C * C * e2 * e3 / 60 + H * C * (-e2 * e2 / 60 + e1 * e3 * 2 / 15) - H * H * (e1 * e2 / 60 + e3 / 10);
  if (integrator == Integrator::dmv10) {
    s += C * C * C * (e2 * e2 * e2 * 17 / 2520 - e1 * e2 * e3 * 11 / 420 + e3 * e3 * 5 / 126) +
         H * C * C * (-e1 * e2 * e2 / 70 + e1 * e1 * e3 * 11 / 210 - e2 * e3 / 84) +
         H * H * C * (e1 * e1 * e2 / 420 + e2 * e2 * 41 / 2520 - e1 * e3 * 53 / 630) +
         H * H * H * (-e1 * e1 * e1 / 630 + e1 * e2 / 630 + e3 / 35);
    d += C * C * C * (-e2 * e2 * e3 * 19 / 2520 + e1 * e3 * e3 / 35) +
         H * C * C * (e2 * e2 * e2 / 1260 - e1 * e2 * e3 / 1260 - e3 * e3 * 22 / 315) +
         H * H * C * (e1 * e2 * e2 * 13 / 2520 - e1 * e1 * e3 * 8 / 315 + e2 * e3 * 11 / 252) +
         H * H * H * (e1 * e1 * e2 / 1260 - e2 * e2 * 13 / 1260 + e1 * e3 / 42);
    s += C * C * C * C *
             (e2 * e2 * e2 * e2 * 31 / 22680 - e1 * e2 * e2 * e3 * 19 / 2520 + e1 * e1 * e3 * e3 / 120 +
              e2 * e3 * e3 * 97 / 15120) +
         H * C * C * C *
             (-e1 * e2 * e2 * e2 * 11 / 3240 + e1 * e1 * e2 * e3 * 17 / 1260 + e2 * e2 * e3 * 47 / 7560 -
              e1 * e3 * e3 * 47 / 945) +
         H * H * C * C *
             (e1 * e1 * e2 * e2 * 13 / 3780 - e1 * e1 * e1 * e3 * 17 / 1260 + e2 * e2 * e2 / 2520 + e1 * e2 * e3 / 252 +
              e3 * e3 * 53 / 1260) +
         H * H * H * C *
             (-e1 * e1 * e1 * e2 / 11340 - e1 * e2 * e2 * 11 / 1890 + e1 * e1 * e3 * 23 / 945 - e2 * e3 * 23 / 1260) +
         H * H * H * H * (e1 * e1 * e1 * e1 / 22680 - e1 * e1 * e2 / 15120 + e2 * e2 * 17 / 5040 - e1 * e3 * 3 / 280);
    d += C * C * C * C * (-e2 * e2 * e2 * e3 * 61 / 45360 + e1 * e2 * e3 * e3 * 3 / 560 - e3 * e3 * e3 * 61 / 4536) +
         H * C * C * C *
             (-e2 * e2 * e2 * e2 / 45360 + e1 * e2 * e2 * e3 * 37 / 7560 - e1 * e1 * e3 * e3 * 2 / 105 +
              e2 * e3 * e3 * 19 / 1260) +
         H * H * C * C *
             (-e1 * e2 * e2 * e2 / 1512 + e1 * e1 * e2 * e3 * 19 / 7560 - e2 * e2 * e3 * 19 / 1080 +
              e1 * e3 * e3 * 89 / 1890) +
         H * H * H * C *
             (-e1 * e1 * e2 * e2 / 1512 + e1 * e1 * e1 * e3 * 8 / 2835 + e2 * e2 * e2 * 97 / 22680 -
              e1 * e2 * e3 * 23 / 1890 - e3 * e3 / 35) +
         H * H * H * H * (-e1 * e1 * e1 * e2 / 45360 - e1 * e2 * e2 / 7560 - e1 * e1 * e3 / 360 + e2 * e3 * 17 / 1680);
  }
  const Eigen::Array3d change = s + d * I_B.array();  // of 1 / moment
  if (!((change > 0.5).all() && (change < 1.5).all())) return Eigen::Vector3d::Constant(nan);
  return I_B.array() / change;
}

}  // namespace bookspin
