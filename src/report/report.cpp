#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/claims.h"
#include "report/cost.h"
#include "report/instability.h"
#include "report/machine.h"
#include "report/page.h"
#include "report/plots.h"
#include "report/stability.h"
#include "report/table.h"
#include "report/work_precision.h"
#include "scene/scene_file.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

constexpr double fall_back = 20.0;  // where a work-precision plot shows runs without an error

double number(const Cell& cell) {
  const double* value = std::get_if<double>(&cell);
  return value == nullptr ? std::nan("") : *value;
}

// The points of one series: rows whose cell `by` is `name`.
Series series_of(const Table& table, std::size_t by, const std::string& name, std::size_t x, std::size_t y, Mark mark) {
  Series series{name, {}, mark, ""};
  for (const auto& row : table.rows) {
    if (std::get<std::string>(row[by]) == name) series.points.emplace_back(number(row[x]), number(row[y]));
  }
  return series;
}

void plot_work_precision(const fs::path& svg, const std::vector<Run>& runs, const std::string& problem, double Run::*error, const char* y_label) {
  Plot plot{"nanoseconds for one unit of simulated time", y_label};
  plot.y_range = fmt::format("[{}:60]", error != &Run::error ? "1e-2" : problem == "springs" ? "1e-11" : "1e-16");
  plot.more = {fmt::format("set ytics add ('diverged' {})", fall_back)};
  std::vector<std::string> methods;
  for (const Run& run : runs) {
    if (run.problem == problem && std::find(methods.begin(), methods.end(), run.method) == methods.end()) methods.push_back(run.method);
  }
  for (const std::string& method : methods) {
    Series line{method, {}, Mark::line_and_points, ""};
    Series crosses{method, {}, Mark::cross, "-"};
    for (const Run& run : runs) {
      if (run.problem != problem || run.method != method) continue;
      if (run.outcome == Outcome::finished) {
        line.points.emplace_back(run.ns_per_time, std::max(run.*error, 1e-16));
      } else {
        crosses.points.emplace_back(run.ns_per_time, fall_back);
      }
    }
    plot.series.push_back(std::move(line));
    plot.series.push_back(std::move(crosses));
  }
  draw_plot(svg, plot);
}

class Maker {
 public:
  Maker(const ReportOrder& order, const Tell& tell) : order_(order), tell_(tell), folder_(order.folder) {
    effort_.quick = order.quick;
    if (order.quick) effort_ = {1.0, 1, 3.0, true};
  }

  void make() {
    fs::create_directories(folder_);
    work_precision();
    stability();
    instability();
    cost();
    claims();
    finish();
  }

 private:
  // The parts' shares of the whole are those of a full run.
  void tell(const std::string& what, double done) const { tell_(what, done); }

  void keep(const std::string& key, Table table, bool on_page = true) {
    table.name = key;
    write_file(folder_ / (key + ".csv"), as_csv(table));
    if (on_page) values_[key] = as_html(table);
    tables_.push_back(std::move(table));
  }

