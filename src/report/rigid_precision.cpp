#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "report/odeint.h"
#include "report/work_precision.h"

namespace bookspin {
namespace {

using State = std::array<double, 7>;  // q (w, x, y, z), L_B

struct FreeBody {
  Eigen::Vector3d inverse_I_B;

  void operator()(const State& s, State& d, double /*t*/) const {
    const double p = s[4] * inverse_I_B.x();
    const double q = s[5] * inverse_I_B.y();
    const double r = s[6] * inverse_I_B.z();
    d[0] = 0.5 * (-s[1] * p - s[2] * q - s[3] * r);
    d[1] = 0.5 * (s[0] * p + s[2] * r - s[3] * q);
    d[2] = 0.5 * (s[0] * q + s[3] * p - s[1] * r);
    d[3] = 0.5 * (s[0] * r + s[1] * q - s[2] * p);
    d[4] = s[5] * r - s[6] * q;
    d[5] = s[6] * p - s[4] * r;
    d[6] = s[4] * q - s[5] * p;
  }
};

template <class Book>
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
  [[nodiscard]] Eigen::Quaterniond q_WB() const {
    if constexpr (std::is_same_v<Book, MatrixBook>) {
      return Eigen::Quaterniond(book_.R_WB());
    } else {
      return book_.q_WB();
    }
  }

 private:
  Book book_;
  Integrator integrator_;
  double h_;
  long steps_;
  long taken_ = 0;
};

class Exact {
 public:
  Exact(const RigidCase& c, double interval)
      : motion_(c.I_B, Eigen::Quaterniond::Identity(), c.L_W), interval_(interval) {}
  bool to(int sample) {
    state_ = motion_.at((sample + 1) * interval_);
    ++evaluations_;
    return true;
  }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] const Eigen::Quaterniond& q_WB() const { return state_.q_WB; }

 private:
  TorqueFree motion_;
  double interval_;
  RigidState state_;
  long evaluations_ = 0;
};

Eigen::Quaterniond orientation(const auto& runner) {
  if constexpr (requires { runner.q_WB(); }) {
    return runner.q_WB();
  } else {
    return {runner.x()[0], runner.x()[1], runner.x()[2], runner.x()[3]};
  }
}

template <class Start>
Run run_once(const RigidCase& c, const std::string& method, double setting, const Effort& effort, Start&& start) {
  Run run{"case " + c.letter, method, setting};
  measure(run, static_cast<int>(c.q_WB.size()), c.T, effort, start, [&](const auto& runner, int i) {
    const Eigen::Quaterniond q = orientation(runner);
    if (!q.coeffs().allFinite()) return false;
    run.error = std::max(run.error, geodesic_angle(q, c.q_WB[static_cast<std::size_t>(i)]));
    return true;
  });
  return run;
}

std::ifstream open_reference(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return in;
}

}  // namespace

// Of the right-hand side, or of what stands in its place.
int evaluations_a_step(Integrator integrator) {
  switch (integrator) {
    case Integrator::rk4:
      return 4;
    case Integrator::splitting4:
      return 5;
    case Integrator::composition8:
      return 17;
    default:
      return 1;
  }
}

BookOptions RigidCase::options() const {
  BookOptions options;
  options.particle_mass = 0.5;  // principal moments b^2 + c^2, ...
  for (int d = 0; d < 3; ++d) options.size(d) = std::sqrt(0.5 * (I_B.sum() - 2.0 * I_B(d)));
  options.omega_W = L_W.cwiseQuotient(body_of(options).I_B);
  return options;
}

std::vector<RigidCase> read_rigid_cases(const std::filesystem::path& reference) {
  std::vector<RigidCase> cases;
  std::ifstream list = open_reference(reference / "cases.txt");
  for (std::string line; std::getline(list, line);) {
    std::istringstream words(line);
    RigidCase c;
    std::string name;
    std::array<std::string, 7> hex;
    words >> c.letter >> name;
    for (std::string& word : hex) words >> word;
    const auto value = [&hex](std::size_t i) { return std::strtod(hex[i].c_str(), nullptr); };
    c.I_B = {value(0), value(1), value(2)};
    c.L_W = {value(3), value(4), value(5)};
    c.T = value(6);
    std::ifstream samples = open_reference(reference / ("ref_" + c.letter + ".txt"));
    while (std::getline(samples, line)) {
      if (line.starts_with('#')) continue;
      std::istringstream numbers(line);
      double t = 0.0;
      Eigen::Quaterniond q;
      numbers >> t >> q.w() >> q.x() >> q.y() >> q.z();
      c.q_WB.push_back(q);
    }
    if (c.q_WB.empty() || !(c.T > 0.0))
      throw std::runtime_error((reference / "cases.txt").string() + ": no such case: " + line);
    cases.push_back(std::move(c));
  }
  return cases;
}

