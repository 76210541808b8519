// What no internal force may change, and what energy the forces take or give.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "dynamics/random_starts.h"
#include "dynamics/rigid_book.h"
#include "dynamics/spring_book.h"
#include "tolerance.h"

namespace bookspin {
namespace {

Eigen::Vector3d torque(const Corners& x, const Corners& F) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < 8; ++i) sum += x.col(i).cross(F.col(i));
  return sum;
}

// Measured: 3.8e-16 of the largest force, 2.9e-16 of the largest force times distance; damped and undamped, at random
// states.
TEST(SpringForces, SumToZeroAndTurnNothing) {
  for (std::uint64_t start = 1; start <= 40; ++start) {
    BookOptions o = random_options(start);
    if (start % 2 == 0) o.damping = 0.0;
    Dice dice(1000 + start);
    const Corners x = dice.corners(3.0);
    const Corners v = dice.corners(2.0);
    const Corners F = SpringBook(o).forces(x, v).F_W;
    const double largest = F.colwise().norm().maxCoeff();
    EXPECT_LE(F.rowwise().sum().norm() / largest, tolerance(1e-14));
    EXPECT_LE(torque(x, F).norm() / (largest * x.colwise().norm().maxCoeff()), tolerance(1e-14));
  }
}

// Undamped forces are minus the gradient of the elastic energy: central differences of both, error O(d^2) and rounding.
TEST(SpringForces, AreMinusTheGradientOfTheElasticEnergy) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    BookOptions o = random_options(start);
    o.damping = 0.0;
    const SpringBook book(o);
    Dice dice(2000 + start);
    const Corners x = dice.corners(3.0);
    const Corners F = book.forces(x, Corners::Zero()).F_W;
    const double d = 1e-5;
    for (int i = 0; i < 24; ++i) {
      Corners more = x;
      Corners less = x;
      more(i) += d;
      less(i) -= d;
      const double slope =
          (book.forces(more, Corners::Zero()).elastic_energy - book.forces(less, Corners::Zero()).elastic_energy) /
          (2.0 * d);
      EXPECT_NEAR(-slope / F.cwiseAbs().maxCoeff(), F(i) / F.cwiseAbs().maxCoeff(),
                  tolerance(1e-8));  // measured: 1.6e-10
    }
  }
}

// Damping never gives energy: what it takes is c times the squared rate of change of every length.
TEST(SpringForces, DampingTakesCTimesTheSquaredRateOfEveryLength) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    const BookOptions damped = random_options(start);
    BookOptions undamped = damped;
    undamped.damping = 0.0;
    Dice dice(3000 + start);
    const Corners x = dice.corners(3.0);
    const Corners v = dice.corners(2.0);
    const Corners F = SpringBook(damped).forces(x, v).F_W - SpringBook(undamped).forces(x, v).F_W;
    const double power = F.cwiseProduct(v).sum();
    const double c = damped.damping * 2.0 * std::sqrt(damped.stiffness * damped.particle_mass);
    double expected = 0.0;
    for (int i = 0; i < 8; ++i) {
      for (int j = 0; j < i; ++j) {
        const Eigen::Vector3d direction = (x.col(i) - x.col(j)).normalized();
        const double rate = direction.dot(v.col(i) - v.col(j));
        expected -= c * rate * rate;
      }
    }
    EXPECT_NEAR(power / expected, 1.0, tolerance(1e-13));  // measured: 5.6e-16
  }
}

// A rigid motion, any translation and rotation, stretches no spring: no force, damped or not, and no energy.
TEST(SpringForces, FeelNoRigidMotion) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    const BookOptions o = random_options(start);
    Dice dice(4000 + start);
    const Eigen::Matrix3d R = dice.rotation().toRotationMatrix();
    const Eigen::Vector3d shift = dice.vector(5.0);
    const Eigen::Vector3d omega = dice.vector(1.0);
    const Eigen::Vector3d drift = dice.vector(1.0);
    const Corners x = (R * body_of(o).corners_B).colwise() + shift;
    Corners v;
    for (int i = 0; i < 8; ++i) v.col(i) = drift + omega.cross(x.col(i));
    const SpringForces forces = SpringBook(o).forces(x, v);
    EXPECT_LE(forces.F_W.cwiseAbs().maxCoeff() / (o.stiffness * o.size.maxCoeff()),
              tolerance(1e-13));                         // measured: 2.3e-15
    EXPECT_LE(forces.elastic_energy, tolerance(1e-26));  // measured: 4e-28
  }
}

