// How large a step the springs bear.
//
// At rest x'' = -(c / k) K x' - K x: all 28 springs share c / k, so the damping matrix is the stiffness matrix's
// multiple, and each mode of K (eigenvalue lambda = mu k / m) is an oscillator of its own, s^2 + (c / k) lambda s +
// lambda = 0. A method is stable at step h when the matrix by which one of its steps multiplies (x, v) of a mode has
// spectral radius at most 1, for every mode. All limits are proportional to sqrt(m / k), the only time there is.
// Undamped explicit Euler has sqrt(1 + h^2 lambda) > 1 at any step: not a limit but a rate, about h lambda / 2.
#pragma once

#include <Eigen/Core>

#include "dynamics/book.h"

namespace bookspin {

using Matrix24 = Eigen::Matrix<double, 24, 24>;

// K m / k on the positions, corner by corner.
[[nodiscard]] Matrix24 stiffness_matrix(const Eigen::Vector3d& size);

struct SpringModes {
  Eigen::VectorXd mu;       // of K m / k, ascending: 24, of which six are 0 (the rigid motions)
  Eigen::MatrixXd vectors;  // column by column, |v| = 1, corner by corner
};
[[nodiscard]] SpringModes spring_modes(const Eigen::Vector3d& size);

// Largest stable step, from the modes; 0 when there is none, or when no matrix of the integrator's step is known here.
[[nodiscard]] double predicted_step_limit(const BookOptions& options);

// Where between `low` and `high` holds(x) ceases to be true.
template <class Holds>
[[nodiscard]] double bisect(double low, double high, int halvings, Holds&& holds) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace bookspin
