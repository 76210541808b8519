// What a film costs, stage by stage: CPU time per 1280x720 frame of Figure 5, the rate of the whole job, peak memory.
//
// CPU time, not wall time: what other programs do on the machine shows in the second and hardly in the first. Each
// stage is the least of several passes over the same frames. Usage: stages_bench [SCENE.toml], default
// videos/fig05_unstable_x.toml.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <thread>

#include "film/shoot.h"
#include "report/draft.h"
#include "scene/scene_file.h"

namespace {

using namespace bookspin;
namespace fs = std::filesystem;

const fs::path project = BOOKSPIN_SOURCE_DIR;

rusage used_by(int whom) {
  rusage usage{};
  getrusage(whom, &usage);
  return usage;
}

double peak_mb(int whom) {
  return static_cast<double>(used_by(whom).ru_maxrss) / 1024.0;
}

double children_seconds() {
  const rusage usage = used_by(RUSAGE_CHILDREN);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

void stages(const fs::path& script, const fs::path& folder) {
  const FrameCost cost = frame_cost(load_scene(script), {1280, 720, 480, 3, project, folder});
  const double together = cost.dynamics + cost.drawing + cost.conversion;
  fmt::print("CPU-ms per 1280x720 frame of {} ({} frames from the middle, {})\n", script.stem().string(), cost.frames,
             cost.renderer);
  fmt::print("  dynamics    {:7.3f}\n  drawing     {:7.3f}\n  conversion  {:7.3f}\n", cost.dynamics, cost.drawing,
             cost.conversion);
  fmt::print("  together    {:7.3f}   (target: 4)\n", together);
  fmt::print("  encoding    {:7.3f}   (target: 4.5)\n", cost.encoding);
  fmt::print("  a frame     {:7.3f}\n", together + cost.encoding);
  fmt::print("peak memory of this film {:.0f} MB (target: 400)\n", peak_mb(RUSAGE_SELF));
}

void whole_job(const fs::path& folder) {
  std::vector<Film> films;
  for (const auto& entry : fs::directory_iterator(project / "videos")) {
    if (entry.path().extension() == ".toml") films.push_back(load_film(entry.path(), {}));
  }
  std::sort(films.begin(), films.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  Progress progress;
  const auto start = std::chrono::steady_clock::now();
  const std::vector<FilmOutcome> outcomes = shoot_all(films, folder, project, workers, progress);
  for (std::size_t i = 0; i < films.size(); ++i) {
    if (!outcomes[i].error.empty()) fmt::print("{}: {}\n", films[i].file.string(), outcomes[i].error);
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const double cpu_seconds = children_seconds();
  const double frames = static_cast<double>(progress.frames_drawn.load());
  fmt::print("whole job: {} films, {:.0f} frames in {:.1f} s by {} workers: {:.0f} frames/s (target on 2 cores: 180)\n",
             films.size(), frames, seconds, workers, frames / seconds);
  fmt::print("  CPU time {:.1f} s: with every core to itself {:.0f} frames/s\n", cpu_seconds,
             frames * workers / cpu_seconds);
  fmt::print("  peak memory of a film {:.0f} MB\n", peak_mb(RUSAGE_CHILDREN));
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
