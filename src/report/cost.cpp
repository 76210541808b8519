#include "report/cost.h"

#include <algorithm>
#include <vector>

#include "film/storyboard.h"
#include "render/renderer.h"
#include "report/measure.h"
#include "scene/simulate.h"
#include "video/i420.h"
#include "video/mp4_writer.h"

namespace bookspin {
FrameCost frame_cost(const Scene& scene, const FrameCostOrder& order) {
  FrameCost cost;
  const int frames = std::min(scene.clip.frames, order.most_frames);
  const int first = (scene.clip.frames - frames) / 2;
  cost.frames = frames;

  Trajectory trajectory;
  cost.dynamics = 1e-6 * least_ns(order.passes, [&] { trajectory = simulate(scene); }) / scene.clip.frames;

  const Storyboard storyboard(scene, trajectory, static_cast<double>(order.width) / order.height);
  Renderer renderer(order.width, order.height, order.assets);
  cost.renderer = renderer.description();
  renderer.draw(storyboard.shot(first));  // compiles the shaders
  cost.drawing = 1e-6 *
                 least_ns(order.passes,
                          [&] {
                            for (int n = 0; n < frames; ++n) renderer.draw(storyboard.shot(first + n));
                          }) /
                 frames;

  const auto pixels = static_cast<std::size_t>(order.width) * static_cast<std::size_t>(order.height);
  std::vector<std::uint8_t> y(pixels), cb(pixels / 4), cr(pixels / 4);
  const I420Planes planes{y.data(), cb.data(), cr.data(), order.width, order.width / 2, order.width / 2};
  cost.conversion = cost.encoding = 1e300;
  for (int pass = 0; pass < order.passes; ++pass) {
    double conversion = 0.0;
    double encoding = 0.0;
    const Part part(order.scratch / "frame_cost.mp4");  // never published
    Mp4Writer film(part, {order.width, order.height, scene.clip.fps, ""});
    for (int n = 0; n < frames; ++n) {
      const Image& picture = renderer.draw(storyboard.shot(first + n));
      const double start = cpu_ns();
      convert_to_i420(picture, renderer.changed(), planes);
      const double converted = cpu_ns();
      film.write(picture, renderer.changed());
      conversion += converted - start;
      encoding += cpu_ns() - converted;
    }
    const double start = cpu_ns();
    film.finish();
    encoding += cpu_ns() - start;
    cost.conversion = std::min(cost.conversion, 1e-6 * conversion / frames);
    cost.encoding = std::min(cost.encoding, 1e-6 * encoding / frames);
  }
  cost.encoding -= cost.conversion;  // the writer converts, too
  return cost;
}

}  // namespace bookspin
