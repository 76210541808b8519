#include "dynamics/spring_book.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace bookspin {

SpringBook::SpringBook(const BookOptions& options)
    : stiffness_(options.stiffness),
      particle_mass_(options.particle_mass),
      damping_(options.damping * 2.0 * std::sqrt(options.stiffness * options.particle_mass)),
      normalize_every_(options.normalize ? options.normalize_every : 0),
      rest_length_(),
      x_W_(corners_at_rest(options.size)) {
  std::size_t pair = 0;
  for (int i = 0; i < 8; ++i) {
    v_W_.col(i) = options.omega_W.cross(x_W_.col(i));
    for (int j = i + 1; j < 8; ++j) {
      rest_length_[pair++] = (x_W_.col(i) - x_W_.col(j)).norm();
    }
  }
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
  const SpringForces old = forces(x_W_, v_W_);
  x_W_ += h * v_W_;
  v_W_ += (h / particle_mass_) * old.F_W;
  ++steps_;
  if (normalize_every_ > 0 && steps_ % normalize_every_ == 0) normalize(old.elastic_energy);
}

void SpringBook::normalize(double elastic_energy_before) {
  const double kinetic = kinetic_energy();
  const double floor = 0.1 * start_energy_;
  const double wanted = start_energy_ - elastic_energy_before;
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

double SpringBook::kinetic_energy() const { return 0.5 * particle_mass_ * v_W_.squaredNorm(); }

}  // namespace bookspin
