#include "report/work_precision.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "report/draft.h"
#include "report/odeint.h"

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

// From the moments and the angular momentum themselves: the options' would differ in the last digit.
class Exact {
 public:
  Exact(const RigidCase& c, double interval)
      : motion_(c.I_B, Eigen::Quaterniond::Identity(), c.L_W), interval_(interval) {}
  bool to(int sample) {
    state_ = motion_.at((sample + 1) * interval_);
    ++evaluations_;
    return true;
  }
  [[nodiscard]] const RigidState& state() const { return state_; }
  [[nodiscard]] long evaluations() const { return evaluations_; }

 private:
  TorqueFree motion_;
  double interval_;
  RigidState state_;
  long evaluations_ = 0;
};

template <class Book>
Eigen::Quaterniond orientation(const Book& book) {
  if constexpr (std::is_same_v<Book, State>) {
    return {book[0], book[1], book[2], book[3]};
  } else if constexpr (std::is_same_v<Book, RigidState>) {
    return book.q_WB;
  } else if constexpr (requires { book.R_WB(); }) {
    return Eigen::Quaterniond(book.R_WB());
  } else if constexpr (requires { book.q_WB(); }) {
    return book.q_WB();
  } else {
    return Eigen::Quaterniond(std::nan(""), 0.0, 0.0, 0.0);  // springs: no rigid case is theirs
  }
}

double angle_from(const auto& book, const Eigen::Quaterniond& expected) {
  const Eigen::Quaterniond q = orientation(book);
  return q.coeffs().allFinite() ? geodesic_angle(q, expected) : std::nan("");
}

void run_all(const RigidCase& c, const Effort& effort, Runs& runs) {
  const Course course{static_cast<int>(c.q_WB.size()), c.T};
  const BookOptions options = c.options();
  const auto error = [&c](const auto& book, int i) { return angle_from(book, c.q_WB[static_cast<std::size_t>(i)]); };
  // The coarsest step turns the book by no more than about pi.
  const double fewest = std::max(1.0, std::floor(course.interval() * options.omega_W.norm() / std::numbers::pi));
  runs.push_back(measure(
      {c.problem, exact_solver}, course, effort, [&] { return Exact(c, course.interval()); }, error));
  for (const Solver& solver : rigid_solvers())
    climb_steps(c.problem, solver, options, course, fewest, effort, runs, error);
  const State start{1.0, 0.0, 0.0, 0.0, c.L_W.x(), c.L_W.y(), c.L_W.z()};
  climb_odeint(c.problem, Method::quaternion, start, FreeBody{c.I_B.cwiseInverse()}, course, fewest,
               std::min(course.interval(), 0.1 / options.omega_W.norm()), effort, runs, error);
}

std::ifstream open_reference(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  return in;
}

TorqueFree motion_of(const RigidCase& c) {
  return {c.I_B, Eigen::Quaterniond::Identity(), c.L_W};
}

