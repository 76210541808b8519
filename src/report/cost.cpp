#include "report/cost.h"

#include <algorithm>
#include <ctime>
#include <vector>

#include "film/storyboard.h"
#include "render/renderer.h"
#include "scene/simulate.h"
#include "video/i420.h"
#include "video/mp4_writer.h"

namespace bookspin {
namespace {

template <class Work>
double least(int passes, Work&& work) {
  double best = 1e300;
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_ms();
    work();
    best = std::min(best, cpu_ms() - start);
  }
  return best;
}

}  // namespace

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

FrameCost frame_cost(const Scene& scene, const FrameCostOrder& order) {
  FrameCost cost;
  const int frames = std::min(scene.clip.frames, order.most_frames);
  const int first = (scene.clip.frames - frames) / 2;
  cost.frames = frames;

  Trajectory trajectory;
  cost.dynamics = least(order.passes, [&] { trajectory = simulate(scene); }) / scene.clip.frames;

  const Storyboard storyboard(scene, trajectory, static_cast<double>(order.width) / order.height);
  Renderer renderer(order.width, order.height, order.assets);
  cost.renderer = renderer.description();
  renderer.draw(storyboard.shot(first));  // compiles the shaders
  cost.drawing = least(order.passes,
                       [&] {
                         for (int n = 0; n < frames; ++n) renderer.draw(storyboard.shot(first + n));
                       }) /
                 frames;

  const auto pixels = static_cast<std::size_t>(order.width) * static_cast<std::size_t>(order.height);
  std::vector<std::uint8_t> y(pixels), cb(pixels / 4), cr(pixels / 4);
  const I420Planes planes{y.data(), cb.data(), cr.data(), order.width, order.width / 2, order.width / 2};
  const std::filesystem::path file = order.scratch / "frame_cost.mp4";
  cost.conversion = cost.encoding = 1e300;
  for (int pass = 0; pass < order.passes; ++pass) {
    double conversion = 0.0;
    double encoding = 0.0;
    Mp4Writer film(file, {order.width, order.height, scene.clip.fps, ""});
    for (int n = 0; n < frames; ++n) {
      const Image& picture = renderer.draw(storyboard.shot(first + n));
      const double start = cpu_ms();
      convert_to_i420(picture, renderer.changed(), planes);
      const double converted = cpu_ms();
      film.write(picture, renderer.changed());
      conversion += converted - start;
      encoding += cpu_ms() - converted;
    }
    const double start = cpu_ms();
    film.finish();
    encoding += cpu_ms() - start;
    cost.conversion = std::min(cost.conversion, conversion / frames);
    cost.encoding = std::min(cost.encoding, encoding / frames);
  }
  std::filesystem::remove(file);
  cost.encoding -= cost.conversion;  // the writer converts, too
  return cost;
}

}  // namespace bookspin
