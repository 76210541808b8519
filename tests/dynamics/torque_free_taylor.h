// The free rigid body by Taylor series of order 40 in 50 digits: slow, and independent of every formula of
// torque_free.h.
//
//   dL/dt = L x (L / I),   dq/dt = q (0, L / I) / 2   (L in the body frame, q body -> world)
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace bookspin {

using Wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using WideQuaternion = std::array<Wide, 4>;  // w, x, y, z

inline WideQuaternion multiply(const WideQuaternion& p, const WideQuaternion& q) {
  return {p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3], p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
          p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1], p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0]};
}

inline WideQuaternion conjugate(const WideQuaternion& q) {
  return {q[0], -q[1], -q[2], -q[3]};
}

// Angle of the rotation from q to the exact orientation.
inline double geodesic_angle(const Eigen::Quaterniond& q, const WideQuaternion& exact) {
  const WideQuaternion step = multiply(conjugate(exact), {q.w(), q.x(), q.y(), q.z()});
  const Wide vector = sqrt(step[1] * step[1] + step[2] * step[2] + step[3] * step[3]);
  return static_cast<double>(2 * atan2(vector, abs(step[0])));
}

class TaylorBody {
 public:
  // The book of book.h with particles of mass 1, its moments not rounded.
  static TaylorBody of_book(const Eigen::Vector3d& size, const Eigen::Vector3d& omega_W) {
    TaylorBody body({1, 1, 1}, Eigen::Quaterniond::Identity(), {0, 0, 0});
    for (std::size_t i = 0; i < 3; ++i) {
      const Wide b = size[static_cast<int>(i + 1) % 3];
      const Wide c = size[static_cast<int>(i + 2) % 3];
      const Wide I = 2 * (b * b + c * c);
      body.inverse_I_[i] = 1 / I;
      body.L_[i] = I * omega_W[static_cast<int>(i)];
    }
    return body;
  }

  // q need not be normalized.
  TaylorBody(const Eigen::Vector3d& I_B, const Eigen::Quaterniond& q_WB0, const Eigen::Vector3d& L_W) {
    q_ = {q_WB0.w(), q_WB0.x(), q_WB0.y(), q_WB0.z()};
    Wide norm = 0;
    for (const Wide& x : q_) norm += x * x;
    norm = sqrt(norm);
    for (Wide& x : q_) x /= norm;
    const WideQuaternion L = multiply(multiply(conjugate(q_), {0, L_W[0], L_W[1], L_W[2]}), q_);
    L_ = {L[1], L[2], L[3]};
    for (std::size_t i = 0; i < 3; ++i) inverse_I_[i] = 1 / Wide(I_B[static_cast<int>(i)]);
  }

  [[nodiscard]] const Wide& time() const { return t_; }
  [[nodiscard]] const std::array<Wide, 3>& L_B() const { return L_; }
  [[nodiscard]] const std::array<Wide, 3>& inverse_I() const { return inverse_I_; }
  [[nodiscard]] const WideQuaternion& q_WB() const { return q_; }

  void advance_to(const Wide& t) {
    while (t_ != t) {
      expand();
      const Wide left = t - t_;
      const Wide h = std::min(Wide(abs(left)), radius_);
      step(left < 0 ? Wide(-h) : h);
      if (abs(left) == h) t_ = t;
    }
  }

 private:
  static constexpr std::size_t order = 40;

  void expand() {
    for (std::size_t i = 0; i < 3; ++i) Ls_[i][0] = L_[i];
    for (std::size_t i = 0; i < 4; ++i) qs_[i][0] = q_[i];
    for (std::size_t n = 0; n < order; ++n) {
      std::array<Wide, 3> L{};
      WideQuaternion q{};
      for (std::size_t i = 0; i < 3; ++i) omega_[i][n] = Ls_[i][n] * inverse_I_[i];
      for (std::size_t k = 0; k <= n; ++k) {
        const auto& w = omega_;
        const std::size_t m = n - k;
        for (std::size_t i = 0; i < 3; ++i) L[i] += Ls_[(i + 1) % 3][k] * Ls_[(i + 2) % 3][m];
        q[0] -= qs_[1][k] * w[0][m] + qs_[2][k] * w[1][m] + qs_[3][k] * w[2][m];
        q[1] += qs_[0][k] * w[0][m] + qs_[2][k] * w[2][m] - qs_[3][k] * w[1][m];
        q[2] += qs_[0][k] * w[1][m] + qs_[3][k] * w[0][m] - qs_[1][k] * w[2][m];
        q[3] += qs_[0][k] * w[2][m] + qs_[1][k] * w[1][m] - qs_[2][k] * w[0][m];
      }
      for (std::size_t i = 0; i < 3; ++i) {
        Ls_[i][n + 1] = L[i] * (inverse_I_[(i + 2) % 3] - inverse_I_[(i + 1) % 3]) / (n + 1);
      }
      for (std::size_t i = 0; i < 4; ++i) qs_[i][n + 1] = q[i] / (2 * (n + 1));
    }
    // The last term is below 1e-45 of a unit quaternion, and the kicks of L keep their relative accuracy besides.
    Wide last = 0;
    for (const auto& series : qs_) last = std::max(last, Wide(abs(series[order])));
    for (std::size_t i = 0; i < 3; ++i) {
      if (L_[i] != 0) last = std::max(last, Wide(abs(Ls_[i][order] / L_norm())));
    }
    radius_ = last == 0 ? Wide("1e400") : Wide(pow(Wide("1e-45") / last, Wide(1) / Wide(order)));
  }

  [[nodiscard]] Wide L_norm() const { return sqrt(L_[0] * L_[0] + L_[1] * L_[1] + L_[2] * L_[2]); }

  void step(const Wide& h) {
    const auto sum = [&h](const std::array<Wide, order + 1>& series) {
      Wide value = series[order];
      for (std::size_t n = order; n-- > 0;) value = value * h + series[n];
      return value;
    };
    for (std::size_t i = 0; i < 3; ++i) L_[i] = sum(Ls_[i]);
    for (std::size_t i = 0; i < 4; ++i) q_[i] = sum(qs_[i]);
    t_ += h;
  }

  Wide t_ = 0;
  std::array<Wide, 3> L_, inverse_I_;
  WideQuaternion q_;
  std::array<std::array<Wide, order + 1>, 3> Ls_, omega_;
  std::array<std::array<Wide, order + 1>, 4> qs_;
  Wide radius_;
};

}  // namespace bookspin
