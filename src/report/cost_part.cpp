#include <fmt/format.h>

#include <algorithm>

#include "report/draft.h"
#include "report/plots.h"
#include "report/work_precision.h"
#include "scene/scene_file.h"

namespace bookspin {

void write_cost(Draft& draft) {
  draft.tell("cost of a film's frame", 0.88);
  FrameCostOrder order{1280, 720, 240, 2, draft.order.project, draft.order.folder};
  if (draft.order.quick) order = {320, 180, 20, 1, draft.order.project, draft.order.folder};
  const Scene scene = load_scene(draft.order.project / "videos" / "fig05_unstable_x.toml");
  draft.cost = frame_cost(scene, order);
  const double all = draft.cost.dynamics + draft.cost.drawing + draft.cost.conversion + draft.cost.encoding;
  Table table{"", {"stage", "CPU milliseconds a frame", "part"}, {}};
  for (const auto& [stage, ms] :
       {std::pair{"dynamics: damped springs, 30 explicit Euler steps, all measures", draft.cost.dynamics},
        std::pair{"drawing (OpenGL on the CPU)", draft.cost.drawing},
        std::pair{"conversion to Y'CbCr", draft.cost.conversion}, std::pair{"encoding (H.264)", draft.cost.encoding},
        std::pair{"all", all}}) {
    table.rows.push_back({stage, ms, fmt::format("{:.1f} %", 100.0 * ms / all)});
  }
  draft.keep("frame_cost", std::move(table));
  draft.values["frame_ms"] = readable(all);
  draft.values["renderer"] = escape_text(draft.cost.renderer);

  // A frame of the paper's rotation films is half a unit of time: case a's runs give each method's cost of one at each
  // error.
  constexpr double frame = 0.5;
  Table accuracy{
      "", {"dynamics of one frame (0.5)", "error reached in case a", "CPU microseconds", "part of the frame"}, {}};
  Plot plot{"largest error in case a, radians", "CPU milliseconds a frame"};
  plot.x_range = "[1e-15:10]";
  plot.y_range = "[1e-5:100]";
  const double rest = draft.cost.drawing + draft.cost.conversion + draft.cost.encoding;
  plot.more = {
      fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead lc rgb '#000000' lw 1.5 dt 2", rest),
      fmt::format("set label 'drawing and encoding: {:.1f} ms' at graph 0.02, first {} offset 0, 0.6", rest, rest)};
  for (const char* method : {"exact", "dmv10", "dmv6", "rk4", "Euler, quaternion", "Euler, matrix"}) {
    Series series{method, {}, Mark::line_and_points, ""};
    std::vector<Run> sorted;
    for (Run run : draft.runs) {
      if (run.problem != "case a" || run.method != method || run.outcome != Outcome::finished || run.setting > frame)
        continue;
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
  draw_plot(draft.order.folder / "accuracy_in_a_film.svg", plot);
  draft.keep("accuracy_in_a_film", std::move(accuracy));
}

}  // namespace bookspin
