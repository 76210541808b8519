// How large a step the springs bear.
//
// At rest x'' = -(c / k) K x' - K x: all 28 springs share c / k, so the damping matrix is the stiffness matrix's
// multiple, and each mode of K (eigenvalue lambda = mu k / m) is an oscillator of its own, s^2 + (c / k) lambda s +
// lambda = 0. A method is stable at step h when the matrix by which one of its steps multiplies (x, v) of a mode has
// spectral radius at most 1, for every mode. All limits are proportional to sqrt(m / k), the only time there is.
// Undamped explicit Euler has sqrt(1 + h^2 lambda) > 1 at any step: not a limit but a rate, about h lambda / 2.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "dynamics/integrators.h"
#include "dynamics/shape.h"
#include "report/draft.h"

namespace bookspin {
namespace {

using Matrix2 = Eigen::Matrix2d;

// What a step makes of (x, v) of the mode x'' = -gamma x' - lambda x; NaN when that is not known.
Matrix2 one_step(Integrator integrator, double lambda, double gamma, double h) {
  const auto matrix = [](double a, double b, double c, double d) { return Matrix2{{a, b}, {c, d}}; };
  const auto drift = [&](double t) { return matrix(1.0, t, 0.0, 1.0); };
  const auto kick = [&](double t) { return matrix(1.0, 0.0, -t * lambda, 1.0 - t * gamma); };
  const Matrix2 one = Matrix2::Identity();
  const Matrix2 hA = h * matrix(0.0, 1.0, -lambda, -gamma);
  switch (integrator) {
    case Integrator::explicit_euler:
      return one + hA;
    case Integrator::semi_implicit_euler:
      return drift(h) * kick(h);
    case Integrator::velocity_verlet:
      return kick(0.5 * h) * drift(h) * kick(0.5 * h);
    case Integrator::rk4:
      return one + hA * (one + hA / 2.0 * (one + hA / 3.0 * (one + hA / 4.0)));
    default:
      return Matrix2::Constant(std::nan(""));
  }
}

double spectral_radius(const Matrix2& M) {
  const double half_trace = 0.5 * M.trace();
  const double discriminant = half_trace * half_trace - M.determinant();
  return discriminant < 0.0 ? std::sqrt(M.determinant()) : std::abs(half_trace) + std::sqrt(discriminant);
}

bool linearly_stable(const BookOptions& options, const Eigen::VectorXd& mu_of_modes, double h) {
  const double k = options.stiffness;
  const double m = options.particle_mass;
  for (const double mu : mu_of_modes) {
    if (mu < 1e-9) continue;
    const double lambda = mu * k / m;
    const double gamma = options.damping * 2.0 * std::sqrt(k * m) / k * lambda;
    if (!(spectral_radius(one_step(options.integrator, lambda, gamma, h)) <= 1.0 + 1e-10)) return false;
  }
  return true;
}

// Stretched by more than a thousandth: far above what the slow turn does, far below where the springs' nonlinearity
// holds a growing vibration back (which it does: just beyond the limit some never explode).
bool keeps_shape(const BookOptions& options, double h, int steps) {
  SpringBook book(options);
  const Corners rest = body_of(options).corners_B;
  for (int n = 1; n <= steps; ++n) {
    book.step(h);
    if (n % 16 == 0 && !(stretch(book.corners_W(), rest) <= 1e-3)) return false;
  }
  return true;
}

struct StepLimit {
  Integrator integrator;
  double damping;
  double predicted, measured;  // steps, in units of sqrt(m / k)
};

// Measured by bisection on the program's own book: a step is too large when the shape is lost within so many steps.
std::vector<StepLimit> step_limits(bool quick) {
  const int steps = quick ? 1500 : 12000;
  std::vector<StepLimit> limits;
  for (const IntegratorInfo& row : integrators) {
    for (const double damping :
         quick ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.0, 0.1, 0.2, 0.5, 1.0, 2.0}) {
      if (!takes(Method::springs, damping > 0.0, row)) continue;
      BookOptions options{.integrator = row.id, .normalize_every = 0, .damping = damping, .stiffness = 1.0};
      const double predicted = predicted_step_limit(options);
      if (predicted == 0.0) continue;
      // Slow enough for explicit Euler's own gain of spin, h omega^2 a unit of time, not to count within these steps.
      options.omega_W = {1e-4, 0.7e-4, 0.4e-4};
      const double measured =
          bisect(0.8 * predicted, 1.25 * predicted, 14, [&](double h) { return keeps_shape(options, h, steps); });
      limits.push_back({row.id, damping, predicted, measured});
    }
  }
  return limits;
}

// The book of Figure 5 as the original program has it, with one step a frame of 0.1.
nlohmann::json one_step_a_frame(Draft& draft, const char* normalize) {
  const std::string expect =
      "expect=[{quantity='exploded', rises_to=1}, {quantity='stretch', at_most=1e9}, "
      "{quantity='angular_momentum_ratio', frame=899, at_most=1e9}]";
  const auto [clip, found] = draft.judge(
      {"fig05_unstable_x", "clip.time_per_frame=0.1", "clip.substeps=1", "clip.frames=900", normalize, expect});
  return {{"frames", clip.frames},
          {"explodes", found[0].met},
          {"frame", found[0].frame},
          {"stretch", found[1].found},
          {"momentum", found[2].found}};
}

}  // namespace