void rigid_work_precision(const RigidCase& c, const Effort& effort, std::vector<Run>& runs) {
  const double interval = c.T / static_cast<double>(c.q_WB.size());
  const BookOptions options = c.options();
  // The coarsest step turns the book by no more than about pi.
  const double fewest = std::max(1.0, std::floor(interval * options.omega_W.norm() / std::numbers::pi));
  runs.push_back(run_once(c, "exact", 0.0, effort, [&] { return Exact(c, interval); }));

  const auto by_steps = [&](const std::string& method, auto&& start) {
    climb(effort, step_ladder(fewest, effort.ladder), runs, [&](long steps) {
      return run_once(c, method, interval / static_cast<double>(steps), effort, [&] { return start(steps); });
    });
  };
  by_steps("Euler, matrix", [&](long steps) { return Stepped<MatrixBook>(options, interval, steps); });
  by_steps("Euler, quaternion", [&](long steps) { return Stepped<QuaternionBook>(options, interval, steps); });
  for (const auto& [name, integrator] :
       {std::pair{"rk4", Integrator::rk4}, std::pair{"splitting2", Integrator::splitting2},
        std::pair{"splitting4", Integrator::splitting4}, std::pair{"dmv2", Integrator::dmv2},
        std::pair{"dmv6", Integrator::dmv6}, std::pair{"dmv10", Integrator::dmv10}}) {
    BookOptions with = options;
    with.integrator = integrator;
    by_steps(name, [&](long steps) { return Stepped<FreeBook>(with, interval, steps); });
  }

  const State start{1.0, 0.0, 0.0, 0.0, c.L_W.x(), c.L_W.y(), c.L_W.z()};
  const FreeBody body{c.I_B.cwiseInverse()};
  by_steps("odeint rk4", [&](long steps) { return OdeintFixed<State, FreeBody>(start, body, interval, steps); });
  const double first_step = std::min(interval, 0.1 / options.omega_W.norm());
  for_each_controlled(start, body, interval, first_step, [&](const std::string& method, auto&& make) {
    climb(effort, tolerance_ladder(effort.ladder), runs,
          [&](double tolerance) { return run_once(c, method, tolerance, effort, [&] { return make(tolerance); }); });
  });
}

double exact_evaluation_ns() {
  BookOptions options;
  options.omega_W = {0.11482, 1e-4, 5e-5};
  const TorqueFree motion = exact_motion(options);
  double sum = 0.0;
  const double ns = least_ns(30, [&] {
    for (int n = 0; n < 1200; ++n) sum += motion.at(0.5 * n).q_WB.w();
  });
  return sum < 1e300 ? ns / 1200.0 : 0.0;  // the sum keeps the loop from being left out
}

Table cheapest(const std::vector<Run>& runs, const std::string& problem, const std::vector<double>& errors) {
  Table table{"cheapest, " + problem, {"method"}, {}};
  for (const double error : errors) table.columns.push_back(fmt::format("{:.0e}", error));
  table.columns.insert(table.columns.end(), {"best error", "ns at best"});
  std::vector<std::string> methods;
  for (const Run& run : runs) {
    if (run.problem == problem && std::find(methods.begin(), methods.end(), run.method) == methods.end())
      methods.push_back(run.method);
  }
  for (const std::string& method : methods) {
    std::vector<Cell> row{method};
    const auto cheapest_for = [&](double error) -> const Run* {
      const Run* best = nullptr;
      for (const Run& run : runs) {
        if (run.problem != problem || run.method != method || run.outcome != Outcome::finished || !(run.error <= error))
          continue;
        if (best == nullptr || run.ns_per_time < best->ns_per_time) best = &run;
      }
      return best;
    };
    for (const double error : errors) {
      const Run* run = cheapest_for(error);
      row.push_back(run == nullptr ? Cell("never") : Cell(run->ns_per_time));
    }
    const Run* best = nullptr;
    for (const Run& run : runs) {
      if (run.problem == problem && run.method == method && run.outcome == Outcome::finished &&
          (best == nullptr || run.error < best->error))
        best = &run;
    }
    row.push_back(best == nullptr ? Cell("none finished") : Cell(best->error));
    row.push_back(best == nullptr ? Cell("–") : Cell(best->ns_per_time));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table all_runs(const std::vector<Run>& runs) {
  Table table{"runs", {"problem", "method", "setting", "error", "ns per unit of time", "outcome"}, {}};
  for (const Run& run : runs) {
    const char* outcome = run.outcome == Outcome::finished   ? "finished"
                          : run.outcome == Outcome::diverged ? "diverged"
                                                             : "stalled";
    table.rows.push_back({run.problem, run.method, run.setting, run.error, run.ns_per_time, outcome});
  }
  return table;
}

}  // namespace bookspin
