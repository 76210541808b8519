// What a film costs, stage by stage: CPU time per 1280x720 frame of Figure 5, the rate of the whole job, peak memory.
//
// CPU time, not wall time: what other programs do on the machine shows in the second and hardly in the first. Each stage is the
// least of several passes over the same frames. Usage: stages_bench [SCENE.toml], default videos/fig05_unstable_x.toml.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <thread>

#include "film/shoot.h"
#include "film/storyboard.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "video/i420.h"
#include "video/mp4_writer.h"

namespace {

using namespace bookspin;
namespace fs = std::filesystem;

constexpr int width = 1280;
constexpr int height = 720;
constexpr int passes = 3;

const fs::path project = BOOKSPIN_SOURCE_DIR;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double peak_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

// Least CPU time of several passes, milliseconds.
template <class Work>
double least(Work&& work) {
  double best = 1e300;
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_ms();
    work();
    best = std::min(best, cpu_ms() - start);
  }
  return best;
}

void stages(const fs::path& script, const fs::path& folder) {
  const Scene scene = load_scene(script);
  const int frames = std::min(scene.clip.frames, 480);
  Trajectory trajectory;
  const double dynamics = least([&] { trajectory = simulate(scene); }) / scene.clip.frames;

  const Storyboard storyboard(scene, trajectory, static_cast<double>(width) / height);
  Renderer renderer(width, height, project);
  const int first = (scene.clip.frames - frames) / 2;
  renderer.draw(storyboard.shot(first));  // compiles the shaders
  const double drawing = least([&] {
                           for (int n = 0; n < frames; ++n) renderer.draw(storyboard.shot(first + n));
                         }) / frames;

  std::vector<std::uint8_t> y(width * height), cb(width * height / 4), cr(width * height / 4);
  const I420Planes planes{y.data(), cb.data(), cr.data(), width, width / 2, width / 2};
  double conversion = 0.0;
  for (int n = 0; n < frames; ++n) {
    const Image& picture = renderer.draw(storyboard.shot(first + n));
    const double start = cpu_ms();
    convert_to_i420(picture, renderer.changed(), planes);
    conversion += cpu_ms() - start;
  }
  conversion /= frames;

  double encoding = 0.0;
  {
    Mp4Writer film(folder / "stages.mp4", {width, height, scene.clip.fps, ""});
    for (int n = 0; n < frames; ++n) {
      const Image& picture = renderer.draw(storyboard.shot(first + n));
      const double start = cpu_ms();
      film.write(picture, renderer.changed());
      encoding += cpu_ms() - start;
    }
    const double start = cpu_ms();
    film.finish();
    encoding += cpu_ms() - start;
  }
  encoding = encoding / frames - conversion;

  fmt::print("CPU-ms per {}x{} frame of {} ({} frames from the middle, {})\n", width, height, script.stem().string(), frames,
             renderer.description());
  fmt::print("  dynamics    {:7.3f}\n  drawing     {:7.3f}\n  conversion  {:7.3f}\n", dynamics, drawing, conversion);
  fmt::print("  together    {:7.3f}   (floor: 10)\n", dynamics + drawing + conversion);
  fmt::print("  encoding    {:7.3f}\n", encoding);
  fmt::print("  a frame     {:7.3f}\n", dynamics + drawing + conversion + encoding);
  fmt::print("peak memory of this film {:.0f} MB (floor: 400)\n", peak_mb());
}

void whole_job(const fs::path& folder) {
  std::vector<FilmOrder> orders;
  for (const auto& entry : fs::directory_iterator(project / "videos")) {
    if (entry.path().extension() == ".toml") orders.push_back({entry.path(), folder, {}});
  }
  std::sort(orders.begin(), orders.end(), [](const auto& a, const auto& b) { return a.script < b.script; });
  const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Progress progress;
  const double cpu = cpu_ms();
  const auto start = std::chrono::steady_clock::now();
  for (const FilmOutcome& outcome : shoot_all(orders, project, workers, progress)) {
    if (!outcome.error.empty()) fmt::print("{}: {}\n", outcome.order.script.string(), outcome.error);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu_seconds = (cpu_ms() - cpu) / 1e3;
  const double frames = static_cast<double>(progress.frames_done.load());
  fmt::print("whole job: {} films, {:.0f} frames in {:.1f} s by {} workers: {:.0f} frames/s (floor on 2 cores: 80)\n",
             orders.size(), frames, seconds, workers, frames / seconds);
  fmt::print("  CPU time {:.1f} s: with every core to itself {:.0f} frames/s\n", cpu_seconds, frames * workers / cpu_seconds);
  fmt::print("  peak memory {:.0f} MB\n", peak_mb());
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path script = argc > 1 ? fs::path(argv[1]) : project / "videos" / "fig05_unstable_x.toml";
  const fs::path folder = fs::temp_directory_path() / fmt::format("bookspin-bench-{}", getpid());
  fs::create_directories(folder);
  fmt::print("{}, {} cores\n", BOOKSPIN_COMPILER, std::thread::hardware_concurrency());
  stages(script, folder);
  whole_job(folder);
  fs::remove_all(folder);
  return 0;
}
