// What eight corners say about a book: fitted orientation, stretch, extent, angles.
#include "dynamics/shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/book.h"
#include "dynamics/random_starts.h"
#include "tolerance.h"

namespace bookspin {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const Eigen::Vector3d size(1.878, 2.9085, 0.5);
const Corners rest = body_of({.size = size}).corners_B;

double misfit(const Corners& x, const Eigen::Quaterniond& q) {
  const Corners about_mean = x.colwise() - x.rowwise().mean();
  return (about_mean - q.toRotationMatrix() * rest).squaredNorm();
}

// No rotation fits better: neither random ones, nor the best one turned a little about any axis.
void expect_best(const Corners& x, Dice& dice) {
  const Eigen::Quaterniond best = best_fit_orientation(x, rest);
  EXPECT_NEAR(best.norm(), 1.0, tolerance(1e-15));
  const double least = misfit(x, best);
  const double slack = tolerance(1e-12) * (least + x.squaredNorm());
  for (int n = 0; n < 100; ++n) {
    EXPECT_GE(misfit(x, dice.rotation()), least - slack);
    const Eigen::Vector3d turn = dice.vector(1.0);
    for (const double angle : {1e-4, 1e-2, 1.0}) {
      EXPECT_GE(misfit(x, best * Eigen::Quaterniond(Eigen::AngleAxisd(angle, turn.normalized()))), least - slack);
    }
  }
}

TEST(BestFit, FindsARotationAgainWhereverTheBookIs) {
  Dice dice(1);
  double worst = 0.0;
  for (int n = 0; n < 200; ++n) {
    const Eigen::Quaterniond q = dice.rotation();
    const Corners x = (q.toRotationMatrix() * rest).colwise() + dice.vector(10.0);
    worst = std::max(worst, geodesic_angle(best_fit_orientation(x, rest), q));
  }
  EXPECT_LE(worst, tolerance(1e-13));  // measured: 1e-15
}

TEST(BestFit, FindsHalfTurnsAgain) {
  for (int d = 0; d < 3; ++d) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(pi, Eigen::Vector3d::Unit(d)));
    EXPECT_LE(geodesic_angle(best_fit_orientation(q.toRotationMatrix() * rest, rest), q),
              tolerance(1e-14));  // measured: 1.2e-16
  }
}

TEST(BestFit, IsBestForNoisyCorners) {
  Dice dice(2);
  for (const double noise : {1e-3, 0.1, 1.0}) {
    const Eigen::Quaterniond q = dice.rotation();
    const Corners x = q.toRotationMatrix() * rest + dice.corners(noise);
    expect_best(x, dice);
    if (noise < 0.01) {
      EXPECT_LE(geodesic_angle(best_fit_orientation(x, rest), q), 5.0 * noise);
    }
  }
}

TEST(BestFit, OfAMirroredBookIsARotationAndTheBest) {
  Dice dice(3);
  for (int d = 0; d < 3; ++d) {
    Corners mirrored = rest;
    mirrored.row(d) = -mirrored.row(d);
    const Corners x = dice.rotation().toRotationMatrix() * mirrored;
    expect_best(x, dice);
    EXPECT_NEAR(best_fit_orientation(x, rest).toRotationMatrix().determinant(), 1.0,
                tolerance(1e-14));  // measured: 8.9e-16
  }
}

TEST(BestFit, OfAFlattenedBookIsTheBest) {
  Dice dice(4);
  for (int d = 0; d < 3; ++d) {  // two dimensions left: the rotation is still unique
    Corners flat = rest;
    flat.row(d).setZero();
    const Eigen::Quaterniond q = dice.rotation();
    const Corners x = q.toRotationMatrix() * flat;
    EXPECT_LE(geodesic_angle(best_fit_orientation(x, rest), q), tolerance(1e-13)) << d;  // measured: 3e-16
  }
  for (int d = 0; d < 3; ++d) {  // one dimension left: many rotations fit alike
    Corners line = Corners::Zero();
    line.row(d) = rest.row(d);
    expect_best(dice.rotation().toRotationMatrix() * line, dice);
  }
}

TEST(BestFit, OfAPointOrOfNoNumbersIsTheIdentity) {
  Corners broken = rest;
  EXPECT_EQ(best_fit_orientation(Corners::Zero(), rest).coeffs(), Eigen::Quaterniond::Identity().coeffs());
  for (const double bad : {nan, infinite, -infinite}) {
    broken(1, 5) = bad;
    EXPECT_EQ(best_fit_orientation(broken, rest).coeffs(), Eigen::Quaterniond::Identity().coeffs());
  }
}

// A book grown by 1e8 or 1e300, or collapsed to 1e-300, still has its orientation.
TEST(BestFit, DoesNotMindTheSizeOfTheBook) {
  Dice dice(5);
  for (const double factor : {1e8, 1e150, 1e300, 1e-8, 1e-150, 1e-300}) {
    const Eigen::Quaterniond q = dice.rotation();
    const Corners x = factor * (q.toRotationMatrix() * rest);
    EXPECT_LE(geodesic_angle(best_fit_orientation(x, rest), q), tolerance(1e-13)) << factor;  // measured: 4.5e-16
  }
}

TEST(Deformation, OfALinearImageIsThatLinearMap) {
  Dice dice(6);
  for (int n = 0; n < 50; ++n) {
    Eigen::Matrix3d F;
    for (int d = 0; d < 3; ++d) F.col(d) = dice.vector(2.0);
    const Corners x = (F * rest).colwise() + dice.vector(3.0);
    EXPECT_LE((deformation(x, rest) - F).cwiseAbs().maxCoeff(), tolerance(1e-13));  // measured: 1.2e-15
  }
}

