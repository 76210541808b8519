// What a film costs, stage by stage: CPU time per 1280x720 frame of Figure 5, the rate of the whole job, peak memory.
//
// CPU time, not wall time: what other programs do on the machine shows in the second and hardly in the first. Each
// stage is the least of several passes over the same frames. Usage: stages_bench [SCENE.toml [TABLE.json]], default
// videos/fig05_unstable_x.toml and no file.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
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

struct Target {
  double value;
  bool at_most;
};

// Prints each row as it comes, and keeps them all.
class Bench {
 public:
  void add(const std::string& name, double value, const std::string& unit, std::optional<Target> target = {}) {
    nlohmann::ordered_json row{{"name", name}, {"value", value}, {"unit", unit}};
    std::string verdict;
    if (target) {
      const bool met = target->at_most ? value <= target->value : value >= target->value;
      row[target->at_most ? "at_most" : "at_least"] = target->value;
      row["met"] = met;
      verdict = fmt::format("  target: at {} {}{}", target->at_most ? "most" : "least", target->value,
                            met ? "" : ", not met");
    }
    fmt::print("{:<44}{:9.3f} {}{}\n", name, value, unit, verdict);
    rows_.push_back(std::move(row));
  }
  [[nodiscard]] const nlohmann::ordered_json& rows() const { return rows_; }

 private:
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

constexpr std::optional<Target> at_most(double value) {
  return Target{value, true};
}
constexpr std::optional<Target> at_least(double value) {
  return Target{value, false};
}

// The name of the OpenGL that drew.
std::string stages(const fs::path& script, const fs::path& folder, Bench& bench) {
  const FrameCost cost = frame_cost(load_scene(script), {1280, 720, 480, 3, project, folder});
  const double together = cost.dynamics + cost.drawing + cost.conversion;
  fmt::print("A 1280x720 frame of {} ({} frames from the middle, {}), CPU time:\n", script.stem().string(), cost.frames,
             cost.renderer);
  bench.add("dynamics", cost.dynamics, "ms");
  bench.add("drawing", cost.drawing, "ms");
  bench.add("conversion", cost.conversion, "ms");
  bench.add("dynamics, drawing, conversion", together, "ms", at_most(4));
  bench.add("encoding", cost.encoding, "ms", at_most(4.5));
  bench.add("a frame", together + cost.encoding, "ms");
  bench.add("peak memory of this film", peak_mb(RUSAGE_SELF), "MB", at_most(400));
  return cost.renderer;
}

void whole_job(const fs::path& folder, Bench& bench) {
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
  fmt::print("The whole job, {} films, {:.0f} frames, by {} workers in {:.1f} s:\n", films.size(), frames, workers,
             seconds);
  bench.add("rate", frames / seconds, "frames/s", at_least(180));
  bench.add("rate with every core to itself", frames * workers / cpu_seconds, "frames/s");
  bench.add("CPU time", cpu_seconds, "s");
  bench.add("at work, of the cores' time", cpu_seconds / (seconds * workers), "", at_least(0.95));
  bench.add("peak memory of a film", peak_mb(RUSAGE_CHILDREN), "MB", at_most(400));
}

}  // namespace

int main(int argc, char** argv) {
  const fs::path script = argc > 1 ? fs::path(argv[1]) : project / "videos" / "fig05_unstable_x.toml";
  const fs::path folder = fs::temp_directory_path() / fmt::format("bookspin-bench-{}", getpid());
  fs::create_directories(folder);
  const unsigned cores = std::thread::hardware_concurrency();
  fmt::print("{}, {} cores\n", BOOKSPIN_COMPILER, cores);
  Bench bench;
  const std::string renderer = stages(script, folder, bench);
  whole_job(folder, bench);
  fs::remove_all(folder);
  if (argc > 2) {
    const nlohmann::ordered_json table{
        {"compiler", BOOKSPIN_COMPILER}, {"cores", cores}, {"renderer", renderer}, {"rows", bench.rows()}};
    std::ofstream(argv[2]) << table.dump(2) << '\n';
  }
  return 0;
}