  void work_precision() {
    const fs::path reference = order_.project / "tests" / "data" / "reference";
    const std::vector<double> errors{1e-2, 1e-4, 1e-6, 1e-9};
    double done = 0.0;
    for (const RigidCase& c : read_rigid_cases(reference)) {
      tell("speed against error, case " + c.letter, done);
      done += 0.12;
      Effort effort = effort_;
      if (c.letter == "d") effort.longest_run_ms *= 4.0;  // a thousand times as many turns
      rigid_work_precision(c, effort, runs_);
      keep("cheapest_" + c.letter, cheapest(runs_, "case " + c.letter, errors));
      plot_work_precision(folder_ / ("work_precision_" + c.letter + ".svg"), runs_, "case " + c.letter, &Run::error, "largest error, radians");
    }
    tell("speed against error, springs", done);
    Effort effort = effort_;
    effort.longest_run_ms *= effort_.quick ? 20.0 : 6.0;
    effort.repeats = effort_.quick ? 1 : 2;
    spring_work_precision(reference, effort, runs_);
    keep("cheapest_springs", cheapest(runs_, "springs", errors));
    plot_work_precision(folder_ / "work_precision_springs.svg", runs_, "springs", &Run::error, "largest error, half diagonals, from the springs' own motion");
    plot_work_precision(folder_ / "work_precision_springs_rigid.svg", runs_, "springs", &Run::other_error, "largest distance, half diagonals, from the rigid motion");
    tell("the springs' model error", 0.62);
    model_error_ = spring_model_error(effort_);
    keep("spring_model_error", model_error_);
    keep("runs", all_runs(runs_), false);
    const auto best = [&](const std::string& problem, const std::string& method) {
      double error = std::nan("");
      for (const Run& run : runs_) {
        if (run.problem == problem && run.method == method) error = std::fmin(error, run.error);
      }
      return error;
    };
    const auto cost = [&](const std::string& problem, const std::string& method, double error) {
      double ns = std::nan("");
      for (const Run& run : runs_) {
        if (run.problem == problem && run.method == method && run.error <= error) ns = std::fmin(ns, run.ns_per_time);
      }
      return ns;
    };
    values_["exact_ns"] = readable(cost("case a", "exact", 1.0));
    values_["exact_error"] = readable(best("case a", "exact"));
    values_["exact_error_b"] = readable(best("case b", "exact"));
    values_["exact_error_d"] = readable(best("case d", "exact"));
    values_["dmv10_2_ns"] = readable(cost("case a", "dmv10", 1e-2));
    values_["dmv10_9_ns"] = readable(cost("case a", "dmv10", 1e-9));
    values_["rk4_2_ns"] = readable(cost("case a", "rk4", 1e-2));
    values_["rk4_6_ns"] = readable(cost("case a", "rk4", 1e-6));
    values_["fehlberg_9_ns"] = readable(cost("case a", "odeint fehlberg78", 1e-9));
    values_["euler_best"] = readable(std::fmin(best("case a", "Euler, matrix"), best("case a", "Euler, quaternion")));
    double stepper_best_b = 4.0;
    double stepper_best_a = 4.0;
    for (const Run& run : runs_) {
      if (run.method == "exact" || run.outcome != Outcome::finished) continue;
      if (run.problem == "case b") stepper_best_b = std::min(stepper_best_b, run.error);
      if (run.problem == "case a") stepper_best_a = std::min(stepper_best_a, run.error);
    }
    values_["stepper_best_a"] = readable(stepper_best_a);
    values_["stepper_best_b"] = readable(stepper_best_b);
    values_["composition8_6_ns"] = readable(cost("springs", "composition8", 1e-6));
    values_["rk4_springs_6_ns"] = readable(cost("springs", "rk4", 1e-6));
    values_["fehlberg_springs_6_ns"] = readable(cost("springs", "odeint fehlberg78", 1e-6));
    values_["euler_springs_best"] = readable(best("springs", "explicit Euler"));
    double from_rigid = std::nan("");
    for (const Run& run : runs_) {
      if (run.problem == "springs" && run.error < 1e-6) from_rigid = std::fmin(from_rigid, run.other_error);
    }
    values_["springs_from_rigid"] = readable(from_rigid);
  }

  void stability() {
    tell("step limits of the springs", 0.66);
    Table limits = step_limits(effort_);
    Plot plot{"stiffness k", "largest stable step"};
        for (const char* method : {"explicit Euler, damped", "semi-implicit Euler, damped", "velocity Verlet, undamped", "rk4, undamped"}) {
      Series predicted = series_of(limits, 1, method, 0, 2, Mark::line);
      Series measured = series_of(limits, 1, method, 0, 3, Mark::points);
      predicted.title = std::string(method);
      measured.title = "  measured";
      plot.series.push_back(std::move(predicted));
      plot.series.push_back(std::move(measured));
    }
    draw_plot(folder_ / "step_limits.svg", plot);
    for (const auto& row : limits.rows) {
      if (std::get<double>(row[0]) == 10.0 && std::get<std::string>(row[1]) == "explicit Euler, damped") {
        values_["limit_predicted"] = readable(number(row[2]));
        values_["limit_measured"] = readable(number(row[3]));
      }
    }
    keep("step_limits", std::move(limits));
    tell("growth of the undamped vibration", 0.72);
    keep("undamped_euler_growth", undamped_euler_growth(effort_));
    tell("time to explosion", 0.74);
    Table explosion = time_to_explosion(effort_);
    Plot times{"substeps a frame of 0.1", "time to explosion"};
    times.more = {"set key inside left top"};
    times.series = {series_of(explosion, 1, "damped", 0, 2, Mark::line), series_of(explosion, 1, "damped", 0, 3, Mark::points),
                    series_of(explosion, 1, "undamped", 0, 2, Mark::line), series_of(explosion, 1, "undamped", 0, 3, Mark::points)};
    const std::array<const char*, 4> titles{"damped: predicted", "measured", "undamped: predicted", "measured"};
    for (std::size_t i = 0; i < 4; ++i) {
      times.series[i].name = i < 2 ? "rk4" : "explicit Euler";  // blue and vermillion
      times.series[i].title = titles[i];
    }
    draw_plot(folder_ / "time_to_explosion.svg", times);
    keep("time_to_explosion", std::move(explosion));
    Table hides = what_normalization_hides(load_scene(order_.project / "videos" / "normalization_hides.toml"));
    Plot seen{"time", "relative to the start", false, false};
    seen.y_range = "[0:1.2]";
    Series energy{"rk4", {}, Mark::line, "energy"};
    Series momentum{"explicit Euler", {}, Mark::line, "angular momentum"};
    for (const auto& row : hides.rows) {
      energy.points.emplace_back(number(row[0]), number(row[1]));
      momentum.points.emplace_back(number(row[0]), number(row[2]));
    }
    values_["hides_energy"] = readable(energy.points.back().second);
    values_["hides_momentum"] = readable(momentum.points.back().second);
    values_["hides_time"] = readable(energy.points.back().first);
    seen.series = {std::move(energy), std::move(momentum)};
    draw_plot(folder_ / "what_normalization_hides.svg", seen);
    keep("what_normalization_hides", std::move(hides), false);
  }

