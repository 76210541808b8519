// What the original program did, fact by fact: sizes, speeds, the order of its updates, its quaternions.
#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/naive_book.h"
#include "dynamics/random_starts.h"
#include "dynamics/rigid_book.h"
#include "dynamics/spring_book.h"
#include "tolerance.h"

namespace bookspin {
namespace {

Eigen::Matrix3d hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  for (int i = 0; i < 3; ++i) m.col(i) = a.cross(Eigen::Vector3d::Unit(i));
  return m;
}

template <class A, class B>
double relative(const A& a, const B& b) {
  return (a - b).norm() / b.norm();
}

TEST(Original, BookHasItsSizeAndCorners) {
  const BookOptions options;
  EXPECT_EQ(options.size, Eigen::Vector3d(1.878, 2.9085, 0.5));
  const Corners corners = body_of(options).corners_B;
  const double a = 1.878 / 2;
  const double b = 2.9085 / 2;
  const double c = 0.25;
  Corners expected;
  expected << -a, a, -a, a, -a, a, -a, a,  //
      -b, -b, b, b, -b, -b, b, b,          //
      -c, -c, -c, -c, c, c, c, c;
  EXPECT_EQ(corners, expected);
}

TEST(Original, SpringsHaveItsConstants) {
  const BookOptions options;
  EXPECT_EQ(options.stiffness, 10.0);
  EXPECT_EQ(options.particle_mass, 1.0);
  EXPECT_EQ(options.damping, 1.0);
  EXPECT_EQ(options.normalize_every, 1);
}

// The original's inertia (b^2 + c^2, ...) is half that of the eight unit masses; its angular momenta give the table's
// speeds.
TEST(Original, AngularSpeedsFollowFromItsAngularMomenta) {
  const Eigen::Vector3d I_original = body_of(BookOptions{}).I_B / 2.0;
  EXPECT_NEAR(1.0 / I_original.x(), 0.11482, 5e-6);  // the table's rounding
  EXPECT_NEAR(0.5 / I_original.y(), 0.13238, 5e-6);
  EXPECT_NEAR(1.0 / I_original.z(), 0.08343, 5e-6);
  // The reference case "a", in decimal. Measured: 0.
  EXPECT_LE(relative(I_original, Eigen::Vector3d(8.709372250000001, 3.7768839999999995, 11.98625625)),
            tolerance(1e-14));
}

// Eight masses and the solid cuboid of the same mass: moments in the ratio 3 to 1 about every axis. Measured: 1.5e-16.
TEST(Inertia, IsThreeTimesThatOfTheSolidCuboid) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    const BookOptions o = random_options(start);
    const double M = 8.0 * o.particle_mass;
    const double a = o.size.x();
    const double b = o.size.y();
    const double c = o.size.z();
    const Eigen::Vector3d solid = M / 12.0 * Eigen::Vector3d(b * b + c * c, a * a + c * c, a * a + b * b);
    const Eigen::Vector3d ratio = body_of(o).I_B.cwiseQuotient(solid);
    EXPECT_LE(relative(ratio, Eigen::Vector3d::Constant(3.0)), tolerance(1e-14));

    // And by the definition of the inertia tensor, sum m (r^2 1 - r r^T), products of inertia included.
    // Measured: 2.9e-16.
    Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
    const Corners r = body_of(o).corners_B;
    for (int i = 0; i < 8; ++i) tensor -= o.particle_mass * hat(r.col(i)) * hat(r.col(i));
    const Eigen::Matrix3d expected = body_of(o).I_B.asDiagonal();
    EXPECT_LE(relative(tensor, expected), tolerance(1e-14));
  }
}

// A heavier book of the same shape and spin turns in the same way: moments matter only by their ratios. Measured: 0.
TEST(Inertia, DoesNotMatterByItsScale) {
  BookOptions light = random_options(4);
  BookOptions heavy = light;
  heavy.particle_mass = 64.0 * light.particle_mass;
  MatrixBook a(light);
  MatrixBook b(heavy);
  for (int n = 0; n < 200; ++n) {
    a.step(0.05);
    b.step(0.05);
  }
  EXPECT_LE((a.R_WB() - b.R_WB()).cwiseAbs().maxCoeff(), tolerance(1e-13));
}

