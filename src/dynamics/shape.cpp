#include "dynamics/shape.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

namespace bookspin {
namespace {

// sum x_i b_i^T about the mean of x. The corners at rest have mean 0 and sum b_i b_i^T = 2 diag(a^2, b^2, c^2).
Eigen::Matrix3d correlation(const Corners& corners_W, const Corners& corners_B) {
  const Eigen::Vector3d mean = corners_W.rowwise().mean();
  return (corners_W.colwise() - mean) * corners_B.transpose();
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
  return 2.0 * std::atan2(d.vec().norm(), std::abs(d.w()));
}

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.cwiseProduct(b).sum());
}

}  // namespace bookspin
