#include "dynamics/shape.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/torque_free_dd.h"

namespace bookspin {
namespace {

// sum x_i b_i^T about the mean of x. The corners at rest have mean 0 and sum b_i b_i^T = 2 diag(a^2, b^2, c^2).
Eigen::Matrix3d correlation(const Corners& corners_W, const Corners& corners_B) {
  const Eigen::Vector3d mean = corners_W.rowwise().mean();
  return (corners_W.colwise() - mean) * corners_B.transpose();
}

// atan2(y, x) for y >= 0, rounded to the nearest double: no two mathematical libraries round it alike. The angle is
// halved three times; its tangent is then below 0.1, and its series good to 21 digits.
double polar_angle(double x, double y) {
  if (y == 0.0 || !std::isfinite(x) || !std::isfinite(y)) return std::atan2(y, x);
  const int exponent = std::ilogb(std::max(std::abs(x), y));
  const Dd across = std::scalbn(std::abs(x), -exponent);
  const Dd up = std::scalbn(y, -exponent);
  Dd t = across < up ? across / up : up / across;
  for (int i = 0; i < 3; ++i) t = t / (sqrt(t * t + 1.0) + 1.0);
  Dd sum;
  for (int k = 21; k > 0; k -= 2) sum = Dd(1.0) / Dd(k) - t * t * sum;
  Dd angle = t * sum * 8.0;
  if (across < up) angle = dd_pi * 0.5 - angle;
  return x < 0.0 ? (dd_pi - angle).hi : angle.hi;
}

}  // namespace

Eigen::Matrix3d deformation(const Corners& corners_W, const Corners& corners_B) {
  const Eigen::Vector3d spread = corners_B.cwiseAbs2().rowwise().sum();
  return correlation(corners_W, corners_B) * spread.cwiseInverse().asDiagonal();
}

Eigen::Quaterniond best_fit_orientation(const Corners& corners_W, const Corners& corners_B) {
  Eigen::Matrix3d H = correlation(corners_W, corners_B);
  const double scale = H.cwiseAbs().maxCoeff();
  if (!H.allFinite() || scale == 0.0) return Eigen::Quaterniond::Identity();
  H /= scale;
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(H, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Matrix3d U = svd.matrixU();
  if ((U * svd.matrixV().transpose()).determinant() < 0.0)
    U.col(2) = -U.col(2);  // the nearest rotation, not the mirror image
  const Eigen::Matrix3d R_WB = U * svd.matrixV().transpose();
  return Eigen::Quaterniond(R_WB).normalized();
}

double stretch(const Corners& corners_W, const Corners& corners_B) {
  if (!corners_W.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      const double now = (corners_W.col(i) - corners_W.col(j)).norm();
      const double rest = (corners_B.col(i) - corners_B.col(j)).norm();
      largest = std::max(largest, std::abs(now / rest - 1.0));
    }
  }
  return largest;
}

double extent(const Corners& corners_W, const Corners& corners_B) {
  if (!corners_W.allFinite()) return std::numeric_limits<double>::quiet_NaN();
  return corners_W.colwise().norm().maxCoeff() / corners_B.col(7).norm();
}

double geodesic_angle(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b) {
  const Eigen::Quaterniond d = a.conjugate() * b;
  return 2.0 * polar_angle(std::abs(d.w()), d.vec().norm());
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return polar_angle(a.cwiseProduct(b).sum(), a.cross(b).norm());
}

}  // namespace bookspin
