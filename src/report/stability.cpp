#include "report/stability.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "dynamics/integrators.h"
#include "dynamics/shape.h"
#include "report/draft.h"
#include "scene/judge.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

using Matrix2 = Eigen::Matrix2d;

// What a step makes of (x, v) of the mode x'' = -gamma x' - lambda x.
Matrix2 one_step(Integrator integrator, double lambda, double gamma, double h) {
  Matrix2 A;
  A << 0.0, 1.0, -lambda, -gamma;
  const Matrix2 one = Matrix2::Identity();
  Matrix2 M;
  switch (integrator) {
    case Integrator::explicit_euler:
      return one + h * A;
    case Integrator::semi_implicit_euler:
      M << 1.0 - h * h * lambda, h * (1.0 - h * gamma), -h * lambda, 1.0 - h * gamma;
      return M;
    case Integrator::rk4: {
      const Matrix2 hA = h * A;
      return one + hA * (one + hA / 2.0 * (one + hA / 3.0 * (one + hA / 4.0)));
    }
    case Integrator::velocity_verlet: {
      const double w = h * h * lambda;
      M << 1.0 - w / 2.0, h, -h * lambda * (1.0 - w / 4.0), 1.0 - w / 2.0;
      return M;
    }
    default:
      throw std::invalid_argument(std::string(info_of(integrator).name) + ": its step of a linear mode is not known");
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
    if (spectral_radius(one_step(options.integrator, lambda, gamma, h)) > 1.0 + 1e-10) return false;
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

}  // namespace

// K m / k on the positions, corner by corner.
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
  const double natural = std::sqrt(options.particle_mass / options.stiffness);
  double stable = 1e-4 * natural;
  double unstable = 0.0;
  // The first step, from below, that is not stable; then bisection.
  while (unstable == 0.0) {
    const double h = 1.01 * stable;
    (linearly_stable(options, modes, h) ? stable : unstable) = h;
    if (stable > 1e3 * natural) break;
  }
  for (int i = 0; i < 60 && unstable > 0.0; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (linearly_stable(options, modes, middle) ? stable : unstable) = middle;
  }
  return stable;
}

double measured_step_limit(const BookOptions& options, double from, double to, int steps) {
  BookOptions slow = options;
  // Slow enough for explicit Euler's own gain of spin, h omega^2 a unit of time, not to count within these steps.
  slow.omega_W = Eigen::Vector3d(1.0, 0.7, 0.4) * (1e-4 * std::sqrt(options.stiffness / options.particle_mass));
  double stable = from;
  double unstable = to;
  for (int i = 0; i < 14; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (keeps_shape(slow, middle, steps) ? stable : unstable) = middle;
  }
  return 0.5 * (stable + unstable);
}

