// The discrete Moser-Veselov step with the moments for which it is the motion itself.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/random_starts.h"
#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/rigid_steps.h"
#include "dynamics/shape.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using Eigen::Vector3d;

// The moments that dmv steps with reproduce the literature's first correction, and are of the motion, not of the state.
TEST(DmvMoments, BeginAsHairerAndVilmartPrintThem) {
  const Vector3d I(1.3, 2.1, 2.9);
  const Vector3d L(0.4, -0.7, 0.9);
  const double C = 0.5 * L.squaredNorm();
  const double H = 0.5 * L.dot(L.cwiseQuotient(I));
  const double s3 = -I.cwiseInverse().sum() * H / 3.0 + I.sum() / (6.0 * I.prod()) * C;
  const double d3 = I.sum() / (6.0 * I.prod()) * H - C / (3.0 * I.prod());
  const double h = 1e-3;
  const Vector3d change =
      (rigid_plan(Integrator::dmv, I, L, h).dmv_moments.cwiseInverse() - I.cwiseInverse()) / (h * h);
  EXPECT_LE((change - s3 * I.cwiseInverse() - Vector3d::Constant(d3)).cwiseAbs().maxCoeff(),
            tolerance(1e-8));  // measured: 7.1e-10
}

TEST(DmvMoments, AreOfTheMotionWhateverStateItIsIn) {
  const Vector3d I(1.3, 2.1, 2.9);
  const Vector3d L(0.4, -0.7, 0.9);
  const TorqueFree motion(I, Eigen::Quaterniond::Identity(), L);
  for (const double h : {1e-6, 0.1, 2.0}) {
    const Vector3d moments = rigid_plan(Integrator::dmv, I, L, h).dmv_moments;
    for (double t = 1.0; t < 10.0; t += 1.0) {
      const Vector3d later = rigid_plan(Integrator::dmv, I, motion.at(t).L_B, h).dmv_moments;
      EXPECT_LE((later - moments).cwiseQuotient(moments).cwiseAbs().maxCoeff(), tolerance(1e-14));  // measured: 6.5e-16
    }
    const Vector3d back = rigid_plan(Integrator::dmv, I, L, -h).dmv_moments;
    EXPECT_LE((back - moments).cwiseQuotient(moments).cwiseAbs().maxCoeff(), tolerance(1e-15));  // measured: 0
  }
}

// Any step within the method's reach is the motion itself, for all bodies and axes: there is rounding, and what the
// unstable axis makes of it.
TEST(DiscreteMoserVeselov, IsTheMotionItself) {
  double worst = 0.0;
  for (const Vector3d& size : {Vector3d(1.878, 2.9085, 0.5), Vector3d(1, 1.7, 2.2), Vector3d(1, 1, 2),
                               Vector3d(2, 1, 1), Vector3d(1, 1, 1), Vector3d(2, 3, 1e-6), Vector3d(1, 1e-3, 1e-3)}) {
    for (const Vector3d& axis :
         {Vector3d(1, 0, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1e-9, 1e-8), Vector3d(1e-9, 1, 1e-8),
          Vector3d(1e-9, 1e-8, 1), Vector3d(1, 1e-2, 0), Vector3d(0.6, 0, 0.8), Vector3d(-0.6, 0.64, 0.48)}) {
      for (const double h : {1e-3, 0.1, 0.7, 1.3}) {
        BookOptions o = tumbling(Integrator::dmv);
        o.size = size;
        o.omega_W = axis.normalized();
        const TorqueFree exact = exact_motion(o);
        FreeBook book(o);
        const double sigma = intermediate_axis_growth_rate(body_of(o).I_B, book.L_B().norm());
        for (int n = 1; n <= 60; ++n) {
          book.step(h);
          ASSERT_TRUE(book.L_B().allFinite()) << size.transpose() << "; " << axis.transpose() << "; " << h;
          const double grown = std::exp(std::min(sigma * n * h, 30.0));
          worst = std::max(worst, geodesic_angle(book.q_WB(), exact.at(n * h).q_WB) / grown);
        }
      }
    }
  }
  EXPECT_LE(worst, tolerance(1e-12));  // measured: 2.7e-13
}

// Its reach, h |omega| = pi / 2 where a motion of this |L| and energy is fastest, is taken up to the end, and the end is said with NaN.
TEST(DiscreteMoserVeselov, SaysWhereItEnds) {
  for (const Vector3d& omega : {Vector3d(1, 1e-9, 0), Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(1, 1e-3, 0),
                                Vector3d(0.6, 0, 0.8), Vector3d(-0.6, 0.64, 0.48)}) {
    for (const Vector3d& size :
         {Vector3d(1.878, 2.9085, 0.5), Vector3d(1, 1, 1), Vector3d(2, 3, 1e-6), Vector3d(1, 0.3, 4)}) {
      BookOptions o = tumbling(Integrator::dmv);
      o.size = size;
      o.omega_W = omega;
      const Vector3d I_B = body_of(o).I_B;
      const TorqueFree exact = exact_motion(o);
      double fastest = 0.0;
      for (double t = 0.0; t < 200.0; t += 0.01) fastest = std::max(fastest, exact.at(t).L_B.cwiseQuotient(I_B).norm());
      for (double h = 0.05; h < 20.0; h *= 1.03) {
        FreeBook book(o);
        book.step(h);
        const double turn = h * fastest;
        if (turn < 1.55 || turn > 1.6) {
          EXPECT_EQ(book.L_B().allFinite(), turn < 1.6) << h << "; " << omega.transpose() << "; " << size.transpose();
        }
        book.step(h);  // and stays so
        EXPECT_TRUE(turn < 1.6 || !book.L_B().allFinite());
      }
    }
  }
}

}  // namespace
}  // namespace bookspin
