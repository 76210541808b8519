// Cost of the exact torque-free motion: an evaluation, the setup, and the same answer from Boost.Math's Jacobi
// functions and integral of the third kind, written straightforwardly (amplitudes and modulus from 2 E I - L^2). The
// number after the slash is the case of data/reference; the counter `error` is the textbook's largest geodesic
// angle from TorqueFree.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/ellint_3.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>
#include <cmath>
#include <cstdint>
#include <exception>

#include "dynamics/torque_free.h"

namespace bookspin {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Start {
  Vector3d I_B, L_B;
  double T;
};

// The cases of data/reference, in order.
Start start_of(std::int64_t index) {
  const Vector3d book(0x1.16b32d6ece140p+3, 0x1.e370ef5664909p+1, 0x1.7f8f694467382p+3);
  switch (index) {
    case 0:
      return {book, {1, 1e-3, 5e-4}, 600};
    case 1:
      return {book, {1, 1e-12, 5e-13}, 3000};
    case 2:
      return {{0x1.0a3d73fed5607p+0, 0x1.0a3d70a3d70a4p+0, 0x1.000001ad7f2b2p+1}, {1, 0.1, 0.05}, 600};
    default:
      return {book, {1000, 1, 0.5}, 600};
  }
}

// The textbook's way: Euler angles about L, the precession by an incomplete integral of the third kind (Landau &
// Lifshitz, Mechanics, section 37, axes ordered so that axis 3 is circled and I_1, I_2, I_3 = c, b, a).
class TextbookBody {
 public:
  TextbookBody(const Vector3d& I_B, const Vector3d& L_B) : L_(L_B.norm()) {
    const double energy2 = L_B.dot(L_B.cwiseQuotient(I_B));
    std::array<int, 3> order{0, 1, 2};
    std::sort(order.begin(), order.end(), [&](int i, int j) { return I_B[i] < I_B[j]; });
    if (L_ * L_ > energy2 * I_B[order[1]]) std::swap(order[0], order[2]);
    const auto [a, b, c] = order;  // a is circled
    for (int i = 0; i < 3; ++i) axes_.col(i).setZero();
    axes_(a, 2) = L_B[a] < 0 ? -1 : 1;
    axes_(b, 1) = 1;
    axes_.col(0) = axes_.col(1).cross(axes_.col(2));
    const Vector3d L = axes_.transpose() * L_B;
    const double I1 = I_B[c], I2 = I_B[b], I3 = I_B[a];
    A1_ = std::sqrt(I1 * (energy2 * I3 - L_ * L_) / (I3 - I1));
    A2_ = std::sqrt(I2 * (energy2 * I3 - L_ * L_) / (I3 - I2));
    A3_ = std::sqrt(I3 * (L_ * L_ - energy2 * I1) / (I3 - I1));
    k_ = std::sqrt((I2 - I1) * (energy2 * I3 - L_ * L_) / ((I3 - I2) * (L_ * L_ - energy2 * I1)));
    rate_ = std::sqrt((I3 - I2) * (L_ * L_ - energy2 * I1) / (I1 * I2 * I3));
    // L_1 = sign A1 cn, L_2 = A2 sn, L_3 = A3 dn: dL_2/dt = L_3 L_1 (1/I_1 - 1/I_3) > 0 at u = 0 picks the sign.
    sign_ = I1 < I3 ? 1 : -1;
    const double amplitude = std::atan2(L[1] / A2_, sign_ * L[0] / A1_);
    u0_ = incomplete(amplitude);
    // d(angle about L)/dt = L (2E - L_3^2/I_3) / (L^2 - L_3^2) = L / I_3 + L (I_3 - I_1) / (I_1 I_3) / (1 - nu sn^2)
    steady_ = L_ / I3;
    factor_ = L_ * (I3 - I1) / (I1 * I3);
    nu_ = (A1_ * A1_ - A2_ * A2_) / (A1_ * A1_);
    complete_ = boost::math::ellint_3(k_, nu_);
    period_ = 2 * boost::math::ellint_1(k_);
    precession0_ = third(u0_);
    start_ = tilt(u0_).conjugate();
  }