  void instability() {
    tell("growth of the tilt", 0.8);
    keep("growth_rates", growth_rates(effort_));
    values_["sigma"] = fmt::format("{:.5f}", theoretical_growth_rate());
    tell("flip times", 0.82);
    Table flips = flip_times(effort_);
    Plot plot{"kick, relative to the spin", "time of the first flip", true, false};
    plot.more = {"set xrange [2e-16:3e-2]", "set xtics add ('none' 3e-16)"};
    for (std::size_t i = 1; i < flips.columns.size(); ++i) {
      const std::string& name = flips.columns[i];
      Series series{name == "springs, Euler (the paper)" ? "springs" : name, {}, i == 1 ? Mark::line : Mark::rings, name};
      if (name == "springs, Verlet") series.name = "velocity Verlet";
      if (name == "springs, composition8") series.name = "composition8";
      if (i > 1 && name != "exact" && name != "Euler, matrix" && name != "Euler, quaternion" && name != "rk4" && name != "dmv10" && series.name == name) continue;
      for (const auto& row : flips.rows) series.points.emplace_back(number(row[0]) == 0.0 ? 3e-16 : number(row[0]), number(row[i]));
      plot.series.push_back(std::move(series));
    }
    draw_plot(folder_ / "flip_times.svg", plot);
    keep("flip_times", std::move(flips));
  }

