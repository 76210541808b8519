#include "dynamics/rigid_book.h"

#include <Eigen/SVD>
#include <cmath>

namespace bookspin {

Eigen::Vector3d angular_velocity_W(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& I_B,
                                   const Eigen::Vector3d& L_W) {
  const Eigen::Vector3d L_B = R_WB.transpose() * L_W;
  const Eigen::Vector3d omega_B = L_B.cwiseQuotient(I_B);
  return R_WB * omega_B;
}

void normalize(Eigen::Quaterniond& q) {
  const double n2 = q.squaredNorm();
  const bool plain = n2 > 1e-280 && n2 < 1e280;  // stableNorm costs twice as much
  q.coeffs() /= plain ? std::sqrt(n2) : q.coeffs().stableNorm();
}

MatrixBook::MatrixBook(const BookOptions& options)
    : body_(body_of(options)), normalization_{options.normalize_every}, L_W_(body_.I_B.cwiseProduct(options.omega_W)) {}

void MatrixBook::step(double h, long n) {
  for (; n > 0; --n) {
    const Eigen::Vector3d turn_W = h * angular_velocity_W(R_WB_, body_.I_B, L_W_);
    for (int d = 0; d < 3; ++d) R_WB_.col(d) += turn_W.cross(R_WB_.col(d));
    // det(R + h [omega]x R) = det R (1 + h^2 omega^2) > 0: U V^T is a rotation, never a reflection.
    if (normalization_.due() && R_WB_.allFinite()) {
      const Eigen::JacobiSVD<Eigen::Matrix3d> svd(R_WB_, Eigen::ComputeFullU | Eigen::ComputeFullV);
      R_WB_ = svd.matrixU() * svd.matrixV().transpose();
    }
  }
}

QuaternionBook::QuaternionBook(const BookOptions& options)
    : body_(body_of(options)), normalization_{options.normalize_every}, L_W_(body_.I_B.cwiseProduct(options.omega_W)) {}

void QuaternionBook::step(double h, long n) {
  for (; n > 0; --n) {
    const Eigen::Vector3d omega_W = angular_velocity_W(q_WB_.toRotationMatrix(), body_.I_B, L_W_);
    const Eigen::Quaterniond rate(0.0, omega_W.x(), omega_W.y(), omega_W.z());
    q_WB_.coeffs() += 0.5 * h * (rate * q_WB_).coeffs();
    if (normalization_.due()) normalize(q_WB_);
  }
}

}  // namespace bookspin
