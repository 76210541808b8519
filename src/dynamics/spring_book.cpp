#include "dynamics/spring_book.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "dynamics/composition.h"
#include "dynamics/integrators.h"

namespace bookspin {

SpringBook::SpringBook(const BookOptions& options)
    : stiffness_(options.stiffness),
      particle_mass_(options.particle_mass),
      damping_(options.damping * 2.0 * std::sqrt(options.stiffness * options.particle_mass)),
      step_(step_of(options.integrator, &IntegratorInfo::spring_step)),
      normalization_{options.normalize_every},
      rest_length_(),
      x_W_(body_of(options).corners_B) {
  std::size_t pair = 0;
  for (int i = 0; i < 8; ++i) {
    v_W_.col(i) = options.omega_W.cross(x_W_.col(i));
    for (int j = i + 1; j < 8; ++j) {
      rest_length_[pair++] = (x_W_.col(i) - x_W_.col(j)).norm();
    }
  }
  F_W_ = forces(x_W_, v_W_).F_W;
  start_energy_ = kinetic_energy();
}

SpringForces SpringBook::forces(const Corners& x_W, const Corners& v_W) const {
  SpringForces result{Corners::Zero(), 0.0};
  std::size_t pair = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      const Eigen::Vector3d d = x_W.col(i) - x_W.col(j);
      const double length = d.norm();
      const double r = length - rest_length_[pair++];
      result.elastic_energy += 0.5 * stiffness_ * r * r;
      if (length > 0.0) {
        const Eigen::Vector3d xhat = d / length;
        const Eigen::Vector3d F = -(damping_ * xhat.dot(v_W.col(i) - v_W.col(j)) + stiffness_ * r) * xhat;
        result.F_W.col(i) += F;
        result.F_W.col(j) -= F;
      }
    }
  }
  return result;
}

void SpringBook::step(double h) {
  (this->*step_)(h);
  if (normalization_.due()) {
    normalize(step_ == &SpringBook::explicit_euler_step ? old_elastic_energy_ : elastic_energy());
  }
}

void SpringBook::explicit_euler_step(double h) {
  const SpringForces old = forces(x_W_, v_W_);
  x_W_ += h * v_W_;
  v_W_ += (h / particle_mass_) * old.F_W;
  old_elastic_energy_ = old.elastic_energy;
}

void SpringBook::semi_implicit_euler_step(double h) {
  v_W_ += (h / particle_mass_) * forces(x_W_, v_W_).F_W;
  x_W_ += h * v_W_;
}

void SpringBook::verlet_step(double h) {
  v_W_ += (0.5 * h / particle_mass_) * F_W_;
  x_W_ += h * v_W_;
  F_W_ = forces(x_W_, v_W_).F_W;
  v_W_ += (0.5 * h / particle_mass_) * F_W_;
}

void SpringBook::rk4_step(double h) {
  const auto acceleration = [this](const Corners& x_W, const Corners& v_W) -> Corners {
    return forces(x_W, v_W).F_W / particle_mass_;
  };
  const Corners a1 = acceleration(x_W_, v_W_);
  const Corners v2 = v_W_ + 0.5 * h * a1;
  const Corners a2 = acceleration(x_W_ + 0.5 * h * v_W_, v2);
  const Corners v3 = v_W_ + 0.5 * h * a2;
  const Corners a3 = acceleration(x_W_ + 0.5 * h * v2, v3);
  const Corners v4 = v_W_ + h * a3;
  const Corners a4 = acceleration(x_W_ + h * v3, v4);
  x_W_ += (h / 6.0) * (v_W_ + 2.0 * (v2 + v3) + v4);
  v_W_ += (h / 6.0) * (a1 + 2.0 * (a2 + a3) + a4);
}

void SpringBook::composition8_step(double h) {
  for (const double fraction : kahan_li_order_8) verlet_step(fraction * h);
}

void SpringBook::normalize(double elastic_energy) {
  const double kinetic = kinetic_energy();
  const double floor = 0.1 * start_energy_;
  const double wanted = start_energy_ - elastic_energy;
  if (wanted < floor) ++floor_hits_;
  if (kinetic > 0.0) v_W_ *= std::sqrt(std::max(floor, wanted) / kinetic);
  const Eigen::Vector3d mean_position = x_W_.rowwise().mean();
  const Eigen::Vector3d mean_velocity = v_W_.rowwise().mean();
  x_W_.colwise() -= mean_position;
  v_W_.colwise() -= mean_velocity;
}

Eigen::Vector3d SpringBook::angular_momentum_W() const {
  Eigen::Vector3d L_W = Eigen::Vector3d::Zero();
  for (int i = 0; i < 8; ++i) L_W += particle_mass_ * x_W_.col(i).cross(v_W_.col(i));
  return L_W;
}

double SpringBook::kinetic_energy() const {
  return 0.5 * particle_mass_ * v_W_.squaredNorm();
}

}  // namespace bookspin
