// States that have grown past all bounds, or have no numbers in them: data, never a crash.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dynamics/random_starts.h"
#include "dynamics/rigid_book.h"
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
#include "tolerance.h"

namespace bookspin {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

void measure(const Corners& corners, const BookOptions& o) {
  const Corners rest = body_of(o).corners_B;
  EXPECT_EQ(best_fit_orientation(corners, rest).coeffs().allFinite(), true);
  if (!corners.allFinite()) {
    EXPECT_TRUE(std::isnan(stretch(corners, rest)));
    EXPECT_TRUE(std::isnan(extent(corners, rest)));
  }
}

// Steps until a corner is no number, then on: it stays so. Returns the step at which it happened, -1 when it never did.
template <class Book>
int explode(Book book, const BookOptions& o, double h, int steps) {
  int when = -1;
  for (int n = 0; n < steps; ++n) {
    book.step(h);
    if (n % 97 == 0) measure(book.corners_W(), o);
    const bool finite = book.corners_W().allFinite();
    if (when < 0 && !finite) when = n;
    if (when >= 0 && finite) {
      ADD_FAILURE() << "finite again at step " << n << " after step " << when;
      return when;
    }
    (void)book.kinetic_energy();
    (void)book.angular_momentum_W();
  }
  measure(book.corners_W(), o);
  return when;
}

TEST(Explosion, OfUnnormalizedBooksEndsInNoNumberAndStaysThere) {
  BookOptions o = random_options(1);
  o.normalize_every = 0;
  EXPECT_GT(explode(SpringBook(o), o, 0.5, 5000), 0);
  EXPECT_GT(explode(MatrixBook(o), o, 0.5, 5000), 0);
  EXPECT_GT(explode(QuaternionBook(o), o, 0.5, 5000), 0);
  o.damping = 0.0;
  EXPECT_GT(explode(SpringBook(o), o, 0.5, 5000), 0);
}

// Normalization far beyond every stability limit: no claim but that it ends, and rigid books stay rotations.
TEST(Explosion, OfNormalizedBooksDoesNotCrash) {
  for (const double h : {10.0, 1e8, 1e154, 1e300, 1.7e308}) {
    const BookOptions o = random_options(2);
    (void)explode(SpringBook(o), o, h, 300);
    (void)explode(MatrixBook(o), o, h, 300);
    (void)explode(QuaternionBook(o), o, h, 300);
  }
}

// A matrix that one step has grown by 1e8 and more becomes a rotation again, by the SVD; so does the quaternion.
TEST(Explosion, NormalizationBringsBackAStateGrownByAnyFiniteFactor) {
  for (const double h : {1e8, 1e154, 1e300}) {
    const BookOptions o = random_options(2);
    MatrixBook matrix(o);
    QuaternionBook quaternion(o);
    for (int n = 0; n < 5; ++n) {
      matrix.step(h);
      quaternion.step(h);
      const Eigen::Matrix3d& R = matrix.R_WB();
      EXPECT_LE((R.transpose() * R - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff(), tolerance(1e-14))
          << h;                                                           // measured: 1.7e-15
      EXPECT_NEAR(quaternion.q_WB().norm(), 1.0, tolerance(1e-15)) << h;  // measured: 2.2e-16
    }
  }
}

TEST(NoNumber, InTheStartStaysNoNumber) {
  for (const double bad : {nan, infinite}) {
    for (const bool normalize : {true, false}) {
      BookOptions o = random_options(3);
      o.omega_W.y() = bad;
      o.normalize_every = normalize ? 1 : 0;
      SpringBook springs(o);
      MatrixBook matrix(o);
      QuaternionBook quaternion(o);
      for (int n = 0; n < 3; ++n) {
        springs.step(0.1);
        matrix.step(0.1);
        quaternion.step(0.1);
      }
      EXPECT_FALSE(springs.corners_W().allFinite());
      EXPECT_FALSE(matrix.corners_W().allFinite());
      EXPECT_FALSE(quaternion.corners_W().allFinite());
      EXPECT_FALSE(std::isfinite(springs.kinetic_energy()));
      EXPECT_FALSE(std::isfinite(matrix.kinetic_energy()));
      EXPECT_FALSE(std::isfinite(quaternion.kinetic_energy()));
      measure(springs.corners_W(), o);
    }
  }
}

TEST(NoNumber, InTheStepMakesNoNumber) {
  const BookOptions o = random_options(4);
  SpringBook springs(o);
  MatrixBook matrix(o);
  QuaternionBook quaternion(o);
  springs.step(nan);
  matrix.step(nan);
  quaternion.step(nan);
  EXPECT_FALSE(springs.corners_W().allFinite());
  EXPECT_FALSE(matrix.corners_W().allFinite());
  EXPECT_FALSE(quaternion.corners_W().allFinite());
}

TEST(NoNumber, InTheForcesArgumentsIsNoCrash) {
  const SpringBook book(random_options(5));
  Corners x = book.corners_W();
  x(0, 3) = nan;
  const SpringForces forces = book.forces(x, book.velocities_W());
  EXPECT_TRUE(std::isnan(forces.elastic_energy));
  x(0, 3) = infinite;
  EXPECT_FALSE(std::isfinite(book.forces(x, book.velocities_W()).elastic_energy));
}

}  // namespace
}  // namespace bookspin