// When a method that steps its state loses the book: its error from sample to sample, past two flips.
void error_over_time(Draft& draft, const RigidCase& c) {
  constexpr double interval = 5.0;
  constexpr long steps = 10;
  const TorqueFree motion = motion_of(c);
  const double first = motion.first_flip();
  const double second = first + motion.flip_period();
  const double between = first + 0.1 * motion.flip_period();
  Plot plot{"time", "angle to the true orientation, radians", false, true};
  plot.y_range = "[1e-16:10]";
  for (const double flip : {first, second, second + motion.flip_period()}) {
    if (flip < 1.2 * second)
      plot.more.push_back(
          fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead lc rgb '#000000' dt 2", flip));
  }
  Table table{{"time"}, {}};
  const int samples = static_cast<int>(1.2 * second / interval);
  for (int i = 1; i <= samples; ++i) table.rows.push_back({i * interval});
  double after_first = std::nan("");
  double at_second = std::nan("");
  std::string nearest;
  for (const Solver& solver : rigid_solvers()) {
    const int order = info_of(solver.integrator).order;
    if (solver == exact_solver || (order < 4 && solver.integrator != Integrator::explicit_euler)) continue;
    Series line{name_of(solver), {}, pen_of(solver), Mark::line};
    std::visit(
        [&]<class Book>(const Book& book) {
          if constexpr (requires(Book b) { b.step(1.0); }) {
            Stepped runner(book, solver.integrator, interval, steps);
            for (int i = 1; i <= samples; ++i) {
              (void)runner.to(i);
              line.points.emplace_back(i * interval,
                                       std::max(1e-16, angle_from(runner.state(), motion.at(i * interval).q_WB)));
              table.rows[static_cast<std::size_t>(i) - 1].push_back(line.points.back().second);
            }
          }
        },
        make_book(solver.method, options_for(solver, c.options())));
    table.columns.push_back(line.title);
    const auto error_at = [&](double t) { return line.points[static_cast<std::size_t>(t / interval)].second; };
    if (!(error_at(between) >= after_first)) {
      after_first = error_at(between);
      nearest = line.title;
    }
    at_second = std::fmin(at_second, error_at(second));
    plot.series.push_back(std::move(line));
  }
  draft.plot("error_over_time", plot);
  draft.keep("error_over_time", table);
  draft.page["over_time"] = {{"h", interval / steps}, {"first", first},     {"second", second},
                             {"between", between},    {"nearest", nearest}, {"after_first", after_first},
                             {"at_second", at_second}};
}

}  // namespace

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
    RigidCase c{};
    c.problem = static_cast<Problem>(cases.size());
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
    if (c.q_WB.empty() || !(c.T > 0.0) || c.problem > Problem::case_d)
      throw std::runtime_error((reference / "cases.txt").string() + ": no such case: " + c.letter);
    cases.push_back(std::move(c));
  }
  return cases;
}

ExactCost exact_cost() {
  BookOptions options;
  options.omega_W = {0.11482, 1e-4, 5e-5};
  double sum = 0.0;  // keeps the loops from being left out
  ExactCost cost{};
  cost.setup_ns = least_ns(30,
                           [&] {
                             for (int n = 0; n < 50; ++n) sum += exact_motion(options).first_flip();
                           }) /
                  50.0;
  const TorqueFree motion = exact_motion(options);
  cost.evaluation_ns = least_ns(30,
                                [&] {
                                  for (int n = 0; n < 1200; ++n) sum += motion.at(0.5 * n).q_WB.w();
                                }) /
                       1200.0;
  return sum < 1e300 ? cost : ExactCost{};
}

Plot work_precision_plot(const Runs& runs, const std::vector<Problem>& problems, const std::string& y_label,
                         const std::string& lowest) {
  constexpr double fall_back = 20.0;  // where runs without an error are shown
  Plot plot{"CPU nanoseconds for one unit of simulated time", y_label};
  plot.y_range = fmt::format("[{}:60]", lowest);
  plot.more = {fmt::format("set ytics add ('diverged' {})", fall_back)};
  double least = 1e300;
  double most = 0.0;
  for (const Problem problem : problems) {
    for (const Solver& solver : solvers_of(runs, problem)) {
      const bool single = solver == exact_solver;
      const std::string title = problem == problems.front() ? name_of(solver) : "";
      Series line{title, {}, pen_of(solver), single ? Mark::points : Mark::line_and_points};
      Series crosses{"", {}, pen_of(solver), Mark::cross};
      for (const Run& run : runs) {
        if (run.problem != problem || run.solver != solver) continue;
        least = std::min(least, run.ns_per_time);
        most = std::max(most, run.ns_per_time);
        if (run.outcome == Outcome::finished) {
          line.points.emplace_back(run.ns_per_time, std::max(run.error, 1e-16));
        } else {
          crosses.points.emplace_back(run.ns_per_time, fall_back);
        }
      }
      if (single && !line.points.empty()) {
        const auto& [ns, error] = line.points.front();
        plot.more.push_back(fmt::format("set label 'exact' at {}, {} left offset 1,0", ns, error));
      }
      plot.series.push_back(std::move(line));
      plot.series.push_back(std::move(crosses));
    }
  }
  plot.x_range = fmt::format("[{}:{}]", 0.7 * least, 1.4 * most);
  return plot;
}

