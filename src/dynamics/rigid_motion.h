// The rigid book by the methods beyond the paper's: stepped on (q_WB, L_B), or in closed form.
//
// Both give corners, angular momentum and energy of their own state, so that what a method loses is seen.
// FreeBook: any integrator with a rigid step (integrators.h; another throws std::invalid_argument); normalization is
// q = q / |q|, every n-th step.
// ExactBook: the closed form (torque_free.h) at the time it was last moved to; nothing accumulates. The motion does not
// depend on the particles' mass and is computed with 1. Throws nothing for a size in 1e-6 ... 1e6 and a finite omega_W.
#pragma once

#include "dynamics/book.h"
#include "dynamics/rigid_steps.h"
#include "dynamics/torque_free.h"

namespace bookspin {

// The exact motion of particles of mass 1: every method's referee.
[[nodiscard]] TorqueFree exact_motion(const BookOptions& options);

class FreeBook {
 public:
  explicit FreeBook(const BookOptions& options);

  void step(double h, long n = 1);  // h: unit of time; n such steps

  [[nodiscard]] const Eigen::Quaterniond& q_WB() const { return state_.q_WB; }
  [[nodiscard]] const Eigen::Vector3d& L_B() const { return state_.L_B; }
  [[nodiscard]] Corners corners_W() const { return state_.q_WB.toRotationMatrix() * body_.corners_B; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const { return state_.q_WB.toRotationMatrix() * state_.L_B; }
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * state_.L_B.cwiseProduct(state_.L_B.cwiseQuotient(body_.I_B)).sum();
  }

 private:
  Body body_;
  Normalization normalization_;
  RigidState state_;
  Integrator integrator_;
  RigidSteps steps_;
  RigidPlan plan_;
};

class ExactBook {
 public:
  explicit ExactBook(BookOptions options);

  void move_to(double t) { state_ = motion_.at(t); }  // t: unit of time, from the start

  [[nodiscard]] const Eigen::Quaterniond& q_WB() const { return state_.q_WB; }
  [[nodiscard]] Corners corners_W() const { return state_.q_WB.toRotationMatrix() * body_.corners_B; }
  [[nodiscard]] Eigen::Vector3d angular_momentum_W() const {
    return particle_mass_ * (state_.q_WB.toRotationMatrix() * state_.L_B);
  }
  [[nodiscard]] double kinetic_energy() const {
    return 0.5 * particle_mass_ * state_.L_B.cwiseProduct(state_.L_B.cwiseQuotient(body_.I_B)).sum();
  }

 private:
  double particle_mass_;
  Body body_;  // of particles of mass 1
  TorqueFree motion_;
  RigidState state_;
};

}  // namespace bookspin
