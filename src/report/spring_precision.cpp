#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "dynamics/rigid_motion.h"
#include "report/draft.h"
#include "report/odeint.h"
#include "report/stability.h"

// Speed against error of the springs: the farthest that a corner is from where it should be, in half diagonals of the
// book, against the springs' own motion (data/reference/ref_springs.txt) and against the rigid body's.

namespace bookspin {
namespace {

using State = std::array<double, 48>;  // positions, velocities
using ConstCorners = Eigen::Map<const Corners>;
using Motion = std::vector<Corners>;  // one a sample

struct SpringSystem {
  SpringBook book;  // for its forces
  double particle_mass;

  void operator()(const State& s, State& d, double /*t*/) const {
    const Corners x = ConstCorners(s.data());
    const Corners v = ConstCorners(s.data() + 24);
    Eigen::Map<Corners>(d.data()) = v;
    Eigen::Map<Corners>(d.data() + 24) = book.forces(x, v).F_W / particle_mass;
  }
};

Corners corners_of(const auto& book) {
  return book.corners_W();
}
Corners corners_of(const State& state) {
  return ConstCorners(state.data());
}

double farthest(const Corners& a, const Corners& b, const BookOptions& options) {
  return (a - b).colwise().norm().maxCoeff() / body_of(options).reach;
}

// The motion of ref_springs.txt: k = 10, m = 1, the unit of time about one turn in six.
BookOptions reference_options() {
  BookOptions options;
  const Eigen::Vector3d I_B = body_of(options).I_B;
  options.omega_W = {1.0, 1e-3 * I_B.x() / I_B.y(), 5e-4 * I_B.x() / I_B.z()};
  options.normalize_every = 0;
  options.damping = 0.0;
  return options;
}

BookOptions book_of_case_a(double stiffness) {
  BookOptions book;
  book.stiffness = stiffness;
  book.particle_mass = 0.5;
  book.omega_W = Eigen::Vector3d(1.0, 1e-3, 5e-4).cwiseQuotient(body_of(book).I_B);
  book.particle_mass = 1.0;
  return book;
}

Motion read_motion(const std::filesystem::path& file) {
  std::ifstream in(file);
  Motion motion;
  for (std::array<double, 48> row; true;) {
    for (double& number : row) in >> number;
    if (!in) break;
    motion.emplace_back(ConstCorners(row.data()));
  }
  if (motion.empty()) throw std::runtime_error(file.string() + ": cannot be read");
  return motion;
}

Motion rigid_motion(const BookOptions& options, const Course& course) {
  const TorqueFree motion = exact_motion(options);
  const Corners rest = body_of(options).corners_B;
  Motion x;
  for (int i = 1; i <= course.samples; ++i)
    x.push_back(motion.at(i * course.interval()).q_WB.toRotationMatrix() * rest);
  return x;
}

Motion spring_motion(const BookOptions& options, const Course& course, double h) {
  Stepped runner(SpringBook(options), options.integrator, course.interval(),
                 static_cast<long>(std::ceil(course.interval() / h)));
  Motion x;
  for (int i = 0; i < course.samples; ++i) {
    (void)runner.to(i);
    x.push_back(runner.state().corners_W());
  }
  return x;
}

void against_their_own_motion(const Motion& expected, const Effort& effort, Runs& runs) {
  const Course course{static_cast<int>(expected.size()), 200.0};
  constexpr double fewest = 4.0;
  const BookOptions options = reference_options();
  const auto error = [&](const auto& book, int i) {
    return farthest(corners_of(book), expected[static_cast<std::size_t>(i)], options);
  };
  for (const Solver& solver : spring_solvers())
    climb_steps(Problem::springs, solver, options, course, fewest, effort, runs, error);
  const SpringSystem system{SpringBook(options), options.particle_mass};
  State start{};
  Eigen::Map<Corners>(start.data()) = system.book.corners_W();
  Eigen::Map<Corners>(start.data() + 24) = system.book.velocities_W();
  climb_odeint(Problem::springs, Method::springs, start, system, course, fewest, 0.01, effort, runs, error);
}

void against_the_rigid_body(const Course& course, const Effort& effort, Runs& runs) {
  std::vector<Solver> solvers = spring_solvers();
  solvers.insert(solvers.begin(), papers_springs);
  for (const auto& [problem, stiffness] :
       {std::pair{Problem::soft_springs, 10.0}, std::pair{Problem::stiff_springs, 1000.0}}) {
    const BookOptions options = book_of_case_a(stiffness);
    const Motion rigid = rigid_motion(options, course);
    for (const Solver& solver : solvers) {
      climb_steps(problem, solver, options, course, 16.0, effort, runs, [&](const auto& book, int i) {
        return farthest(corners_of(book), rigid[static_cast<std::size_t>(i)], options);
      });
    }
  }
}

// The book of case a under three models, at the step of the paper's program. Each model's own motion is computed by a
// method and step far more accurate than what is shown.
constexpr double papers_step = 0.1 / 6.0;

std::vector<ModelError> model_errors(const Course& course, bool quick) {
  std::vector<ModelError> errors;
  for (const double stiffness : quick ? std::vector<double>{10.0} : std::vector<double>{10.0, 100.0, 1000.0}) {
    const BookOptions book = book_of_case_a(stiffness);
    const Motion rigid = rigid_motion(book, course);
    const auto largest = [&](const Motion& a, const Motion& b) {
      double result = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = farthest(a[i], b[i], book);
        if (!(error < 1e3)) return std::numeric_limits<double>::infinity();
        result = std::max(result, error);
      }
      return result;
    };
    const auto add = [&](bool damped, bool normalized, Integrator integrator) {
      BookOptions options = book;
      options.damping = damped ? 1.0 : 0.0;
      options.normalize_every = normalized ? 1 : 0;
      options.integrator = damped ? Integrator::rk4 : Integrator::composition8;
      const Motion own =
          spring_motion(options, course, damped ? 0.02 / std::sqrt(stiffness) : 0.1 * std::sqrt(10.0 / stiffness));
      options.integrator = integrator;
      const Motion x = spring_motion(options, course, papers_step);
      errors.push_back(
          {stiffness, damped, normalized, integrator, largest(x, own), largest(own, rigid), largest(x, rigid)});
    };
    add(false, false, Integrator::velocity_verlet);
    add(true, false, Integrator::explicit_euler);
    add(true, true, Integrator::explicit_euler);
  }
  return errors;
}

Table model_error_table(const std::vector<ModelError>& errors) {
  Table table{{"stiffness", "springs", "integrator", "integration error", "model error", "all: from the rigid motion"},
              {}};
  const auto shown = [](double error) { return std::isfinite(error) ? Cell(error) : Cell("exploded"); };
  for (const ModelError& e : errors) {
    table.rows.push_back({e.stiffness,
                          !e.damped      ? "undamped"
                          : e.normalized ? "damped and normalized"
                                         : "damped",
                          std::string(info_of(e.integrator).name), shown(e.integration), shown(e.model), shown(e.all)});
  }
  return table;
}

}  // namespace