Matrix24 stiffness_matrix(const Eigen::Vector3d& size) {
  const Corners x = body_of({.size = size}).corners_B;
  Matrix24 K = Matrix24::Zero();
  for (Eigen::Index i = 0; i < 8; ++i) {
    for (Eigen::Index j = i + 1; j < 8; ++j) {
      const Eigen::Vector3d xhat = (x.col(i) - x.col(j)).normalized();
      const Eigen::Matrix3d along = xhat * xhat.transpose();
      K.block<3, 3>(3 * i, 3 * i) += along;
      K.block<3, 3>(3 * j, 3 * j) += along;
      K.block<3, 3>(3 * i, 3 * j) -= along;
      K.block<3, 3>(3 * j, 3 * i) -= along;
    }
  }
  return K;
}

SpringModes spring_modes(const Eigen::Vector3d& size) {
  const Eigen::SelfAdjointEigenSolver<Matrix24> solver(stiffness_matrix(size));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

double predicted_step_limit(const BookOptions& options) {
  const Eigen::VectorXd modes = spring_modes(options.size).mu;
  const auto stable = [&](double h) { return linearly_stable(options, modes, h); };
  const double natural = std::sqrt(options.particle_mass / options.stiffness);
  double h = 1e-4 * natural;
  if (!stable(h)) return 0.0;
  while (h < 1e3 * natural && stable(1.01 * h)) h *= 1.01;  // the first step, from below, that is not
  return bisect(h, 1.01 * h, 60, stable);
}

void stability(Draft& draft) {
  const std::vector<StepLimit> limits = step_limits(draft.effort.quick);
  Table table{{"integrator", "damping", "predicted", "measured", "measured / predicted - 1"}, {}};
  Plot plot{"damping, in units of critical damping of each spring", "largest stable step, in units of √(m/k)", false,
            true};
  plot.more = {"set format y '%g'", "set key inside right top"};
  const double unit = std::sqrt(BookOptions().particle_mass / BookOptions().stiffness);
  double worst = 0.0;
  double papers_limit = none, papers_measured = none, verlet_limit = none;
  for (const StepLimit& limit : limits) {
    const double off = limit.measured / limit.predicted - 1.0;
    worst = std::max(worst, std::abs(off));
    const std::string name(info_of(limit.integrator).name);
    table.rows.push_back({name, limit.damping, limit.predicted, limit.measured, off});
    if (&limit == limits.data() || limit.integrator != (&limit)[-1].integrator)
      add_predicted_and_measured(
          plot, name, pen_of({Method::springs, limit.integrator}), limits,
          [&](const StepLimit& other) { return other.integrator == limit.integrator; }, &StepLimit::damping);
    if (limit.integrator == Integrator::velocity_verlet) verlet_limit = limit.predicted * unit;
    if (limit.integrator == Integrator::explicit_euler && limit.damping == 1.0) {
      papers_limit = limit.predicted * unit;
      papers_measured = limit.measured * unit;
    }
  }
  draft.plot("step_limits", plot);
  draft.keep("step_limits", table);
  const Eigen::VectorXd mu = spring_modes(BookOptions().size).mu;
  draft.page["limits"] = {
      {"predicted", papers_limit},
      {"measured", papers_measured},
      {"worst", 100.0 * worst},
      {"k", BookOptions().stiffness},
      {"oscillators", (mu.array() > 1e-9).count()},
      {"verlet_times", verlet_limit / papers_limit},
      {"overdamped", std::sqrt(mu.maxCoeff())},  // c omega / (2 k), omega^2 = mu k / m, c = 2 sqrt(k m)
      {"one_step",
       {{"normalized", one_step_a_frame(draft, "book.0.normalize=true")},
        {"plain", one_step_a_frame(draft, "book.0.normalize=false")}}}};
}

}  // namespace bookspin
