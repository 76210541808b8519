// What a film costs, stage by stage: CPU time per 1280x720 frame of Figure 5, the rate of the whole job, peak memory;
// and beside it the program ffmpeg, where it is installed: its rate when it only encodes, and what veryfast at a rate
// factor of 20 makes of a piece of every film.
//
// CPU time, not wall time: what other programs do on the machine shows in the second and hardly in the first. Each
// stage is the least of several passes over the same frames. Usage: stages_bench [SCENE.toml [TABLE.json]], default
// videos/fig05_unstable_x.toml and no file.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "film/shoot.h"
#include "film/storyboard.h"
#include "report/draft.h"
#include "scene/scene_file.h"
#include "video/film_writer.h"
#include "video/i420.h"

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

const int workers = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));

template <class Work>
double seconds_of(Work&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Job {
  double seconds, cpu_seconds, frames;
  [[nodiscard]] double rate() const { return frames / seconds; }
  [[nodiscard]] double at_work() const { return cpu_seconds / (seconds * workers); }
};

Job shoot(const std::vector<Film>& films, const fs::path& folder) {
  Progress progress;
  const double before = children_seconds();
  const double seconds = seconds_of([&] {
    const std::vector<FilmOutcome> outcomes = shoot_all(films, folder, project, workers, progress);
    for (std::size_t i = 0; i < films.size(); ++i) {
      if (!outcomes[i].error.empty()) fmt::print("{}: {}\n", films[i].file.string(), outcomes[i].error);
    }
  });
  return {seconds, children_seconds() - before, static_cast<double>(progress.frames_drawn.load())};
}

std::vector<fs::path> all_scripts() {
  std::vector<fs::path> scripts;
  for (const auto& entry : fs::directory_iterator(project / "videos")) {
    if (entry.path().extension() == ".toml") scripts.push_back(entry.path());
  }
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

void whole_job(const fs::path& folder, Bench& bench) {
  std::vector<Film> films;
  for (const fs::path& script : all_scripts()) films.push_back(load_film(script, {}));
  const Job job = shoot(films, folder);
  fmt::print("The whole job, {} films, {:.0f} frames, by {} workers in {:.1f} s:\n", films.size(), job.frames, workers,
             job.seconds);
  bench.add("rate", job.rate(), "frames/s", at_least(180));
  bench.add("rate with every core to itself", job.frames * workers / job.cpu_seconds, "frames/s");
  bench.add("CPU time", job.cpu_seconds, "s");
  bench.add("at work, of the cores' time", job.at_work(), "", at_least(0.95));
  bench.add("peak memory of a film", peak_mb(RUSAGE_CHILDREN), "MB", at_most(400));
}

void one_film(const fs::path& script, const fs::path& folder, Bench& bench) {
  const Job job = shoot({load_film(script, {})}, folder);
  fmt::print("{} alone, by {} workers in {:.1f} s:\n", script.stem().string(), workers, job.seconds);
  bench.add("at work, of the cores' time", job.at_work(), "", at_least(0.85));
}

// Frames from the middle of a film, as ffmpeg reads them.
struct Piece {
  Film film;
  fs::path ready;  // the frames, not encoded: YUV4MPEG2
};

Piece piece_of(const fs::path& script, int frames, const fs::path& folder) {
  const int all = load_scene(script).clip.frames;
  FilmSettings settings;
  settings.first_frame = std::max(0, (all - frames) / 2);
  settings.end_frame = std::min(all, settings.first_frame + frames);
  Piece piece{load_film(script, settings), folder / (script.stem().string() + ".y4m")};
  const Film& film = piece.film;
  const Trajectory trajectory = simulate(film.scene);
  const Storyboard storyboard(film.scene, trajectory, film.width, film.height);
  Renderer renderer(film.width, film.height, project);
  std::ofstream out(piece.ready, std::ios::binary);
  out << fmt::format("YUV4MPEG2 W{} H{} F{}:1 Ip A1:1 C420mpeg2 XCOLORRANGE=LIMITED\n", film.width, film.height,
                     film.scene.clip.fps);
  const auto pixels = static_cast<std::size_t>(film.width) * static_cast<std::size_t>(film.height);
  std::vector<std::uint8_t> planes(pixels * 3 / 2);
  std::uint8_t* const cb = planes.data() + pixels;
  for (int frame = film.first_frame; frame < std::min(film.end_frame, storyboard.frames()); ++frame) {
    const Image& picture = renderer.draw(storyboard.shot(frame));
    convert_to_i420(picture, picture.bounds(),
                    {planes.data(), cb, cb + pixels / 4, film.width, film.width / 2, film.width / 2});
    out << "FRAME\n";
    out.write(reinterpret_cast<const char*>(planes.data()), static_cast<std::streamsize>(planes.size()));
  }
  return piece;
}

// What the program ffmpeg says.
std::string ffmpeg(const std::string& arguments) {
  FILE* const pipe = popen(("ffmpeg -nostdin -hide_banner -y " + arguments + " 2>&1").c_str(), "r");
  std::string said;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) said += static_cast<char>(c);
  if (pclose(pipe) != 0) throw std::runtime_error("ffmpeg " + arguments + ":\n" + said);
  return said;
}

std::string encoding(const fs::path& from, const std::string& settings, const fs::path& to) {
  std::string options;
  std::istringstream in(settings);
  for (std::string option; std::getline(in, option, ';');) {
    const std::size_t equals = option.find('=');
    options += fmt::format(" -{}:v '{}'", option.substr(0, equals), option.substr(equals + 1));
  }
  return fmt::format("-i {} -c:v libx264 -threads 1 -g 60{} {}", from.string(), options, to.string());
}

// CPU seconds.
double ffmpeg_encodes(const fs::path& from, const std::string& settings, const fs::path& to) {
  const std::string said = ffmpeg("-benchmark " + encoding(from, settings, to));
  return std::stod(said.substr(said.rfind("utime=") + std::string("utime=").size()));
}

double luma_psnr(const fs::path& film, const fs::path& ready) {
  const std::string said = ffmpeg(fmt::format("-i {} -i {} -lavfi psnr -f null -", film.string(), ready.string()));
  return std::stod(said.substr(said.rfind("PSNR y:") + std::string("PSNR y:").size()));
}

void beside_ffmpeg(const fs::path& folder, Bench& bench) {
  const fs::path reference = folder / "reference.mp4";
  const std::string veryfast = "preset=veryfast;crf=20";
  double ours = 0.0, theirs = 0.0, lost = 0.0, our_seconds = 0.0, their_seconds = 0.0;
  int encoded = 0;
  for (const fs::path& script : all_scripts()) {
    const Piece piece = piece_of(script, 120, folder);
    shoot({piece.film}, folder);
    const fs::path film = products(piece.film, folder).film;
    if (fs::exists(film)) {
      our_seconds += ffmpeg_encodes(piece.ready, mp4_settings(), reference);
      their_seconds += ffmpeg_encodes(piece.ready, veryfast, reference);
      ours += static_cast<double>(fs::file_size(film));
      theirs += static_cast<double>(fs::file_size(reference));
      lost += luma_psnr(reference, piece.ready) - luma_psnr(film, piece.ready);
      ++encoded;
    }
    fs::remove(piece.ready);
  }
  fmt::print("120 frames of every film, against ffmpeg's veryfast at a rate factor of 20:\n");
  bench.add("encoding, of its time", our_seconds / their_seconds, "", at_most(0.58));
  bench.add("bytes, of its", ours / theirs, "", at_most(1.2));
  bench.add("luma PSNR lost, mean", lost / encoded, "dB", at_most(0.3));

  // One film a core.
  std::vector<Piece> pieces;
  for (const fs::path& script : all_scripts()) {
    constexpr int long_enough = 480;
    if (std::ssize(pieces) < workers && load_scene(script).clip.frames >= long_enough)
      pieces.push_back(piece_of(script, long_enough, folder));
  }
  std::vector<Film> films;
  for (const Piece& piece : pieces) films.push_back(piece.film);
  const Job job = shoot(films, folder);
  const double seconds = seconds_of([&] {
    std::vector<std::future<std::string>> running;
    for (const Piece& piece : pieces) {
      running.push_back(
          std::async(std::launch::async, ffmpeg,
                     encoding(piece.ready, mp4_settings(), fs::path(piece.ready).replace_extension("mp4"))));
    }
    for (auto& one : running) one.get();
  });
  fmt::print(
      "{} films, {:.0f} frames, a film a core, beside ffmpeg that encodes them ready drawn, with the same settings:\n",
      films.size(), job.frames);
  bench.add("rate", job.rate(), "frames/s");
  bench.add("ffmpeg's rate", job.frames / seconds, "frames/s");
  bench.add("of ffmpeg's", job.rate() * seconds / job.frames, "", at_least(0.6));
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // a row when it is measured, into a file too
  const fs::path script = argc > 1 ? fs::path(argv[1]) : project / "videos" / "fig05_unstable_x.toml";
  const fs::path folder = fs::temp_directory_path() / fmt::format("bookspin-bench-{}", getpid());
  fs::create_directories(folder);
  const unsigned cores = std::thread::hardware_concurrency();
  fmt::print("{}, {} cores\n", BOOKSPIN_COMPILER, cores);
  Bench bench;
  const std::string renderer = stages(script, folder, bench);
  whole_job(folder, bench);
  one_film(script, folder, bench);
  if (std::system("ffmpeg -version >/dev/null 2>&1") == 0) {
    beside_ffmpeg(folder, bench);
  } else {
    fmt::print("ffmpeg is not installed: what stands beside it is left out.\n");
  }
  fs::remove_all(folder);
  if (argc > 2) {
    const nlohmann::ordered_json table{
        {"compiler", BOOKSPIN_COMPILER}, {"cores", cores}, {"renderer", renderer}, {"rows", bench.rows()}};
    std::ofstream(argv[2]) << table.dump(2) << '\n';
  }
  return 0;
}