  // Identity at t = 0 in axes that turn the body by R(0): compare q(t) q(0)^-1.
  [[nodiscard]] Quaterniond at(double t) const {
    const double u = u0_ + rate_ * t;
    const double angle = steady_ * t + factor_ / rate_ * (third(u) - precession0_);
    const Quaterniond about_L(std::cos(angle / 2), 0, 0, std::sin(angle / 2));
    return about_L * tilt(u);
  }
  [[nodiscard]] Quaterniond to_body_axes(const Quaterniond& q) const {
    const Quaterniond axes(axes_);
    return axes * start_ * q * axes.conjugate();
  }

 private:
  [[nodiscard]] double incomplete(double amplitude) const { return boost::math::ellint_1(k_, amplitude); }

  // Pi(nu; am u, k), continued over half periods.
  [[nodiscard]] double third(double u) const {
    const double half_turns = std::round(u / period_);
    double cn = 0;
    double dn = 0;
    const double sn = boost::math::jacobi_elliptic(k_, u - half_turns * period_, &cn, &dn);
    return 2 * half_turns * complete_ + boost::math::ellint_3(k_, nu_, std::atan2(sn, cn));
  }

  // The rotation that carries L_B to the third axis, with the node line as first axis.
  [[nodiscard]] Quaterniond tilt(double u) const {
    double cn = 0;
    double dn = 0;
    const double sn = boost::math::jacobi_elliptic(k_, u, &cn, &dn);
    const Vector3d l = Vector3d(sign_ * A1_ * cn, A2_ * sn, A3_ * dn) / L_;
    const Vector3d node = Vector3d(l[1], -l[0], 0).normalized();
    Eigen::Matrix3d R;
    R.row(0) = node;
    R.row(1) = l.cross(node);
    R.row(2) = l;
    return Quaterniond(R);
  }

  double L_;
  Eigen::Matrix3d axes_;  // canonical -> body
  double A1_ = 0, A2_ = 0, A3_ = 0, k_ = 0, rate_ = 0, sign_ = 1, u0_ = 0, steady_ = 0, factor_ = 0, nu_ = 0;
  double complete_ = 0, period_ = 0, precession0_ = 0;
  Quaterniond start_;
};

void evaluation(benchmark::State& state) {
  const Start start = start_of(state.range(0));
  const TorqueFree exact(start.I_B, Quaterniond::Identity(), start.L_B);
  int sample = 0;
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(exact.at(start.T * (1.0 / 1024) * (sample++ & 1023)));
  }
}
BENCHMARK(evaluation)->DenseRange(0, 3);

void evaluation_of_many(benchmark::State& state) {
  const Start start = start_of(state.range(0));
  const TorqueFree exact(start.I_B, Quaterniond::Identity(), start.L_B);
  std::array<double, 1024> t;
  std::array<RigidState, 1024> states;
  for (std::size_t i = 0; i < t.size(); ++i) t[i] = start.T * (1.0 / 1024) * static_cast<double>(i);
  while (state.KeepRunningBatch(t.size())) {
    exact.at(t.size(), t.data(), states.data());
    benchmark::DoNotOptimize(states);
  }
}
BENCHMARK(evaluation_of_many)->DenseRange(0, 3);

void setup(benchmark::State& state) {
  const Start start = start_of(state.range(0));
  while (state.KeepRunning()) benchmark::DoNotOptimize(TorqueFree(start.I_B, Quaterniond::Identity(), start.L_B));
}
BENCHMARK(setup)->DenseRange(0, 3);

void boost_evaluation(benchmark::State& state) {
  const Start start = start_of(state.range(0));
  try {
    const TextbookBody textbook(start.I_B, start.L_B);
    const TorqueFree exact(start.I_B, Quaterniond::Identity(), start.L_B);
    double error = 0;
    for (int sample = 0; sample <= 60; ++sample) {
      const double t = start.T * sample / 60;
      error = std::max(error, exact.at(t).q_WB.angularDistance(textbook.to_body_axes(textbook.at(t))));
    }
    int sample = 0;
    while (state.KeepRunning()) benchmark::DoNotOptimize(textbook.at(start.T * (1.0 / 1024) * (sample++ & 1023)));
    state.counters["error"] = error;
  } catch (const std::exception& problem) {
    state.SkipWithError(problem.what());
  }
}
BENCHMARK(boost_evaluation)->DenseRange(0, 3);

}  // namespace
}  // namespace bookspin

BENCHMARK_MAIN();
