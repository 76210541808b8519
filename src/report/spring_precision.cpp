#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
#include "report/odeint.h"
#include "report/work_precision.h"

namespace bookspin {
namespace {

using State = std::array<double, 48>;  // positions, velocities
using ConstCorners = Eigen::Map<const Corners>;

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

class Stepped {
 public:
  Stepped(const BookOptions& options, double interval, long steps)
      : book_(options), integrator_(options.integrator), h_(interval / static_cast<double>(steps)), steps_(steps) {}
  bool to(int /*sample*/) {
    for (long i = 0; i < steps_; ++i) book_.step(h_);
    taken_ += steps_;
    return true;
  }
  [[nodiscard]] long evaluations() const { return taken_ * evaluations_a_step(integrator_); }
  [[nodiscard]] const Corners& corners_W() const { return book_.corners_W(); }

 private:
  SpringBook book_;
  Integrator integrator_;
  double h_;
  long steps_;
  long taken_ = 0;
};

Corners corners_of(const auto& runner) {
  if constexpr (requires { runner.corners_W(); }) {
    return runner.corners_W();
  } else {
    return ConstCorners(runner.x().data());
  }
}

double farthest(const Corners& a, const Corners& b) {
  return (a - b).colwise().norm().maxCoeff();
}

Corners rigid_corners(const BookOptions& options, double t) {
  return exact_motion(options).at(t).q_WB.toRotationMatrix() * body_of(options).corners_B;
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

BookOptions book_of_case_a() {
  BookOptions book;
  book.omega_W = Eigen::Vector3d(1.0, 1e-3, 5e-4).cwiseQuotient(0.5 * body_of(book).I_B);
  return book;
}

constexpr std::array<std::pair<const char*, Integrator>, 5> spring_integrators{
    {{"explicit Euler", Integrator::explicit_euler},
     {"semi-implicit Euler", Integrator::semi_implicit_euler},
     {"velocity Verlet", Integrator::velocity_verlet},
     {"rk4", Integrator::rk4},
     {"composition8", Integrator::composition8}}};

}  // namespace

void spring_work_precision(const std::filesystem::path& reference, const Effort& effort, std::vector<Run>& runs) {
  constexpr double T = 200.0;
  const std::filesystem::path file = reference / "ref_springs.txt";
  std::ifstream in(file);
  std::vector<Corners> expected;
  for (std::array<double, 48> row; true;) {
    for (double& number : row) in >> number;
    if (!in) break;
    expected.emplace_back(ConstCorners(row.data()));
  }
  if (expected.empty()) throw std::runtime_error(file.string() + ": cannot be read");
  const int samples = static_cast<int>(expected.size());
  const double interval = T / samples;
  const BookOptions options = reference_options();
  const double reach = body_of(options).reach;
  const auto run_once = [&](const std::string& method, double setting, auto&& start) {
    Run run{"springs", method, setting};
    measure(run, samples, T, effort, start, [&](const auto& runner, int i) {
      const Corners x = corners_of(runner);
      const auto k = static_cast<std::size_t>(i);
      const double error = farthest(x, expected[k]) / reach;
      if (!(error < 1e3)) return false;  // a thousand times its own size: exploded
      run.error = std::max(run.error, error);
      return true;
    });
    return run;
  };
  constexpr double fewest = 4.0;
  const auto by_steps = [&](const std::string& method, auto&& start) {
    climb(effort, step_ladder(fewest, effort.ladder), runs, [&](long steps) {
      return run_once(method, interval / static_cast<double>(steps), [&] { return start(steps); });
    });
  };
  for (const auto& [name, integrator] : spring_integrators) {
    BookOptions with = options;
    with.integrator = integrator;
    by_steps(name, [&](long steps) { return Stepped(with, interval, steps); });
  }
  const SpringSystem system{SpringBook(options), options.particle_mass};
  State start{};
  Eigen::Map<Corners>(start.data()) = system.book.corners_W();
  Eigen::Map<Corners>(start.data() + 24) = system.book.velocities_W();
  by_steps("odeint rk4", [&](long steps) { return OdeintFixed<State, SpringSystem>(start, system, interval, steps); });
  for_each_controlled(start, system, interval, 0.01, [&](const std::string& method, auto&& make) {
    climb(effort, tolerance_ladder(effort.ladder), runs,
          [&](double tolerance) { return run_once(method, tolerance, [&] { return make(tolerance); }); });
  });
}

void springs_against_rigid(const Effort& effort, std::vector<Run>& runs) {
  const double T = effort.quick ? 100.0 : 600.0;
  constexpr int samples = 60;
  const double interval = T / samples;
  for (const double stiffness : {10.0, 1000.0}) {
    BookOptions book = book_of_case_a();
    book.stiffness = stiffness;
    std::vector<Corners> rigid;
    for (int i = 1; i <= samples; ++i) rigid.push_back(rigid_corners(book, i * interval));
    const auto add = [&](const char* name, const BookOptions& options) {
      climb(effort, step_ladder(16.0, effort.ladder), runs, [&](long steps) {
        Run run{stiffness < 100.0 ? "springs against rigid, k = 10" : "springs against rigid, k = 1000", name,
                interval / static_cast<double>(steps)};
        measure(
            run, samples, T, effort, [&] { return Stepped(options, interval, steps); },
            [&](const Stepped& runner, int i) {
              const double error =
                  farthest(runner.corners_W(), rigid[static_cast<std::size_t>(i)]) / (0.5 * options.size.norm());
              run.error = std::max(run.error, error);
              return error < 1e3;
            });
        return run;
      });
    };
    add("springs, Euler (the paper)", book);
    book.normalize_every = 0;
    book.damping = 0.0;
    for (const auto& [name, integrator] : spring_integrators) {
      book.integrator = integrator;
      add(name, book);
    }
  }
}

// The book of case a under three models. Each model's own motion is computed by a method and step far more accurate
// than what is shown.
Table spring_model_error(const Effort& effort) {
  Table table{
      "spring_model_error",
      {"stiffness", "springs", "method", "step", "integration error", "model error", "all: from the rigid motion"},
      {}};
  const double T = effort.quick ? 100.0 : 600.0;
  constexpr int samples = 60;
  constexpr double h = 0.1 / 6.0;  // the paper's program
  const auto motion = [&](const BookOptions& with, double step) {
    const int steps = static_cast<int>(std::ceil(T / samples / step));
    SpringBook book(with);
    std::vector<Corners> x;
    for (int i = 0; i < samples; ++i) {
      for (int n = 0; n < steps; ++n) book.step(T / samples / steps);
      x.push_back(book.corners_W());
    }
    return x;
  };
  for (const double stiffness : effort.quick ? std::vector<double>{10.0} : std::vector<double>{10.0, 100.0, 1000.0}) {
    BookOptions book = book_of_case_a();
    book.stiffness = stiffness;
    std::vector<Corners> rigid;
    for (int i = 1; i <= samples; ++i) rigid.push_back(rigid_corners(book, T * i / samples));
    const auto largest = [&](const std::vector<Corners>& a, const std::vector<Corners>& b) -> Cell {
      double result = 0.0;
      for (std::size_t i = 0; i < a.size(); ++i) {
        const double error = farthest(a[i], b[i]) / (0.5 * book.size.norm());
        if (!(error < 1e3)) return "exploded";
        result = std::max(result, error);
      }
      return result;
    };
    const auto add = [&](const char* springs, const char* method, BookOptions fine, double fine_step,
                         Integrator integrator) {
      const std::vector<Corners> own = motion(fine, fine_step);
      fine.integrator = integrator;
      const std::vector<Corners> x = motion(fine, h);
      table.rows.push_back({stiffness, springs, method, h, largest(x, own), largest(own, rigid), largest(x, rigid)});
    };
    BookOptions undamped = book;
    undamped.normalize_every = 0;
    undamped.damping = 0.0;
    undamped.integrator = Integrator::composition8;
    add("undamped", "velocity Verlet", undamped, 0.1 * std::sqrt(10.0 / stiffness), Integrator::velocity_verlet);
    BookOptions damped = book;
    damped.normalize_every = 0;
    damped.integrator = Integrator::rk4;
    const double fine_step = 0.02 / std::sqrt(stiffness);
    add("damped", "explicit Euler", damped, fine_step, Integrator::explicit_euler);
    BookOptions normalized = damped;
    normalized.normalize_every = 1;
    add("damped and normalized", "explicit Euler (the paper)", normalized, fine_step, Integrator::explicit_euler);
  }
  return table;
}

}  // namespace bookspin
