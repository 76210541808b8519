#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "film/storyboard.h"
#include "render/renderer.h"
#include "report/draft.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "video/film_writer.h"
#include "video/i420.h"

namespace bookspin {

FrameCost frame_cost(const Scene& scene, const FrameCostOrder& order) {
  const int frames = std::min(scene.clip.frames, order.most_frames);
  const int first = (scene.clip.frames - frames) / 2;
  Trajectory trajectory;
  const double dynamics = least_ns(order.passes, [&] { trajectory = simulate(scene); });

  const Storyboard storyboard(scene, trajectory, order.width, order.height);
  Renderer renderer(order.width, order.height, order.assets);
  const auto draw_all = [&] {
    for (int n = 0; n < frames; ++n) renderer.draw(storyboard.shot(first + n));
  };
  renderer.draw(storyboard.shot(first));  // compiles the shaders
  const double drawing = least_ns(order.passes, draw_all);

  const auto pixels = static_cast<std::size_t>(order.width) * static_cast<std::size_t>(order.height);
  std::vector<std::uint8_t> y(pixels), cb(pixels / 4), cr(pixels / 4);
  const I420Planes planes{y.data(), cb.data(), cr.data(), order.width, order.width / 2, order.width / 2};
  double conversion = none;
  double writing = none;  // which converts, too
  for (int pass = 0; pass < order.passes; ++pass) {
    const Part part(order.scratch / "frame_cost.mp4");  // never published
    FilmWriter film(part, {order.width, order.height, scene.clip.fps, ""});
    double converting = 0.0;
    double all = 0.0;
    for (int n = 0; n < frames; ++n) {
      const Image& picture = renderer.draw(storyboard.shot(first + n));
      converting += least_ns(1, [&] {
        for (const Rect& rect : renderer.changed()) convert_to_i420(picture, rect, planes);
      });
      all += least_ns(1, [&] { film.write(picture, renderer.changed()); });
    }
    all += least_ns(1, [&] { film.finish(); });
    conversion = std::min(conversion, converting);
    writing = std::min(writing, all);
  }
  const double ms = 1e-6 / frames;
  return {.dynamics = 1e-6 * dynamics / scene.clip.frames,
          .drawing = ms * drawing,
          .conversion = ms * conversion,
          .encoding = ms * (writing - conversion),
          .frames = frames,
          .renderer = renderer.description()};
}

void frame_costs(Draft& draft) {
  constexpr double frame = 0.5;  // of the paper's films of rotation: simulated time
  FrameCostOrder order{1280, 720, 240, 2, draft.order.project, draft.order.folder};
  if (draft.effort.quick) order = {320, 180, 20, 1, draft.order.project, draft.order.folder};
  const Scene scene = load_scene(draft.order.project / "videos" / "fig05_unstable_x.toml");
  const FrameCost cost = frame_cost(scene, order);
  const double rest = cost.drawing + cost.conversion + cost.encoding;
  const double all = cost.dynamics + rest;
  const auto part = [](double ms, double whole) { return readable(100.0 * ms / whole) + " %"; };
  Table table{{"stage", "CPU milliseconds a frame", "part"},
              {{fmt::format("dynamics: damped springs, {} steps, all measures", scene.clip.substeps), cost.dynamics},
               {"drawing (OpenGL on the CPU)", cost.drawing},
               {"conversion to Y'CbCr", cost.conversion},
               {"encoding (H.264)", cost.encoding},
               {"all", all}}};
  for (std::vector<Cell>& row : table.rows) row.emplace_back(part(row[1], all));
  draft.keep("frame_cost", table);

  // Of the rigid methods, each at the smallest error that it reached.
  double dearest = 0.0;
  for (const Ladder& ladder : draft.runs[Problem::case_a]) {
    const Run nearest = ladder.nearest();
    if (!ladder.solver.odeint && nearest.error < none) dearest = std::max(dearest, 1e-6 * nearest.ns_per_time * frame);
  }
  draft.page["frame"] = {{"time", frame},
                         {"dynamics_ms", cost.dynamics},
                         {"steps", scene.clip.substeps},
                         {"rest_ms", rest},
                         {"size", fmt::format("{}×{}", order.width, order.height)},
                         {"renderer", cost.renderer},
                         {"dearest_us", 1e3 * dearest},
                         {"dearest_part", part(dearest, dearest + rest)}};
}

}  // namespace bookspin