namespace {

struct StepLimit {
  double damping;
  Integrator integrator;
  double predicted, measured;  // steps, in units of sqrt(m / k)
};

// Composition 8 has no limit that a run would show: its first instabilities are narrow and slow.
std::vector<StepLimit> step_limits(bool quick) {
  const int steps = quick ? 1500 : 12000;
  std::vector<StepLimit> limits;
  for (const double damping :
       quick ? std::vector<double>{0.0, 1.0} : std::vector<double>{0.0, 0.1, 0.2, 0.5, 1.0, 2.0}) {
    for (const IntegratorInfo& row : integrators) {
      if (!takes(Method::springs, damping > 0.0, row) || row.id == Integrator::composition8) continue;
      if (row.id == Integrator::explicit_euler && damping == 0.0) continue;  // no step is stable
      BookOptions options;
      options.stiffness = 1.0;  // and mass 1: the unit of time is sqrt(m / k)
      options.damping = damping;
      options.integrator = row.id;
      options.normalize_every = 0;
      const double predicted = predicted_step_limit(options);
      limits.push_back(
          {damping, row.id, predicted, measured_step_limit(options, 0.8 * predicted, 1.25 * predicted, steps)});
    }
  }
  return limits;
}

// The vibration's energy grows by (1 + h^2 lambda) a step; its velocity, by the root. The fastest mode soon leads.
Table undamped_euler_growth(bool quick) {
  Table table{{"step", "predicted rate", "measured rate", "measured / predicted"}, {}};
  const double largest = spring_modes(BookOptions().size).mu.maxCoeff();
  for (const double h :
       quick ? std::vector<double>{0.1 / 6.0} : std::vector<double>{0.05, 0.1 / 6.0, 0.005, 0.001, 0.0002}) {
    BookOptions options = options_for({Method::springs, Integrator::explicit_euler}, BookOptions());
    options.omega_W = {0.01, 0.007, 0.004};
    const double lambda = largest * options.stiffness / options.particle_mass;
    const double predicted = std::log1p(h * h * lambda) / (2.0 * h);
    // From when the fastest mode outweighs all others until the springs are far from linear.
    SpringBook book(options);
    const double period = 2.0 * std::numbers::pi / std::sqrt(lambda);
    const auto elastic_mean = [&] {  // over a period
      double sum = 0.0;
      const int n = static_cast<int>(std::ceil(period / h));
      for (int i = 0; i < n; ++i) {
        book.step(h);
        sum += book.elastic_energy();
      }
      return sum / n;
    };
    double t = 0.0;
    std::vector<std::pair<double, double>> samples;  // t, ln(energy) / 2
    const double span = std::ceil(period / h) * h;
    for (double energy = 0.0; energy < 3e-2 && t < 1e6; t += span) {
      energy = elastic_mean();
      if (energy > 1e-3) samples.emplace_back(t, 0.5 * std::log(energy));
    }
    const double measured =
        (samples.back().second - samples.front().second) / (samples.back().first - samples.front().first);
    table.rows.push_back({h, predicted, measured, measured / predicted});
  }
  return table;
}

// The book of Figure 5 as the original program has it, with one step a frame of 0.1: normalized, and not.
nlohmann::json one_step_a_frame(const std::filesystem::path& project) {
  const auto run = [&](bool normalize) {
    const std::vector<std::string> overrides{
        "clip.time_per_frame=0.1", "clip.substeps=1", "clip.frames=900", fmt::format("book.0.normalize={}", normalize),
        "expect=[{quantity=\"exploded\", rises_to=1}, {quantity=\"stretch\", at_most=1e9}, "
        "{quantity=\"angular_momentum_ratio\", frame=899, at_most=1e9}]"};
    const Scene scene = load_scene(project / "videos" / "fig05_unstable_x.toml", overrides);
    const std::vector<Verdict> found = judge(scene, simulate(scene));
    return nlohmann::json{{"frames", scene.clip.frames},
                          {"explodes", found[0].met},
                          {"frame", found[0].frame},
                          {"stretch", found[1].found},
                          {"momentum", found[2].found}};
  };
  return {{"normalized", run(true)}, {"plain", run(false)}};
}

}  // namespace

void stability(Draft& draft) {
  const std::vector<StepLimit> limits = step_limits(draft.effort.quick);
  Table table{{"integrator", "damping", "predicted", "measured", "measured / predicted - 1"}, {}};
  Plot plot{"damping, in units of critical damping of each spring", "largest stable step, in units of √(m/k)", false,
            true};
  plot.more = {"set format y '%g'", "set key inside right top"};
  double worst = 0.0;
  const double unit = std::sqrt(BookOptions().particle_mass / BookOptions().stiffness);
  nlohmann::json paper;
  double papers_limit = std::nan("");
  double verlet_limit = std::nan("");
  for (const IntegratorInfo& row : integrators) {
    const Pen pen = pen_of({Method::springs, row.id});
    Series predicted{std::string(row.name), {}, pen, Mark::line};
    Series measured{"  measured", {}, pen, Mark::points};
    for (const StepLimit& limit : limits) {
      if (limit.integrator != row.id) continue;
      const double off = limit.measured / limit.predicted - 1.0;
      worst = std::max(worst, std::abs(off));
      table.rows.push_back({std::string(row.name), limit.damping, limit.predicted, limit.measured, off});
      predicted.points.emplace_back(limit.damping, limit.predicted);
      measured.points.emplace_back(limit.damping, limit.measured);
      if (row.id == Integrator::velocity_verlet) verlet_limit = limit.predicted * unit;
      if (row.id == Integrator::explicit_euler && limit.damping == 1.0) {
        papers_limit = limit.predicted * unit;
        paper["predicted"] = papers_limit;
        paper["measured"] = limit.measured * unit;
      }
    }
    if (measured.points.empty()) continue;
    plot.series.push_back(std::move(predicted));
    plot.series.push_back(std::move(measured));
  }
  draft.plot("step_limits", plot);
  draft.keep("step_limits", table);
  const Eigen::VectorXd mu = spring_modes(BookOptions().size).mu;
  paper["worst"] = 100.0 * worst;
  paper["k"] = BookOptions().stiffness;
  paper["oscillators"] = (mu.array() > 1e-9).count();
  paper["verlet_times"] = verlet_limit / papers_limit;
  paper["overdamped"] = std::sqrt(mu.maxCoeff());  // c omega / (2 k), omega^2 = mu k / m, c = 2 sqrt(k m)
  paper["one_step"] = one_step_a_frame(draft.order.project);
  draft.page["limits"] = std::move(paper);
  draft.say("growth of the undamped vibration");
  draft.keep("undamped_euler_growth", undamped_euler_growth(draft.effort.quick));
}

}  // namespace bookspin
