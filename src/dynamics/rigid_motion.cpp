#include "dynamics/rigid_motion.h"

#include "dynamics/rigid_book.h"

namespace bookspin {

TorqueFree exact_motion(const BookOptions& options) {
  const Eigen::Vector3d I_B = principal_moments(options.size, 1.0);
  return {I_B, Eigen::Quaterniond::Identity(), I_B.cwiseProduct(options.omega_W)};
}

FreeBook::FreeBook(const BookOptions& options)
    : corners_B_(corners_at_rest(options.size)),
      I_B_(principal_moments(options.size, options.particle_mass)),
      state_{Eigen::Quaterniond::Identity(), I_B_.cwiseProduct(options.omega_W)},
      integrator_(options.integrator),
      step_(rigid_step(options.integrator)),
      normalize_every_(options.normalize ? options.normalize_every : 0),
      step_moments_(I_B_) {}

void FreeBook::step(double h) {
  if (h != h_) {
    step_moments_ = step_moments(integrator_, I_B_, state_.L_B, h);
    h_ = h;
  }
  step_(state_, step_moments_, h);
  ++steps_;
  if (normalize_every_ > 0 && steps_ % normalize_every_ == 0) normalize(state_.q_WB);
}

ExactBook::ExactBook(const BookOptions& options)
    : corners_B_(corners_at_rest(options.size)),
      particle_mass_(options.particle_mass),
      I_B_(principal_moments(options.size, 1.0)),
      motion_(exact_motion(options)),
      state_(motion_.at(0.0)) {}

}  // namespace bookspin
