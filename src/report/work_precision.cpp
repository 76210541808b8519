#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "files/files.h"
#include "report/draft.h"
#include "report/odeint.h"

namespace bookspin {
namespace {

using RigidVector = std::array<double, 7>;  // q (w, x, y, z), L_B

struct FreeBody {
  Eigen::Vector3d inverse_I_B;

  void operator()(const RigidVector& s, RigidVector& d, double /*t*/) const {
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

// Of the moments and the angular momentum themselves: the options' would differ in the last digit.
TorqueFree motion_of(const RigidCase& c) {
  return {c.I_B, Eigen::Quaterniond::Identity(), c.L_W};
}

struct Exact {
  TorqueFree motion;
  double interval;
  RigidState state{};
  long evaluations = 0;
  bool to(int sample) {
    state = motion.at((sample + 1) * interval);
    ++evaluations;
    return true;
  }
};

template <class Book>
double angle_from(const Book& book, const Eigen::Quaterniond& expected) {
  Eigen::Quaterniond q(std::nan(""), 0.0, 0.0, 0.0);  // springs: no rigid case is theirs
  if constexpr (std::is_same_v<Book, RigidVector>) {
    q = {book[0], book[1], book[2], book[3]};
  } else if constexpr (std::is_same_v<Book, RigidState>) {
    q = book.q_WB;
  } else if constexpr (requires { book.R_WB(); }) {
    q = book.R_WB();
  } else if constexpr (requires { book.q_WB(); }) {
    q = book.q_WB();
  }
  return q.coeffs().allFinite() ? geodesic_angle(q, expected) : std::nan("");
}

Ladders all_ladders(const RigidCase& c, const Effort& effort) {
  const BookOptions options = c.options();
  const double omega = options.omega_W.norm();
  Course course{static_cast<int>(c.q_WB.size()), c.T};
  course.fewest = std::max(1.0, std::floor(course.interval() * omega / std::numbers::pi));  // about half a turn a step
  const auto error = [&c](const auto& book, int i) { return angle_from(book, c.q_WB[static_cast<std::size_t>(i)]); };
  const auto exact = [&] { return Exact{motion_of(c), course.interval()}; };
  Ladders ladders{{exact_solver, {measure(0.0, course, effort, exact, error)}}};
  climb_all(rigid_solvers(), options, course, effort, ladders, error);
  climb_odeint(Method::quaternion, RigidVector{1.0, 0.0, 0.0, 0.0, c.L_W.x(), c.L_W.y(), c.L_W.z()},
               FreeBody{c.I_B.cwiseInverse()}, std::min(course.interval(), 0.1 / omega), course, effort, ladders,
               error);
  return ladders;
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
  plot.y_range = {1e-16, 10.0};
  for (const double flip : {first, second})
    plot.more.push_back(fmt::format("set arrow from {0}, graph 0 to {0}, graph 1 nohead lc rgb '#000000' dt 2", flip));
  Table table{{"time"}, {}};
  const int samples = static_cast<int>(1.2 * second / interval);
  plot.x_range = {0.0, samples * interval};
  for (int i = 1; i <= samples; ++i) table.rows.push_back({i * interval});
  double after_first = none;
  double at_second = none;
  std::string nearest;
  for (const Solver& solver : rigid_solvers()) {
    const int order = info_of(solver.integrator).order;
    if (order == 2 || order == 3) continue;  // between Euler's lines and the others'
    visit_stepped(solver, c.options(), [&](const auto& book) {
      Series line{name_of(solver), {}, pen_of(solver), Mark::line};
      Stepped<std::decay_t<decltype(book)>> runner{book, interval / steps, steps, 1};
      for (std::vector<Cell>& row : table.rows) {
        const double t = row[0].get<double>();
        (void)runner.to(0);
        line.points.emplace_back(t, std::max(1e-16, angle_from(runner.state, motion.at(t).q_WB)));
        row.emplace_back(line.points.back().second);
      }
      table.columns.push_back(line.title);
      const auto error_at = [&](double t) { return line.points[static_cast<std::size_t>(t / interval)].second; };
      if (error_at(between) < after_first) nearest = line.title;
      after_first = std::min(after_first, error_at(between));
      at_second = std::min(at_second, error_at(second));
      plot.series.push_back(std::move(line));
    });
  }
  draft.plot("error_over_time", plot);
  draft.keep("error_over_time", table);
  draft.page["over_time"] = {{"h", interval / steps}, {"first", first},     {"second", second},
                             {"between", between},    {"nearest", nearest}, {"after_first", after_first},
                             {"at_second", at_second}};
}

void exact_cost(Draft& draft) {
  BookOptions options;
  options.omega_W = {0.11482, 1e-4, 5e-5};
  const TorqueFree motion = exact_motion(options);
  double sum = 0.0;
  const double setup = least_ns(30, [&] {
    for (int n = 0; n < 50; ++n) sum += exact_motion(options).first_flip();
  });
  const double evaluations = least_ns(30, [&] {
    for (int n = 0; n < 1200; ++n) sum += motion.at(0.5 * n).q_WB.w();
  });
  std::array<double, 1200> t;
  for (std::size_t n = 0; n < t.size(); ++n) t[n] = 0.5 * static_cast<double>(n);
  std::array<RigidState, 1200> states;
  const double together = least_ns(30, [&] { motion.at(t.size(), t.data(), states.data()); });
  asm volatile("" : : "g"(&sum), "g"(&states) : "memory");  // else the loops are left out
  draft.page["exact"] = {
      {"setup_us", 1e-3 * setup / 50.0}, {"evaluation_ns", evaluations / 1200.0}, {"together_ns", together / 1200.0}};
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
  std::istringstream list(read_file(reference / "cases.txt"));
  for (RigidCase c; list >> c.letter; cases.push_back(std::move(c)), c = {}) {
    c.problem = static_cast<Problem>(cases.size());
    std::string word;
    for (int i = 0; i < 8; ++i) list >> word;  // its name, and in hexadecimal what follows in decimal
    list >> c.I_B.x() >> c.I_B.y() >> c.I_B.z() >> c.L_W.x() >> c.L_W.y() >> c.L_W.z() >> c.T;
    std::istringstream samples(read_file(reference / ("ref_" + c.letter + ".txt")));
    std::getline(samples, word);  // a comment
    double t = 0.0;
    for (Eigen::Quaterniond q; samples >> t >> q.w() >> q.x() >> q.y() >> q.z();) c.q_WB.push_back(q);
    if (c.q_WB.empty() || !(c.T > 0.0) || c.problem > Problem::case_d)
      throw std::runtime_error((reference / "cases.txt").string() + ": no such case: " + c.letter);
  }
  return cases;
}

Plot work_precision_plot(const Ladders& ladders, const std::string& y_label, double lowest) {
  constexpr double fall_back = 20.0;  // where runs without an error are shown
  Plot plot{"CPU nanoseconds for one unit of simulated time", y_label};
  plot.y_range = {lowest, 60.0};
  plot.more = {fmt::format("set ytics add ('diverged' {})", fall_back)};
  double least = none;
  double most = 0.0;
  for (const auto& [solver, ladder] : ladders) {
    const auto finished = [](const Run& run) { return run.outcome == Outcome::finished; };
    const auto error = [](const Run& run) { return std::max(run.error, 1e-16); };
    plot.series.push_back({name_of(solver), points(ladder, finished, &Run::ns_per_time, error), pen_of(solver),
                           solver == exact_solver ? Mark::points : Mark::line_and_points});
    plot.series.push_back(
        {"", points(ladder, std::not_fn(finished), &Run::ns_per_time, [](const Run& /*run*/) { return fall_back; }),
         pen_of(solver), Mark::cross});
    for (const Run& run : ladder) {
      least = std::min(least, run.ns_per_time);
      most = std::max(most, run.ns_per_time);
    }
  }
  plot.x_range = {0.7 * least, 1.4 * most};
  return plot;
}

void work_precision(Draft& draft) {
  for (const RigidCase& c : read_rigid_cases(draft.order.project / "data" / "reference")) {
    draft.say("case " + c.letter);
    Effort effort = draft.effort;
    if (c.letter == "d") effort.most_evaluations *= 4;  // a thousand times as many turns
    const Ladders& ladders = draft.runs[c.problem] = all_ladders(c, effort);
    draft.keep("cheapest_" + c.letter, cheapest_table(ladders));
    draft.plot("work_precision_" + c.letter, work_precision_plot(ladders, "largest error, radians", 1e-16));
    const auto [stepper, nearest] = nearest_stepper(ladders);
    const double turns = c.T * c.options().omega_W.norm() / (2.0 * std::numbers::pi);
    const double flip = motion_of(c).flip_period();
    draft.page[c.letter] = {{"T", c.T},
                            {"kick", c.L_W.y() / c.L_W.x()},
                            {"turns", turns},
                            {"turn", c.T / turns},
                            {"flips", c.T / flip},
                            {"flip", flip},
                            {"asymmetry", (c.I_B.x() - c.I_B.y()) / c.I_B.y()},
                            {"exact_error", ladder(ladders, exact_solver).nearest().error},
                            {"stepper_error", nearest.error},
                            {"stepper", name_of(stepper)},
                            {"any", winners(ladders, false)},
                            {"stepped", winners(ladders, true)}};
    if (c.problem == Problem::case_b) error_over_time(draft, c);
  }
  exact_cost(draft);

  // Euler's finest runs, and a step of rk4 beside one of Odeint's.
  const Ladders& case_a = draft.runs[Problem::case_a];
  draft.page["euler"] = nlohmann::json::array();
  for (const Method method : {Method::matrix, Method::quaternion}) {
    const Ladder euler = ladder(case_a, {method});
    const Run finest = euler.finest();
    draft.page["euler"].push_back({{"name", name_of(euler.solver)},
                                   {"h", finest.setting},
                                   {"ns", finest.ns_per_time},
                                   {"error", finest.error},
                                   {"best", euler.nearest().error}});
  }
  const auto ns_a_step = [&](const Solver& solver) {
    const Run run = ladder(case_a, solver).finest();
    return run.ns_per_time * run.setting;
  };
  draft.page["rk4"] = {{"own", ns_a_step({Method::quaternion, Integrator::rk4})},
                       {"odeint", ns_a_step({Method::quaternion, Integrator::explicit_euler, Odeint::rk4})}};
}

}  // namespace bookspin