void work_precision(Draft& draft) {
  for (const RigidCase& c : read_rigid_cases(draft.order.project / "data" / "reference")) {
    draft.say("case " + c.letter);
    Effort effort = draft.effort;
    if (c.letter == "d") effort.most_evaluations *= 4;  // a thousand times as many turns
    run_all(c, effort, draft.runs);
    draft.keep("cheapest_" + c.letter, cheapest_table(draft.runs, c.problem));
    draft.plot("work_precision_" + c.letter,
               work_precision_plot(draft.runs, {c.problem}, "largest error, radians", "1e-16"));
    const Run* nearest = nearest_stepper(draft.runs, c.problem);
    const double turns = c.T * c.options().omega_W.norm() / (2.0 * std::numbers::pi);
    draft.page[c.letter] = {{"T", c.T},
                            {"kick", c.L_W.y() / c.L_W.x()},
                            {"turns", turns},
                            {"turn", c.T / turns},
                            {"flips", c.T / motion_of(c).flip_period()},
                            {"flip", motion_of(c).flip_period()},
                            {"asymmetry", (c.I_B.x() - c.I_B.y()) / c.I_B.y()},
                            {"exact_error", best_error(draft.runs, c.problem, exact_solver)},
                            {"stepper_error", nearest->error},
                            {"stepper", name_of(nearest->solver)},
                            {"any", winners(draft.runs, c.problem, false)},
                            {"stepped", winners(draft.runs, c.problem, true)}};
    if (c.problem == Problem::case_b) error_over_time(draft, c);
  }
  const ExactCost exact = exact_cost();
  draft.page["exact"] = {{"setup_us", 1e-3 * exact.setup_ns}, {"evaluation_ns", exact.evaluation_ns}};

  // Euler's finest runs; rk4 against Odeint's, step by step; splitting2 against dmv2 on the symmetric body.
  nlohmann::json euler = nlohmann::json::array();
  for (const Method method : {Method::matrix, Method::quaternion}) {
    const Solver solver{method};
    if (const Run* finest = finest_run(draft.runs, Problem::case_a, solver)) {
      euler.push_back({{"name", name_of(solver)},
                       {"h", finest->setting},
                       {"ns", finest->ns_per_time},
                       {"error", finest->error},
                       {"best", best_error(draft.runs, Problem::case_a, solver)}});
    }
  }
  draft.page["euler"] = std::move(euler);
  const auto ns_a_step = [&](const Solver& solver) {
    const Run* run = finest_run(draft.runs, Problem::case_a, solver);
    return run == nullptr ? std::nan("") : run->ns_per_time * run->setting;
  };
  draft.page["rk4"] = {{"own", ns_a_step({Method::quaternion, Integrator::rk4})},
                       {"odeint", ns_a_step({Method::quaternion, Integrator::explicit_euler, Odeint::rk4})}};
  const Run* dmv2 = coarsest_run(draft.runs, Problem::case_c, {Method::quaternion, Integrator::dmv2});
  if (dmv2 != nullptr) {
    const Run* splitting2 =
        run_near(draft.runs, Problem::case_c, {Method::quaternion, Integrator::splitting2}, dmv2->setting);
    if (splitting2 != nullptr && splitting2->setting == dmv2->setting) {
      draft.page["symmetric"] = {{"h", dmv2->setting}, {"dmv2", dmv2->error}, {"splitting2", splitting2->error}};
    }
  }
}

}  // namespace bookspin
