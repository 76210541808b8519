#include "dynamics/rigid_motion.h"

#include "dynamics/integrators.h"
#include "dynamics/rigid_book.h"

namespace bookspin {
namespace {

Body body_of_unit_particles(BookOptions options) {
  options.particle_mass = 1.0;
  return body_of(options);
}

}  // namespace

TorqueFree exact_motion(const BookOptions& options) {
  const Eigen::Vector3d I_B = body_of_unit_particles(options).I_B;
  return {I_B, Eigen::Quaterniond::Identity(), I_B.cwiseProduct(options.omega_W)};
}

FreeBook::FreeBook(const BookOptions& options)
    : body_(body_of(options)),
      normalization_{options.normalize_every},
      state_{Eigen::Quaterniond::Identity(), body_.I_B.cwiseProduct(options.omega_W)},
      integrator_(options.integrator),
      step_(step_of(options.integrator, &IntegratorInfo::rigid_step)) {}

void FreeBook::step(double h) {
  if (h != h_) {
    step_moments_ = step_moments(integrator_, body_.I_B, state_.L_B, h);
    h_ = h;
  }
  step_(state_, step_moments_, h);
  if (normalization_.due()) normalize(state_.q_WB);
}

ExactBook::ExactBook(const BookOptions& options)
    : body_(body_of_unit_particles(options)),
      particle_mass_(options.particle_mass),
      motion_(exact_motion(options)),
      state_(motion_.at(0.0)) {}

}  // namespace bookspin