// Momentum and, since x and v change by parallel amounts, angular momentum: explicit Euler changes L only by
// h^2 sum m (v x F / m), exactly. Checked step by step, unnormalized.
TEST(SpringSteps, KeepMomentumAndChangeAngularMomentumOnlyBySecondOrder) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    BookOptions o = random_options(start);
    o.normalize_every = 0;
    SpringBook book(o);
    const double h = 0.01;
    const Eigen::Vector3d L0 = book.angular_momentum_W();
    const double momentum_scale = 8.0 * o.particle_mass * book.velocities_W().colwise().norm().maxCoeff();
    for (int n = 0; n < 300; ++n) {
      const Corners x = book.corners_W();
      const Corners v = book.velocities_W();
      const Eigen::Vector3d L = book.angular_momentum_W();
      const Eigen::Vector3d change = h * h * torque(v, book.forces(x, v).F_W);
      book.step(h);
      EXPECT_LE((book.angular_momentum_W() - L - change).norm() / L0.norm(), tolerance(1e-14));  // measured: 4.1e-16
      const Eigen::Vector3d momentum = o.particle_mass * book.velocities_W().rowwise().sum();
      EXPECT_LE(momentum.norm() / momentum_scale, tolerance(1e-14));  // measured: 3.8e-16
    }
  }
}

// Explicit Euler feeds a rigid rotation: one undamped, unnormalized step from rest keeps the kinetic and adds elastic
// energy.
TEST(SpringSteps, GainEnergyWithoutNormalization) {
  BookOptions o;
  o.omega_W = Eigen::Vector3d(0.3, 0.1, 0.7);
  o.normalize_every = 0;
  o.damping = 0.0;
  SpringBook book(o);
  const double E0 = book.kinetic_energy();
  book.step(0.1);
  EXPECT_EQ(book.kinetic_energy(), E0);
  EXPECT_GT(book.elastic_energy(), 0.0);
}

// L is an input of the rigid methods; energy and orientation are theirs to get wrong. The energy error is of first
// order, so the rotation itself must stay one to rounding: R^T R = 1, det R = 1, |q| = 1.
TEST(RigidSteps, StayRotationsWhenNormalized) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    const BookOptions o = random_options(start);
    MatrixBook matrix(o);
    QuaternionBook quaternion(o);
    const Eigen::Vector3d L = matrix.angular_momentum_W();
    for (int n = 0; n < 2000; ++n) {
      matrix.step(0.1);
      quaternion.step(0.1);
    }
    EXPECT_LE((matrix.R_WB().transpose() * matrix.R_WB() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
              tolerance(1e-14));                                      // measured: 1.8e-15
    EXPECT_NEAR(matrix.R_WB().determinant(), 1.0, tolerance(1e-14));  // measured: 2.4e-15
    EXPECT_NEAR(quaternion.q_WB().norm(), 1.0, tolerance(1e-15));     // measured: 2.2e-16
    EXPECT_EQ(matrix.angular_momentum_W(), L);
    EXPECT_EQ(quaternion.angular_momentum_W(), L);
  }
}

// One step from a rotation multiplies R by 1 + h [omega]x, whose singular values are 1 and twice sqrt(1 + h^2 omega^2):
// det grows by 1 + h^2 omega^2 exactly.
TEST(RigidSteps, MatrixGrowsByHOmegaSquared) {
  BookOptions o = random_options(12);
  o.normalize_every = 0;
  MatrixBook book(o);
  const double h = 0.25;
  book.step(h);
  EXPECT_NEAR(book.R_WB().determinant(), 1.0 + h * h * o.omega_W.squaredNorm(), tolerance(1e-14));  // measured: 2.2e-16
}

}  // namespace
}  // namespace bookspin