TEST(Start, IsOneRigidRotationForEveryMethod) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    const BookOptions o = random_options(start);
    const SpringBook springs(o);
    const MatrixBook matrix(o);
    const QuaternionBook quaternion(o);
    EXPECT_EQ(springs.corners_W(), body_of(o).corners_B);
    EXPECT_EQ(matrix.corners_W(), springs.corners_W());
    EXPECT_EQ(quaternion.corners_W(), springs.corners_W());
    for (int i = 0; i < 8; ++i) EXPECT_EQ(springs.velocities_W().col(i), o.omega_W.cross(springs.corners_W().col(i)));
    EXPECT_EQ(springs.elastic_energy(), 0.0);
    // Measured: at most 3.3e-16.
    const Eigen::Vector3d L = springs.angular_momentum_W();
    EXPECT_LE(relative(matrix.angular_momentum_W(), L), tolerance(1e-14));
    EXPECT_EQ(quaternion.angular_momentum_W(), matrix.angular_momentum_W());
    EXPECT_NEAR(matrix.kinetic_energy() / springs.kinetic_energy(), 1.0, tolerance(1e-14));
    EXPECT_NEAR(quaternion.kinetic_energy() / springs.kinetic_energy(), 1.0, tolerance(1e-14));
    const Eigen::Vector3d I_B = body_of(o).I_B;
    EXPECT_LE(relative(angular_velocity_W(matrix.R_WB(), I_B, L), o.omega_W), tolerance(1e-14));
  }
}

// The first step by hand: forces from the old state, x moved with the old v, v with the old forces. At rest and rigidly
// turning the springs pull nothing, so that v does not change; symplectic Euler would do the same here, so take two
// steps.
TEST(Order, PositionsMoveWithTheOldVelocitiesAndForcesComeFromTheOldState) {
  BookOptions o = random_options(7);
  o.normalize_every = 0;
  SpringBook book(o);
  const double h = 0.02;
  const Corners x0 = book.corners_W();
  const Corners v0 = book.velocities_W();
  const Corners F0 = book.forces(x0, v0).F_W;
  EXPECT_LE(F0.cwiseAbs().maxCoeff(), tolerance(1e-14));  // measured: 1.9e-16
  book.step(h);
  const Corners x1 = book.corners_W();
  const Corners v1 = book.velocities_W();
  EXPECT_EQ(x1, x0 + h * v0);
  EXPECT_EQ(v1, v0 + (h / o.particle_mass) * F0);
  const Corners F1 = book.forces(x1, v1).F_W;
  EXPECT_GT(F1.cwiseAbs().maxCoeff(), 1e-3);
  book.step(h);
  EXPECT_EQ(book.corners_W(), x1 + h * v1);
  EXPECT_EQ(book.velocities_W(), v1 + (h / o.particle_mass) * F1);
}

