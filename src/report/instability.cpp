#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "report/draft.h"

namespace bookspin {
namespace {

constexpr double spin = 0.11482;         // of the paper's book, about x
constexpr double time_step = 0.1 / 6.0;  // of the paper's program
constexpr int steps_a_sample = 6;

BookOptions book(const Solver& solver, double kick) {
  return options_for(solver, kicked(spin * body_of(BookOptions()).I_B.x(), kick));
}

// When the tilt passes 90 degrees: the zero of L's component along the spin axis, on the chord between two samples, each
// 0.1. In the axes of the corners, whatever the book.
double flip_time(const Solver& solver, const BookOptions& options, double most) {
  const Corners corners_B = body_of(options).corners_B;
  const auto samples = static_cast<long>(std::ceil(most / (steps_a_sample * time_step)));
  AnyBook any = make_book(solver.method, options);
  return std::visit(
      [&](auto& book) {
        double t_before = 0.0;
        double before = 0.0;
        for (long n = 0; n <= samples; ++n) {
          const double t = static_cast<double>(n) * steps_a_sample * time_step;
          if constexpr (requires { book.move_to(t); }) book.move_to(t);
          const double L =
              (best_fit_orientation(book.corners_W(), corners_B).conjugate() * book.angular_momentum_W()).x();
          if (L <= 0.0) return t_before + (t - t_before) * before / (before - L);
          t_before = t;
          before = L;
          if constexpr (requires { book.step(time_step); }) book.step(time_step, steps_a_sample);
        }
        return none;
      },
      any);
}

double theory(double kick) {
  return exact_motion(book(exact_solver, kick)).first_flip();
}

struct Range {
  double least = none;
  double largest = -none;
  void add(double value) {
    least = std::min(least, value);
    largest = std::max(largest, value);
  }
};

void flip_times(Draft& draft) {
  const std::vector<Solver> all = contenders();
  const double most = draft.effort.quick ? 400.0 : 3000.0;
  const double most_springs = std::min(most, 1000.0);  // which are too dear to wait as long
  std::vector<double> kicks;
  for (int n = 2; n <= 15; n += draft.effort.quick ? 5 : 1) kicks.push_back(std::pow(10.0, -n));
  kicks.push_back(0.0);
  Table table{{"kick", "theory"}, {}};
  Table summary{{"kick", "theory", "rigid methods", "springs", "but never"}, {}};
  Plot plot{"kick, relative to the spin", "time of the first flip, distance from theory"};
  plot.y_range = {1e-6, 1e3};
  for (const Solver& solver : all) {
    table.columns.push_back(title_of(solver));
    plot.series.push_back({title_of(solver), {}, pen_of(solver)});
  }
  std::array<Range, 2> flips;             // of the rigid methods and of the springs, at the last kick: none
  std::vector<std::string> spring_flips;  // of which springs
  std::optional<double> forgotten;        // the largest kick that the matrix does not flip from
  for (const double kick : kicks) {
    const double expected = theory(kick);
    table.rows.push_back({kick, expected});
    flips = {};
    spring_flips.clear();
    std::array<std::vector<std::string>, 2> never;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool springs = all[i].method == Method::springs;
      const double t = flip_time(all[i], book(all[i], kick), springs ? most_springs : most);
      table.rows.back().push_back(number_or("never", t));
      if (t != none) {
        flips[springs].add(t);
        if (springs) spring_flips.push_back(title_of(all[i]));
        plot.series[i].points.emplace_back(kick, std::max(1e-6, std::abs(t - expected)));
      } else {
        never[springs].push_back(title_of(all[i]));
        if (all[i].method == Method::matrix && expected < most && !forgotten) forgotten = kick;
      }
    }
    std::vector<std::string> exceptions;  // of a kind of which others flip
    summary.rows.push_back({kick, expected == none ? "never" : fmt::format("{:.2f}", expected)});
    for (const bool springs : {false, true}) {
      const auto& [least, largest] = flips[springs];
      summary.rows.back().emplace_back(least == none ? "never" : fmt::format("{:.2f} to {:.2f}", least, largest));
      if (least != none) exceptions.insert(exceptions.end(), never[springs].begin(), never[springs].end());
    }
    summary.rows.back().emplace_back(fmt::format("{}", fmt::join(exceptions, "; ")));
  }
  draft.plot("flip_times", plot);
  draft.keep("flip_times", table);
  draft.keep("flip_times_summary", summary);
  nlohmann::json& page = draft.page["flips"];
  page = {{"most", most},
          {"most_springs", most_springs},
          {"none_flips", flips[false].least == none},
          {"rounding", theory(1e-16)}};
  if (flips[true].least != none)
    page["springs"] = {{"which", fmt::format("{}", fmt::join(spring_flips, "; "))}, {"at", flips[true].least}};
  if (forgotten) {
    BookOptions options = book({Method::matrix}, *forgotten);
    options.normalize_every = 0;
    const double t = flip_time({Method::matrix}, options, most);
    page["forgotten"] = {{"kick", *forgotten}, {"flips", t != none}, {"time", t}};
  }
}

}  // namespace

void instability(Draft& draft) {
  const Eigen::Vector3d I_B = body_of(BookOptions()).I_B;
  const double sigma = intermediate_axis_growth_rate(I_B, spin * I_B.x());
  draft.page["sigma"] = {{"value", fmt::format("{:.5f}", sigma)},
                         {"spin", fmt::format("{}", spin)},
                         {"e_fold", 1.0 / sigma},
                         {"decade", std::numbers::ln10 / sigma}};
  flip_times(draft);
}

}  // namespace bookspin
