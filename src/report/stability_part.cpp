#include <array>
#include <cmath>

#include "report/draft.h"
#include "report/instability.h"
#include "report/plots.h"
#include "report/stability.h"
#include "scene/scene_file.h"

#include <fmt/format.h>

namespace bookspin {
namespace {

// The points of one series: rows whose cell `by` is `name`.
Series series_of(const Table& table, std::size_t by, const std::string& name, std::size_t x, std::size_t y, Mark mark) {
  Series series{name, {}, mark, ""};
  for (const auto& row : table.rows) {
    if (std::get<std::string>(row[by]) == name) series.points.emplace_back(number(row[x]), number(row[y]));
  }
  return series;
}

}  // namespace

void write_stability(Draft& draft) {
  draft.tell("step limits of the springs", 0.66);
  Table limits = step_limits(draft.effort);
  Plot plot{"stiffness k", "largest stable step"};
  for (const char* method :
       {"explicit Euler, damped", "semi-implicit Euler, damped", "velocity Verlet, undamped", "rk4, undamped"}) {
    Series predicted = series_of(limits, 1, method, 0, 2, Mark::line);
    Series measured = series_of(limits, 1, method, 0, 3, Mark::points);
    predicted.title = std::string(method);
    measured.title = "  measured";
    plot.series.push_back(std::move(predicted));
    plot.series.push_back(std::move(measured));
  }
  draw_plot(draft.order.folder / "step_limits.svg", plot);
  double worst = 0.0;
  for (const auto& row : limits.rows) {
    worst = std::fmax(worst, std::abs(number(row[4])));
    if (std::get<double>(row[0]) == 10.0 && std::get<std::string>(row[1]) == "explicit Euler, damped") {
      draft.values["limit_predicted"] = readable(number(row[2]));
      draft.values["limit_measured"] = readable(number(row[3]));
    }
  }
  draft.values["limits_worst"] = readable(worst);
  draft.keep("step_limits", std::move(limits));
  draft.tell("growth of the undamped vibration", 0.72);
  draft.keep("undamped_euler_growth", undamped_euler_growth(draft.effort));
  draft.tell("time to explosion", 0.74);
  Table explosion = time_to_explosion(draft.effort);
  Plot times{"substeps a frame of 0.1", "time to explosion"};
  times.more = {"set key inside left top"};
  times.series = {
      series_of(explosion, 1, "damped", 0, 2, Mark::line), series_of(explosion, 1, "damped", 0, 3, Mark::points),
      series_of(explosion, 1, "undamped", 0, 2, Mark::line), series_of(explosion, 1, "undamped", 0, 3, Mark::points)};
  const std::array<const char*, 4> titles{"damped: predicted", "measured", "undamped: predicted", "measured"};
  for (std::size_t i = 0; i < 4; ++i) {
    times.series[i].name = i < 2 ? "rk4" : "explicit Euler";  // blue and vermillion
    times.series[i].title = titles[i];
  }
  draw_plot(draft.order.folder / "time_to_explosion.svg", times);
  draft.keep("time_to_explosion", std::move(explosion));
  Table hides = what_normalization_hides(load_scene(draft.order.project / "videos" / "normalization_hides.toml"));
  Plot seen{"time", "relative to the start", false, false};
  seen.y_range = "[0:1.2]";
  Series energy{"rk4", {}, Mark::line, "energy"};
  Series momentum{"explicit Euler", {}, Mark::line, "angular momentum"};
  for (const auto& row : hides.rows) {
    energy.points.emplace_back(number(row[0]), number(row[1]));
    momentum.points.emplace_back(number(row[0]), number(row[2]));
  }
  draft.values["hides_energy"] = readable(energy.points.back().second);
  draft.values["hides_momentum"] = readable(momentum.points.back().second);
  draft.values["hides_time"] = readable(energy.points.back().first);
  seen.series = {std::move(energy), std::move(momentum)};
  draw_plot(draft.order.folder / "what_normalization_hides.svg", seen);
  draft.keep("what_normalization_hides", std::move(hides), false);
}

void write_instability(Draft& draft) {
  draft.tell("growth of the tilt", 0.8);
  draft.keep("growth_rates", growth_rates(draft.effort));
  draft.values["sigma"] = fmt::format("{:.5f}", theoretical_growth_rate());
  draft.tell("flip times", 0.82);
  Table flips = flip_times(draft.effort);
  Plot plot{"kick, relative to the spin", "time of the first flip", true, false};
  plot.more = {"set xrange [2e-16:3e-2]", "set xtics add ('none' 3e-16)"};
  for (std::size_t i = 1; i < flips.columns.size(); ++i) {
    const std::string& name = flips.columns[i];
    Series series{name == "springs, Euler (the paper)" ? "springs" : name, {}, i == 1 ? Mark::line : Mark::rings, name};
    if (name == "springs, Verlet") series.name = "velocity Verlet";
    if (name == "springs, composition8") series.name = "composition8";
    if (i > 1 && name != "exact" && name != "Euler, matrix" && name != "Euler, quaternion" && name != "rk4" &&
        name != "dmv10" && series.name == name)
      continue;
    for (const auto& row : flips.rows)
      series.points.emplace_back(number(row[0]) == 0.0 ? 3e-16 : number(row[0]), number(row[i]));
    plot.series.push_back(std::move(series));
  }
  draw_plot(draft.order.folder / "flip_times.svg", plot);
  draft.keep("flip_times", std::move(flips));
}

}  // namespace bookspin
