// The book as a rigid body, its orientation stepped by explicit Euler as a matrix or as a quaternion (paper section 4).
//
//   L_W is constant;  omega_W = R_WB I_B^-1 R_WB^T L_W
//   matrix:      R += h [omega_W]x R;         normalization R = U V^T of the singular value decomposition
//   quaternion:  q += h/2 (0, omega_W) q;     normalization q = q / |q|
//
// The paper prints q' = q omega / 2, which holds for omega in body axes; its omega is in world axes, which needs
// q' = omega q / 2. The quaternion book takes R from q by the usual formula even when |q| = s is not 1; then
// R = (1 - s^2) 1 + s^2 R(q / s): the book blended with its unrotated self, which is the pulsation of Figure 12.
// Nothing throws; a state that has grown past the largest double is non-finite, and stays so.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "dynamics/book.h"

namespace bookspin {

// omega_W for L_W when the orientation is R_WB, a rotation or what an integrator has made of one.
[[nodiscard]] Eigen::Vector3d angular_velocity_W(const Eigen::Matrix3d& R_WB, const Eigen::Vector3d& I_B,
                                                 const Eigen::Vector3d& L_W);

// q = q / |q|. Where |q|^2 would overflow, too: that plain division leaves q = 0, which looks like a book at rest.
void normalize(Eigen::Quaterniond& q);

class MatrixBook {
 public:
  explicit MatrixBook(const BookOptions& options);

  void step(double h, long n = 1);  // h: unit of time; n such steps

  [[nodiscard]] const Eigen::Matrix3d& R_WB() const { return R_WB_; }
  [[nodiscard]] Corners corners_W() const { return R_WB_ * body_.corners_B; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const { return L_W_; }
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * L_W_.cwiseProduct(angular_velocity_W(R_WB_, body_.I_B, L_W_)).sum();
  }

 private:
  Body body_;
  Normalization normalization_;
  Eigen::Vector3d L_W_;
  Eigen::Matrix3d R_WB_ = Eigen::Matrix3d::Identity();
};

class QuaternionBook {
 public:
  explicit QuaternionBook(const BookOptions& options);

  void step(double h, long n = 1);  // h: unit of time; n such steps

  [[nodiscard]] const Eigen::Quaterniond& q_WB() const { return q_WB_; }
  [[nodiscard]] Corners corners_W() const { return q_WB_.toRotationMatrix() * body_.corners_B; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const { return L_W_; }
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * L_W_.cwiseProduct(angular_velocity_W(q_WB_.toRotationMatrix(), body_.I_B, L_W_)).sum();
  }

 private:
  Body body_;
  Normalization normalization_;
  Eigen::Vector3d L_W_;
  Eigen::Quaterniond q_WB_ = Eigen::Quaterniond::Identity();
};

}  // namespace bookspin
