#include "dynamics/rigid_motion.h"

#include <utility>

#include "dynamics/integrators.h"
#include "dynamics/rigid_book.h"

namespace bookspin {

TorqueFree exact_motion(const BookOptions& options) {
  return TorqueFree::of_book(options.size, options.omega_W);
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

ExactBook::ExactBook(BookOptions options)
    : particle_mass_(std::exchange(options.particle_mass, 1.0)),
      body_(body_of(options)),
      motion_(exact_motion(options)),
      state_(motion_.at(0.0)) {}

}  // namespace bookspin
