#include <cmath>

#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
#include "report/stability.h"

namespace bookspin {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

// Distances from the axis of omega: what the centrifugal force pulls at.
Vector24 from_axis(const Vector24& x, const Eigen::Vector3d& omega) {
  const Eigen::Vector3d axis = omega.normalized();
  Vector24 result;
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = x.segment<3>(3 * i);
    result.segment<3>(3 * i) = corner - axis * axis.dot(corner);
  }
  return result;
}

// The turning book's springs start at rest, so that each mode swings by a = omega^2 f / lambda about its balance, f the
// centrifugal pull on it; explicit Euler swells that by sqrt(1 + h^2 lambda) a step. The time until a corner may have
// moved by half a diagonal.
double predicted_undamped_explosion(const BookOptions& options, double h) {
  const SpringModes modes = spring_modes(options.size);
  const Corners rest = body_of(options).corners_B;
  const Vector24 pull = modes.vectors.transpose() * from_axis(rest.reshaped(), options.omega_W);
  const auto moved = [&](double t) {
    Eigen::Matrix<double, 8, 1> distance = Eigen::Matrix<double, 8, 1>::Zero();
    for (int mode = 0; mode < 24; ++mode) {
      const double lambda = modes.mu(mode) * options.stiffness / options.particle_mass;
      if (lambda < 1e-9) continue;
      const double amplitude = std::abs(pull(mode)) * options.omega_W.squaredNorm() / lambda *
                               std::exp(std::log1p(h * h * lambda) / (2.0 * h) * t);
      for (Eigen::Index i = 0; i < 8; ++i) distance(i) += amplitude * modes.vectors.col(mode).segment<3>(3 * i).norm();
    }
    return distance.maxCoeff();
  };
  double before = 0.0;
  double after = 1.0;
  while (moved(after) < 0.5 * options.size.norm()) after *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (before + after);
    (moved(middle) < 0.5 * options.size.norm() ? before : after) = middle;
  }
  return after;
}

// Damped, the book is always in balance: (K - m omega^2 P) u = m omega^2 P x, P taking the distance from the axis.
// Explicit Euler leaves the circle along its tangent, so that L grows by (1 + h^2 omega^2) a step: t = integral of d(ln
// L) / (h omega^2), L = I(omega) omega, until a corner is twice as far as at rest, or the springs can bear no more
// spin. A stiff book's I is constant, and t = 1 / (2 h omega^2).
double predicted_damped_explosion(const BookOptions& options, double h) {
  const Matrix24 K = options.stiffness / options.particle_mass * stiffness_matrix(options.size);
  const Corners rest = body_of(options).corners_B;
  const Vector24 x = rest.reshaped();
  Matrix24 P;
  for (int d = 0; d < 24; ++d) P.col(d) = from_axis(Vector24::Unit(d), options.omega_W);
  double t = 0.0;
  double log_L = std::nan("");
  double omega = options.omega_W.norm();
  while (true) {
    const Vector24 u = (K - omega * omega * P).completeOrthogonalDecomposition().solve(omega * omega * (P * x));
    const Vector24 now = x + u;
    const double next = std::log((P * now).squaredNorm() * omega);
    const Corners corners = now.reshaped(3, 8);
    if (next < log_L || extent(corners, rest) > 2.0) return t;
    if (!std::isnan(log_L)) t += (next - log_L) / (h * omega * omega);
    log_L = next;
    omega *= 1.002;
  }
}

// Steps until a corner is twice as far as at rest. -1: not within `most`.
long steps_to_explosion(const BookOptions& options, double h, long most) {
  SpringBook book(options);
  const Corners rest = body_of(options).corners_B;
  for (long n = 1; n <= most; ++n) {
    book.step(h);
    if (n % 4 == 0 && !(extent(book.corners_W(), rest) <= 2.0)) return n;
  }
  return -1;
}

}  // namespace

// Frames of 0.1, books that spin at 0.6 about z (Figure 7) and 0.7 about x (Figure 8).
Table time_to_explosion(const Effort& effort) {
  Table table{
      "time_to_explosion",
      {"substeps a frame", "springs", "predicted time", "measured time", "measured / predicted", "measured frames"},
      {}};
  const double most_steps = effort.quick ? 2e5 : 2e7;
  for (const int substeps :
       effort.quick ? std::vector<int>{4, 16} : std::vector<int>{3, 6, 12, 25, 50, 100, 200, 400, 1000}) {
    const double h = 0.1 / substeps;
    for (const bool damped : {true, false}) {
      BookOptions options = unnormalized_springs(10.0, damped ? 1.0 : 0.0, Integrator::explicit_euler);
      options.omega_W = damped ? Eigen::Vector3d(0.0, 0.0, 0.6) : Eigen::Vector3d(0.7, 0.0, 0.0);
      const double predicted =
          damped ? predicted_damped_explosion(options, h) : predicted_undamped_explosion(options, h);
      const double needed = 1.5 * predicted / h;
      const long steps =
          needed > most_steps ? -1 : steps_to_explosion(options, h, 4 * static_cast<long>(needed) + 1000);
      const double t = steps < 0 ? std::nan("") : static_cast<double>(steps) * h;
      table.rows.push_back(
          {static_cast<double>(substeps), damped ? "damped" : "undamped", predicted, t, t / predicted, t / 0.1});
    }
  }
  return table;
}

}  // namespace bookspin