// The least-squares map: what is left over is orthogonal to the corners at rest.
TEST(Deformation, OfAnyCornersIsTheLeastSquaresMap) {
  Dice dice(7);
  for (int n = 0; n < 50; ++n) {
    const Corners x = dice.corners(2.0);
    const Corners rest_of_x = (x.colwise() - x.rowwise().mean()) - deformation(x, rest) * rest;
    EXPECT_LE((rest_of_x * rest.transpose()).cwiseAbs().maxCoeff(), tolerance(1e-13));  // measured: 2.3e-15
  }
}

TEST(Stretch, IsTheLargestRelativeChangeOfADistance) {
  Dice dice(8);
  const Corners moved = (dice.rotation().toRotationMatrix() * rest).colwise() + dice.vector(3.0);
  EXPECT_LE(stretch(moved, rest), tolerance(1e-14));                 // measured: 4.4e-16
  EXPECT_NEAR(stretch(1.25 * moved, rest), 0.25, tolerance(1e-14));  // measured: 1.1e-15
  EXPECT_NEAR(stretch(0.25 * moved, rest), 0.75, tolerance(1e-14));  // measured: 0
  Corners thicker = rest;
  thicker.row(2) *= 1.5;  // the thickness grows by half, and no other distance by as much
  EXPECT_NEAR(stretch(thicker, rest), 0.5, tolerance(1e-14));  // measured: 0
  EXPECT_EQ(stretch(Corners::Zero(), rest), 1.0);
  Corners broken = rest;
  for (const double bad : {nan, infinite}) {
    broken(2, 0) = bad;
    EXPECT_TRUE(std::isnan(stretch(broken, rest)));
  }
}

TEST(Extent, IsTheFarthestCornerInHalfDiagonals) {
  EXPECT_EQ(extent(rest, rest), 1.0);
  EXPECT_NEAR(extent(3.0 * rest, rest), 3.0, tolerance(1e-14));  // measured: 0
  Corners one_away = rest;
  one_away.col(2) *= 2.5;
  EXPECT_NEAR(extent(one_away, rest), 2.5, tolerance(1e-14));  // measured: 4.4e-16
  one_away(0, 2) = nan;
  EXPECT_TRUE(std::isnan(extent(one_away, rest)));
  one_away(0, 2) = infinite;
  EXPECT_TRUE(std::isnan(extent(one_away, rest)));
}

TEST(GeodesicAngle, IsAccurateFrom0ToPi) {
  Dice dice(9);
  for (const double angle : {0.0, 1e-300, 1e-15, 1e-8, 1e-3, 1.0, 3.0, pi - 1e-3, pi - 1e-8, pi - 1e-15, pi}) {
    const Eigen::Vector3d axis = dice.vector(1.0).normalized();
    const Eigen::Quaterniond turned(std::cos(angle / 2), axis.x() * std::sin(angle / 2), axis.y() * std::sin(angle / 2),
                                    axis.z() * std::sin(angle / 2));
    // From the identity there is no rounding but that of the quaternion. Measured: 0.
    EXPECT_NEAR(geodesic_angle(Eigen::Quaterniond::Identity(), turned), angle,
                tolerance(1e-15) * std::max(angle, 1e-14));
    // From a general orientation rounding of the product remains. Measured: 1.9e-16.
    const Eigen::Quaterniond start = dice.rotation();
    const Eigen::Quaterniond end = start * turned;
    EXPECT_NEAR(geodesic_angle(start, end), angle, tolerance(2e-15));
    EXPECT_NEAR(geodesic_angle(end, start), angle, tolerance(2e-15));
    const Eigen::Quaterniond opposite(-end.w(), -end.x(), -end.y(), -end.z());
    EXPECT_NEAR(geodesic_angle(start, opposite), angle, tolerance(2e-15));
    const Eigen::Quaterniond longer(7.0 * end.w(), 7.0 * end.x(), 7.0 * end.y(), 7.0 * end.z());
    EXPECT_NEAR(geodesic_angle(start, longer), angle, tolerance(2e-15));
  }
}

// As a longer float rounds it, so that every machine has the same angle.
TEST(AngleBetween, IsRoundedToTheNearestDouble) {
  Dice dice(10);
  for (int n = 0; n < 20000; ++n) {
    const double length = std::pow(10.0, 300.0 * dice.vector(1.0).x() / 2.0);
    const Eigen::Vector3d to(dice.vector(1.0).x() * length, std::abs(dice.vector(1.0).y()) * length, 0.0);
    const long double expected = std::atan2(static_cast<long double>(to.y()), static_cast<long double>(to.x()));
    const double found = angle_between(Eigen::Vector3d::UnitX(), to);
    const double last_digit = std::nextafter(found, 4.0) - found;
    EXPECT_LE(std::abs(static_cast<double>(found - expected)), 0.501 * last_digit) << to.transpose();  // measured: 0.5
  }
}

TEST(AngleBetween, IsAccurateFrom0ToPi) {
  for (const double angle : {0.0, 1e-300, 1e-15, 1e-8, 1.0, pi - 1e-8, pi - 1e-15, pi}) {
    const Eigen::Vector3d turned(std::cos(angle), std::sin(angle), 0.0);
    EXPECT_NEAR(angle_between(Eigen::Vector3d(5.0, 0.0, 0.0), 0.1 * turned), angle,
                tolerance(1e-15) * std::max(angle, 1e-14));  // measured: 1e-300
  }
  EXPECT_EQ(angle_between(Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()), 0.0);
  EXPECT_EQ(angle_between(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()), 0.0);
}

}  // namespace
}  // namespace bookspin