// normalize_every = n: steps 1 ... n - 1 are plain, the n-th is normalized.
TEST(NormalizeEvery, TouchesEveryNthStepOnly) {
  BookOptions often = random_options(8);
  often.normalize_every = 3;
  BookOptions never = often;
  never.normalize_every = 0;
  SpringBook springs(often);
  SpringBook plain_springs(never);
  MatrixBook matrix(often);
  MatrixBook plain_matrix(never);
  QuaternionBook quaternion(often);
  QuaternionBook plain_quaternion(never);
  for (int n = 1; n <= 3; ++n) {
    springs.step(0.1);
    plain_springs.step(0.1);
    matrix.step(0.1);
    plain_matrix.step(0.1);
    quaternion.step(0.1);
    plain_quaternion.step(0.1);
    const bool plain = n < 3;
    EXPECT_EQ(springs.velocities_W() == plain_springs.velocities_W(), plain) << n;
    EXPECT_EQ(matrix.R_WB() == plain_matrix.R_WB(), plain) << n;
    EXPECT_EQ(quaternion.q_WB().coeffs() == plain_quaternion.q_WB().coeffs(), plain) << n;
  }
  // Measured: 6.7e-16 and 2.2e-16.
  EXPECT_LE((matrix.R_WB().transpose() * matrix.R_WB() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(),
            tolerance(1e-14));
  EXPECT_NEAR(quaternion.q_WB().norm(), 1.0, tolerance(1e-15));
}

// Drift: rounding gives the book a velocity, which without normalization carries its center away.
TEST(Drift, IsRemovedFromPositionsAndVelocities) {
  BookOptions o;
  o.omega_W = Eigen::Vector3d(0.03, 0.02, 0.05);
  BookOptions drifting = o;
  drifting.normalize_every = 0;
  SpringBook book(o);
  SpringBook drifter(drifting);
  for (int n = 0; n < 200000; ++n) {
    book.step(0.01);
    drifter.step(0.01);
  }
  const auto off_center = [](const Corners& corners) { return corners.rowwise().mean().cwiseAbs().maxCoeff(); };
  EXPECT_LE(off_center(book.corners_W()), tolerance(1e-15));     // measured: 5.6e-17
  EXPECT_LE(off_center(book.velocities_W()), tolerance(1e-16));  // measured: 8.7e-19
  EXPECT_GE(off_center(drifter.corners_W()), 1e-14);             // found: 6e-13
}

// |q| = s: the book of the quaternion method is (1 - s^2) 1 + s^2 R(q / s), seen here after a drift of s past 1.2.
TEST(Quaternion, OfNormSBlendsTheBookWithItsUnrotatedSelf) {
  for (std::uint64_t start = 1; start <= 10; ++start) {
    BookOptions o = random_options(start);
    o.normalize_every = 0;
    QuaternionBook book(o);
    const Corners rest = body_of(o).corners_B;
    for (int n = 0; n < 5000 && book.q_WB().norm() < 1.2; ++n) book.step(0.1);
    const double s = book.q_WB().norm();
    EXPECT_GE(s, 1.2);
    const Eigen::Quaterniond unit(book.q_WB().coeffs() / s);
    // The rotation of unit, without any matrix formula: b + 2 w u x b + 2 u x (u x b).
    for (int i = 0; i < 8; ++i) {
      const Eigen::Vector3d b = rest.col(i);
      const Eigen::Vector3d rotated =
          b + 2.0 * unit.w() * unit.vec().cross(b) + 2.0 * unit.vec().cross(unit.vec().cross(b));
      const Eigen::Vector3d blended = (1.0 - s * s) * b + s * s * rotated;
      EXPECT_LE((book.corners_W().col(i) - blended).norm() / b.norm(), tolerance(1e-14));  // measured: 5.4e-16
    }
  }
}

// One unnormalized step turns q into q (or omega q / 2), whose square grows by h^2 omega^2 / 4: exactly, for any q of
// norm 1.
TEST(Quaternion, GrowsByAQuarterOfHOmegaSquared) {
  BookOptions o = random_options(9);
  o.normalize_every = 0;
  QuaternionBook book(o);
  const double h = 0.3;
  book.step(h);
  EXPECT_NEAR(book.q_WB().squaredNorm(), 1.0 + h * h * o.omega_W.squaredNorm() / 4.0, tolerance(1e-15));  // measured: 0
}

// omega in world axes multiplies from the left. From a general orientation the two products move the corners
// differently, and only omega q / 2 moves them as omega x r does. Central difference of two short steps' worth of
// rotation, error O(h^2).
TEST(Quaternion, RateIsOmegaQInWorldAxes) {
  BookOptions o = random_options(10);
  QuaternionBook book(o);
  for (int n = 0; n < 200; ++n) book.step(0.05);
  const Eigen::Quaterniond q = book.q_WB();
  const Eigen::Vector3d I_B = body_of(o).I_B;
  const Eigen::Vector3d omega_W = angular_velocity_W(q.toRotationMatrix(), I_B, book.angular_momentum_W());
  const Corners before = book.corners_W();
  const double h = 1e-6;
  book.step(h);
  const Corners velocity = (book.corners_W() - before) / h;
  const Corners expected = hat(omega_W) * before;
  EXPECT_LE((velocity - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff(),
            tolerance(1e-5));                                                        // measured: 2.8e-07
  const Corners by_printed_equation = hat(q.toRotationMatrix() * omega_W) * before;  // q omega = (q omega q^-1) q
  EXPECT_GT((velocity - by_printed_equation).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff(), 0.1);
}

// The printed equation is right for omega in body axes: q omega_B = omega_W q. Measured: 4.4e-16.
TEST(Quaternion, PrintedEquationHoldsInBodyAxes) {
  Dice dice(11);
  for (int n = 0; n < 20; ++n) {
    const Eigen::Quaterniond q = dice.rotation();
    const Eigen::Vector3d omega_W = dice.vector(1.0);
    const Eigen::Vector3d omega_B = q.conjugate() * omega_W;
    const Eigen::Quaterniond left = Eigen::Quaterniond(0.0, omega_W.x(), omega_W.y(), omega_W.z()) * q;
    const Eigen::Quaterniond right = q * Eigen::Quaterniond(0.0, omega_B.x(), omega_B.y(), omega_B.z());
    EXPECT_LE((left.coeffs() - right.coeffs()).cwiseAbs().maxCoeff(), tolerance(1e-15));
  }
}

// With h = 0.1 damped springs are unstable, with six substeps they are stable: the fastest mode's damping sets the
// limit.
TEST(Original, OneSubstepExplodesAndSixDoNot) {
  BookOptions o;
  o.omega_W = Eigen::Vector3d(0.0, 0.0, 0.08343);
  o.normalize_every = 0;
  SpringBook coarse(o);
  SpringBook fine(o);
  for (int n = 0; n < 100; ++n) {
    coarse.step(0.1);
    for (int i = 0; i < 6; ++i) fine.step(0.1 / 6);
  }
  const double rest = body_of(o).corners_B.col(7).norm();
  EXPECT_FALSE(coarse.corners_W().cwiseAbs().maxCoeff() < 1e3 * rest);
  EXPECT_NEAR(fine.corners_W().colwise().norm().maxCoeff() / rest, 1.0, 0.01);
}

}  // namespace
}  // namespace bookspin