  void cost() {
    tell("cost of a film's frame", 0.88);
    FrameCostOrder order{1280, 720, 240, 2, order_.project, folder_};
    if (order_.quick) order = {320, 180, 20, 1, order_.project, folder_};
    const Scene scene = load_scene(order_.project / "videos" / "fig05_unstable_x.toml");
    cost_ = frame_cost(scene, order);
    const double all = cost_.dynamics + cost_.drawing + cost_.conversion + cost_.encoding;
    Table table{"", {"stage", "CPU milliseconds a frame", "part"}, {}};
    for (const auto& [stage, ms] : {std::pair{"dynamics: damped springs, 30 explicit Euler steps, all measures", cost_.dynamics},
                                    std::pair{"drawing (OpenGL on the CPU)", cost_.drawing}, std::pair{"conversion to Y'CbCr", cost_.conversion},
                                    std::pair{"encoding (H.264)", cost_.encoding}, std::pair{"all", all}}) {
      table.rows.push_back({stage, ms, fmt::format("{:.1f} %", 100.0 * ms / all)});
    }
    keep("frame_cost", std::move(table));
    values_["frame_ms"] = readable(all);
    values_["renderer"] = escape_text(cost_.renderer);

    // A frame of the paper's rotation films is half a unit of time: case a's runs give each method's cost of one at each error.
    constexpr double frame = 0.5;
    Table accuracy{"", {"dynamics of one frame (0.5)", "error reached in case a", "CPU microseconds", "part of the frame"}, {}};
    Plot plot{"largest error in case a, radians", "CPU milliseconds a frame"};
    plot.x_range = "[1e-15:10]";
    const double rest = cost_.drawing + cost_.conversion + cost_.encoding;
    plot.more = {fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead lc rgb '#000000' lw 1.5 dt 2", rest),
                 fmt::format("set label 'drawing and encoding: {:.1f} ms' at graph 0.02, first {} offset 0, 0.6", rest, rest)};
    for (const char* method : {"exact", "dmv10", "dmv6", "rk4", "Euler, quaternion", "Euler, matrix"}) {
      Series series{method, {}, Mark::line_and_points, ""};
      std::vector<Run> sorted;
      for (Run run : runs_) {
        if (run.problem != "case a" || run.method != method || run.outcome != Outcome::finished || run.setting > frame) continue;
        if (run.setting == 0.0) run.ns_per_time = exact_evaluation_ns() / frame;  // one a frame
        sorted.push_back(run);
      }
      std::sort(sorted.begin(), sorted.end(), [](const Run& a, const Run& b) { return a.ns_per_time < b.ns_per_time; });
      double best = 1e300;
      for (const Run& run : sorted) {  // only runs that no cheaper one beats
        if (run.error >= best) continue;
        best = run.error;
        series.points.emplace_back(run.error, run.ns_per_time * frame * 1e-6);
      }
      if (!series.points.empty()) {
        const auto& [error, ms] = series.points.back();
        accuracy.rows.push_back({method, error, 1e3 * ms, fmt::format("{:.3f} %", 100.0 * ms / (ms + rest))});
      }
      plot.series.push_back(std::move(series));
    }
    draw_plot(folder_ / "accuracy_in_a_film.svg", plot);
    keep("accuracy_in_a_film", std::move(accuracy));
  }

  void claims() {
    const Facts facts{runs_, cost_.dynamics, model_error_};
    Table table = claims_table(order_.project, facts, effort_, [this](std::string_view what, double done) {
      tell("the paper's claims: " + std::string(what).substr(0, 40), 0.91 + 0.09 * done);
    });
    write_file(folder_ / "claims.csv", as_csv(table));
    std::string html;
    std::map<std::string, int> count;
    for (const auto& row : table.rows) {
      const auto text = [&row](std::size_t i) { return escape_text(std::get<std::string>(row[i])); };
      ++count[text(2)];
      std::string style = text(2);
      std::replace(style.begin(), style.end(), ' ', '-');
      html += fmt::format(
          "<li class=\"{}\"><p class=\"claim\"><span class=\"verdict\">{}</span> {} <span class=\"section\">section {}</span></p><p>{}</p>"
          "<details><summary>Show it again</summary><pre>{}</pre></details></li>\n",
          style, text(2), text(1), text(0), text(3), text(4));
    }
    values_["claims"] = html;
    values_["claims_count"] = fmt::format("{} supported, {} limited, {} refuted, {} not to be measured", count["supported"], count["limited"], count["refuted"], count["not measured"]);
    table.name = "claims";
    tables_.push_back(std::move(table));
  }

  void finish() {
    tell("writing the page", 1.0);
    const Machine machine = this_machine(order_.project);
    values_["processor"] = escape_text(machine.processor);
    values_["cores"] = std::to_string(machine.cores);
    values_["compiler"] = escape_text(machine.compiler);
    values_["flags"] = escape_text(machine.flags);
    values_["commit"] = escape_text(machine.commit);
    values_["repeats"] = std::to_string(effort_.repeats);
    values_["longest_ms"] = readable(effort_.longest_run_ms);
    values_["quick"] = order_.quick ? "<p class=\"note\"><strong>A quick run, for tests: too few and too short runs to be read.</strong></p>" : "";
    write_file(folder_ / "report.json", as_json(tables_, {{"processor", machine.processor},
                                                          {"cores", std::to_string(machine.cores)},
                                                          {"compiler", machine.compiler},
                                                          {"flags", machine.flags},
                                                          {"commit", machine.commit}}));
    write_file(folder_ / "index.html", fill_page(order_.project / "videos" / "report" / "page.html", values_));
  }

  const ReportOrder& order_;
  const Tell& tell_;
  fs::path folder_;
  Effort effort_;
  std::vector<Run> runs_;
  Table model_error_;
  FrameCost cost_;
  std::vector<Table> tables_;
  PageValues values_;
};

}  // namespace

void make_report(const ReportOrder& order, const Tell& tell) { Maker(order, tell).make(); }

}  // namespace bookspin