void spring_precision(Draft& draft) {
  Effort effort = draft.effort;
  effort.most_evaluations *= 2;
  effort.repeats = 1;
  draft.say("their own motion");
  against_their_own_motion(read_motion(draft.order.project / "data" / "reference" / "ref_springs.txt"), effort,
                           draft.runs);
  draft.keep("cheapest_springs", cheapest_table(draft.runs, Problem::springs));
  draft.plot("work_precision_springs",
             work_precision_plot(draft.runs, {Problem::springs},
                                 "largest error, half diagonals, from the springs' own motion", "1e-11"));

  draft.say("the rigid motion");
  const Course course{60, effort.quick ? 100.0 : 600.0};
  against_the_rigid_body(course, effort, draft.runs);
  Plot plot = work_precision_plot(draft.runs, {Problem::soft_springs, Problem::stiff_springs},
                                  "largest distance, half diagonals, from the rigid motion", "1e-5");
  const auto floor_of = [&](Problem problem, const char* k) {  // where the undamped springs level out
    const Run* run = finest_run(draft.runs, problem, {Method::springs, Integrator::composition8});
    if (run == nullptr) return std::nan("");
    plot.more.push_back(fmt::format("set label 'k = {}' at graph 0.99, first {} right offset 0,0.7", k, run->error));
    return run->error;
  };
  const double soft = floor_of(Problem::soft_springs, "10");
  const double stiff = floor_of(Problem::stiff_springs, "1000");
  draft.plot("work_precision_springs_rigid", plot);
  draft.keep("runs", runs_table(draft.runs));

  draft.say("the model's error");
  draft.model_errors = model_errors(course, effort.quick);
  draft.keep("spring_model_error", model_error_table(draft.model_errors));
  nlohmann::json stiffer = nlohmann::json::array();  // what ten times the stiffness makes of the undamped model's error
  const ModelError* before = nullptr;
  for (const ModelError& e : draft.model_errors) {
    if (e.damped) continue;
    if (before != nullptr) {
      stiffer.push_back({{"from", before->stiffness}, {"to", e.stiffness}, {"by", before->model / e.model}});
    }
    before = &e;
  }
  const ModelError& undamped = draft.model_errors[0];
  const ModelError& damped = draft.model_errors[1];
  const Solver euler{Method::springs, Integrator::explicit_euler};
  const Solver verlet{Method::springs, Integrator::velocity_verlet};
  int verlet_runs = 0;
  int verlet_diverged = 0;
  double verlet_least = std::numeric_limits<double>::infinity();
  for (const Run& run : draft.runs) {
    if (run.problem != Problem::springs || run.solver != verlet) continue;
    ++verlet_runs;
    if (run.outcome == Outcome::finished) continue;
    ++verlet_diverged;
    verlet_least = std::min(verlet_least, run.setting);
  }
  const auto finest = [&](const Solver& solver) {
    const Run* run = finest_run(draft.runs, Problem::springs, solver);
    return nlohmann::json{{"h", run == nullptr ? std::nan("") : run->setting},
                          {"error", run == nullptr ? std::nan("") : run->error}};
  };
  const double verlet_limit = predicted_step_limit(options_for(verlet, BookOptions()));
  draft.page["springs"] = {{"any", winners(draft.runs, Problem::springs, false)},
                           {"euler", finest(euler)},
                           {"verlet", finest(verlet)},
                           {"verlet_runs", verlet_runs},
                           {"verlet_diverged", verlet_diverged},
                           {"verlet_least", verlet_least},
                           {"verlet_limit", verlet_limit},
                           {"soft", soft},
                           {"stiff", stiff},
                           {"paper_soft", best_error(draft.runs, Problem::soft_springs, papers_springs)},
                           {"paper_stiff", best_error(draft.runs, Problem::stiff_springs, papers_springs)},
                           {"turn", 2.0 * std::numbers::pi / reference_options().omega_W.norm()},
                           {"T", course.T},
                           {"h", papers_step},
                           {"stiffer", std::move(stiffer)},
                           {"damping_changes_more", damped.model > undamped.model},
                           {"damped_model", damped.model},
                           {"undamped_model", undamped.model}};
}

}  // namespace bookspin
