#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/draft.h"
#include "report/plots.h"
#include "report/work_precision.h"

namespace bookspin {
namespace {

constexpr double fall_back = 20.0;  // where a work-precision plot shows runs without an error

std::vector<std::string> methods_of(const std::vector<Run>& runs, const std::string& problem) {
  std::vector<std::string> methods;
  for (const Run& run : runs) {
    if (run.problem != problem || std::find(methods.begin(), methods.end(), run.method) != methods.end()) continue;
    methods.push_back(run.method);
  }
  return methods;
}

// Of several problems the first one's methods stand in the key.
void plot_work_precision(const std::filesystem::path& svg, const std::vector<Run>& runs,
                         const std::vector<std::string>& problems, const char* y_label, const char* lowest,
                         const std::vector<std::string>& more = {}) {
  Plot plot{"nanoseconds for one unit of simulated time", y_label};
  plot.y_range = fmt::format("[{}:60]", lowest);
  plot.more = more;
  plot.more.push_back(fmt::format("set ytics add ('diverged' {})", fall_back));
  for (const std::string& problem : problems) {
    for (const std::string& method : methods_of(runs, problem)) {
      Series line{method, {}, Mark::line_and_points, problem == problems.front() ? "" : "-"};
      Series crosses{method, {}, Mark::cross, "-"};
      for (const Run& run : runs) {
        if (run.problem != problem || run.method != method) continue;
        if (run.outcome == Outcome::finished) {
          line.points.emplace_back(run.ns_per_time, std::max(run.error, 1e-16));
        } else {
          crosses.points.emplace_back(run.ns_per_time, fall_back);
        }
      }
      plot.series.push_back(std::move(line));
      plot.series.push_back(std::move(crosses));
    }
  }
  draw_plot(svg, plot);
}

// Above the right end of a line at this height; a number that is missing has no label.
std::string label_at(const char* text, double height) {
  return std::isfinite(height) ? fmt::format("set label '{}' at graph 0.99, first {} right offset 0,0.7", text, height)
                               : "";
}

}  // namespace

void write_precision(Draft& draft) {
  const auto best = [&](const std::string& problem, const std::string& method) {
    double error = std::nan("");
    for (const Run& run : draft.runs) {
      if (run.problem == problem && run.method == method) error = std::fmin(error, run.error);
    }
    return error;
  };
  const auto cost = [&](const std::string& problem, const std::string& method, double error) {
    double ns = std::nan("");
    for (const Run& run : draft.runs) {
      if (run.problem == problem && run.method == method && run.error <= error) ns = std::fmin(ns, run.ns_per_time);
    }
    return ns;
  };
  const std::filesystem::path reference = draft.order.project / "data" / "reference";
  const std::vector<double> errors{1e-2, 1e-4, 1e-6, 1e-9};
  double done = 0.0;
  for (const RigidCase& c : read_rigid_cases(reference)) {
    draft.tell("speed against error, case " + c.letter, done);
    done += 0.12;
    Effort effort = draft.effort;
    if (c.letter == "d") effort.most_evaluations *= 4;  // a thousand times as many turns
    rigid_work_precision(c, effort, draft.runs);
    draft.keep("cheapest_" + c.letter, cheapest(draft.runs, "case " + c.letter, errors));
    plot_work_precision(draft.order.folder / ("work_precision_" + c.letter + ".svg"), draft.runs, {"case " + c.letter},
                        "largest error, radians", "1e-16");
  }
  draft.tell("speed against error, springs", done);
  Effort effort = draft.effort;
  effort.most_evaluations *= draft.effort.quick ? 3 : 2;
  effort.repeats = draft.effort.quick ? 1 : 2;
  spring_work_precision(reference, effort, draft.runs);
  draft.keep("cheapest_springs", cheapest(draft.runs, "springs", errors));
  plot_work_precision(draft.order.folder / "work_precision_springs.svg", draft.runs, {"springs"},
                      "largest error, half diagonals, from the springs' own motion", "1e-11");
  draft.tell("the springs against the rigid body", 0.58);
  springs_against_rigid(effort, draft.runs);
  const std::string soft = "springs against rigid, k = 10";
  const std::string stiff = "springs against rigid, k = 1000";
  const auto finest = [&](const std::string& problem) {
    double error = std::nan("");
    for (const Run& run : draft.runs) {
      if (run.problem == problem && run.method == "composition8") error = run.error;
    }
    return error;
  };
  const double floor_soft = finest(soft);
  const double floor_stiff = finest(stiff);
  plot_work_precision(draft.order.folder / "work_precision_springs_rigid.svg", draft.runs, {soft, stiff},
                      "largest distance, half diagonals, from the rigid motion", "1e-4",
                      {label_at("k = 10", floor_soft), label_at("k = 1000", floor_stiff)});
  draft.tell("the springs' model error", 0.62);
  draft.model_error = spring_model_error(draft.effort);
  draft.keep("spring_model_error", draft.model_error);
  draft.keep("runs", all_runs(draft.runs), false);
  draft.values["exact_ns"] = readable(cost("case a", "exact", 1.0));
  draft.values["exact_error"] = readable(best("case a", "exact"));
  draft.values["exact_error_b"] = readable(best("case b", "exact"));
  draft.values["exact_error_d"] = readable(best("case d", "exact"));
  draft.values["dmv10_2_ns"] = readable(cost("case a", "dmv10", 1e-2));
  draft.values["dmv10_9_ns"] = readable(cost("case a", "dmv10", 1e-9));
  draft.values["rk4_2_ns"] = readable(cost("case a", "rk4", 1e-2));
  draft.values["rk4_6_ns"] = readable(cost("case a", "rk4", 1e-6));
  draft.values["fehlberg_9_ns"] = readable(cost("case a", "odeint fehlberg78", 1e-9));
  draft.values["euler_best"] =
      readable(std::fmin(best("case a", "Euler, matrix"), best("case a", "Euler, quaternion")));
  double stepper_best_b = 4.0;
  double stepper_best_a = 4.0;
  for (const Run& run : draft.runs) {
    if (run.method == "exact" || run.outcome != Outcome::finished) continue;
    if (run.problem == "case b") stepper_best_b = std::min(stepper_best_b, run.error);
    if (run.problem == "case a") stepper_best_a = std::min(stepper_best_a, run.error);
  }
  draft.values["stepper_best_a"] = readable(stepper_best_a);
  draft.values["stepper_best_b"] = readable(stepper_best_b);
  draft.values["composition8_6_ns"] = readable(cost("springs", "composition8", 1e-6));
  draft.values["rk4_springs_6_ns"] = readable(cost("springs", "rk4", 1e-6));
  draft.values["fehlberg_springs_6_ns"] = readable(cost("springs", "odeint fehlberg78", 1e-6));
  draft.values["euler_springs_best"] = readable(best("springs", "explicit Euler"));
  draft.values["springs_from_rigid"] = readable(floor_soft);
  draft.values["stiff_springs_from_rigid"] = readable(floor_stiff);
}

}  // namespace bookspin
