#include "dynamics/rigid_motion.h"

#include <utility>

#include "dynamics/integrators.h"

namespace bookspin {

TorqueFree exact_motion(const BookOptions& options) {
  if (options.moments.x() == 0.0) return TorqueFree::of_book(options.size, options.omega_W);
  return {options.moments, Eigen::Quaterniond::Identity(), options.moments.cwiseProduct(options.omega_W)};
}

FreeBook::FreeBook(const BookOptions& options)
    : body_(body_of(options)),
      normalization_{options.normalize_every},
      state_{Eigen::Quaterniond::Identity(), body_.I_B.cwiseProduct(options.omega_W)},
      integrator_(options.integrator),
      steps_(step_of(options.integrator, &IntegratorInfo::rigid_steps)) {}

void FreeBook::step(double h, long n) {
  if (h != plan_.h) plan_ = rigid_plan(integrator_, body_.I_B, state_.L_B, h);
  steps_(state_, plan_, n, normalization_);
}

ExactBook::ExactBook(BookOptions options)
    : particle_mass_(std::exchange(options.particle_mass, 1.0)),
      body_(body_of(options)),
      motion_(exact_motion(options)),
      state_(motion_.at(0.0)) {}

}  // namespace bookspin
