// Ten thousand random bodies against Boost.Odeint's Fehlberg 7(8) in long double, which knows nothing of elliptic
// functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/numeric/odeint.hpp>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "dynamics/torque_free.h"
#include "dynamics/torque_free_taylor.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using State = std::vector<long double>;  // q_WB (w, x, y, z), L_B

TEST(TorqueFreeRandom, TenThousandBodiesAgreeWithAnIntegrator) {
  namespace odeint = boost::numeric::odeint;
  std::mt19937_64 random(2012);
  // Its own mapping to a double: distributions differ between standard libraries.
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  double worst_angle = 0;
  double worst_L = 0;
  double worst_to_reference = 0;  // the same body against 50 digits: the rest is the integrator's
  Eigen::Vector3d worst_I = Eigen::Vector3d::Zero();
  for (int body = 0; body < 10000; ++body) {
    Eigen::Vector3d I;
    for (int i = 0; i < 3; ++i) I[i] = std::exp(uniform(-1.5, 1.5));
    if (body % 4 == 1) I[body % 3] = I[(body + 1) % 3] * (1 + std::exp(uniform(-30, -3)));  // nearly symmetric
    const Eigen::Quaterniond q0 =
        Eigen::Quaterniond(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized();
    Eigen::Vector3d L_B(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
    if (body % 4 == 2)
      L_B = Eigen::Vector3d::Unit(body % 3) + std::exp(uniform(-30, -3)) * L_B;  // nearly about an axis
    const Eigen::Vector3d L_W = q0 * L_B;
    const Eigen::Quaternion<long double> q = q0.cast<long double>().normalized();
    const Eigen::Matrix<long double, 3, 1> start = q.conjugate() * L_W.cast<long double>();
    const double T = uniform(1, 8) / L_B.cwiseQuotient(I).norm();

    State state{q.w(), q.x(), q.y(), q.z(), start.x(), start.y(), start.z()};
    const auto system = [&I](const State& s, State& d, long double) {
      const long double x = s[4] / I[0];
      const long double y = s[5] / I[1];
      const long double z = s[6] / I[2];
      d[0] = -(s[1] * x + s[2] * y + s[3] * z) / 2;
      d[1] = (s[0] * x + s[2] * z - s[3] * y) / 2;
      d[2] = (s[0] * y + s[3] * x - s[1] * z) / 2;
      d[3] = (s[0] * z + s[1] * y - s[2] * x) / 2;
      d[4] = s[5] * z - s[6] * y;
      d[5] = s[6] * x - s[4] * z;
      d[6] = s[4] * y - s[5] * x;
    };
    odeint::integrate_adaptive(
        odeint::make_controlled<odeint::runge_kutta_fehlberg78<State, long double>>(1e-17L, 1e-17L), system, state,
        0.0L, static_cast<long double>(T), T / 50.0L);
    const RigidState exact = TorqueFree(I, q0, L_W).at(T);
    const Eigen::Quaternion<long double> reached(state[0], state[1], state[2], state[3]);
    const auto angle = static_cast<double>(exact.q_WB.cast<long double>().angularDistance(reached.normalized()));
    const Eigen::Matrix<long double, 3, 1> L_reached(state[4], state[5], state[6]);
    const double L = static_cast<double>((exact.L_B.cast<long double>() - L_reached).norm()) / L_W.norm();
    if (angle > worst_angle) {
      worst_angle = angle;
      worst_I = I;
      TaylorBody reference(I, q0, L_W);
      reference.advance_to(T);
      worst_to_reference = geodesic_angle(exact.q_WB, reference.q_WB());
    }
    worst_L = std::max(worst_L, L);
  }
  std::printf(
      "10000 random bodies: worst angle %.2e (I = %.3g, %.3g, %.3g), worst L_B %.2e; that body against 50 digits "
      "%.2e\n",
      worst_angle, worst_I[0], worst_I[1], worst_I[2], worst_L, worst_to_reference);
  EXPECT_LE(worst_angle, tolerance(1e-13));         // measured 2.6e-14: 1e-17 a step, grown by up to e^16
  EXPECT_LE(worst_L, tolerance(1e-13));             // measured 2.6e-14
  EXPECT_LE(worst_to_reference, tolerance(5e-15));  // measured 6.4e-16
}

}  // namespace
}  // namespace bookspin
