#include "cli/commands.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <thread>

#include "cli/watch.h"
#include "files/files.h"
#include "film/shoot.h"
#include "image/png.h"
#include "page/page.h"
#include "report/report.h"
#include "scene/judge.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "scene/trajectory_csv.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

const fs::path project = BOOKSPIN_PROJECT_DIR;  // shaders, textures and videos are read from there

[[noreturn]] void fail_option(const char* option, const std::string& found, const std::string& allowed) {
  throw std::invalid_argument(fmt::format("{}: found '{}'; allowed: {}", option, found, allowed));
}

// A whole number that is the entire text; nothing when it is not.
std::optional<int> whole_number(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

MadeWith made_with(const Options& options) {
  MadeWith result;
  result.overrides = options.overrides;
  const auto x = options.size.find('x');
  const auto width = whole_number(std::string_view(options.size).substr(0, x));
  const auto height =
      x == std::string::npos ? std::nullopt : whole_number(std::string_view(options.size).substr(x + 1));
  const auto fits = [](std::optional<int> n) { return n && *n >= 16 && *n <= 4096 && *n % 2 == 0; };
  if (!fits(width) || !fits(height))
    fail_option("--size", options.size, "WxH, both even and from 16 to 4096, such as 1280x720");
  result.width = *width;
  result.height = *height;
  if (!options.frames.empty()) {
    const std::string_view text = options.frames;
    const auto colon = text.find(':');
    const std::string_view from = text.substr(0, colon);
    const std::string_view to = colon == std::string_view::npos ? "?" : text.substr(colon + 1);
    const auto first = from.empty() ? 0 : whole_number(from);
    const auto end = to.empty() ? -1 : whole_number(to);
    if (!first || !end || *first < 0 || (!to.empty() && *end <= *first)) {
      fail_option("--frames", options.frames, "A:B with 0 <= A < B, such as 0:120");
    }
    result.first_frame = *first;
    result.end_frame = *end;
  }
  return result;
}

int cores() {
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::size_t unmet(const std::vector<Verdict>& verdicts) {
  return static_cast<std::size_t>(
      std::count_if(verdicts.begin(), verdicts.end(), [](const Verdict& v) { return !v.met; }));
}

// "5 of 5 expectations met", and each one that is not.
void print_verdicts(const std::vector<Verdict>& verdicts, bool all) {
  for (const Verdict& v : verdicts) {
    if (all || !v.met) {
      fmt::print("    {} {}\n          {}\n", v.met ? "met:    " : "NOT MET:", v.says.empty() ? "(unnamed)" : v.says,
                 v.text);
    }
  }
}

std::string met_of(const std::vector<Verdict>& verdicts) {
  return fmt::format("{} of {} expectations met", verdicts.size() - unmet(verdicts), verdicts.size());
}

// The scene scripts of a folder, sorted by name: at least one.
std::vector<fs::path> scripts_in(const fs::path& folder) {
  std::error_code error;
  std::vector<fs::path> scripts;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".toml") scripts.push_back(entry.path());
  }
  if (error) throw std::runtime_error(fmt::format("{}: cannot be listed: {}", folder.string(), error.message()));
  if (scripts.empty()) throw std::runtime_error(fmt::format("{}: holds no scene scripts (*.toml)", folder.string()));
  std::sort(scripts.begin(), scripts.end());
  return scripts;
}

}  // namespace

int list_scenes(const Options& options) {
  const std::vector<fs::path> scripts =
      scripts_in(options.folder.empty() ? project / "videos" : fs::path(options.folder));
  for (const fs::path& script : scripts) {
    const Scene scene = load_scene(script, options.overrides);
    const double seconds = static_cast<double>(scene.clip.frames) / scene.clip.fps;
    fmt::print("{:36}  {:>7}  {}\n", script.filename().string(),
               scene.clip.frames == 1 ? "still" : fmt::format("{:.1f} s", seconds), scene.title);
  }
  return 0;
}

int render_scenes(const Options& options) {
  const fs::path folder = options.folder.empty() ? project / "videos" / "site" : fs::path(options.folder);
  const std::vector<fs::path> inputs{project / "shaders", project / "textures", "/proc/self/exe"};
  std::vector<FilmOrder> orders;
  for (const std::string& scene : options.scenes) {
    FilmOrder order{scene, folder, made_with(options)};
    for (const FilmOrder& other : orders) {
      if (other.script.stem() == order.script.stem()) {
        throw std::invalid_argument(fmt::format("{} and {} would make the same film", other.script.string(), scene));
      }
    }
    if (!options.update || !is_up_to_date(order, inputs)) orders.push_back(order);
  }
  if (orders.empty()) {
    fmt::print("{} films up to date in {}\n", options.scenes.size(), folder.string());
    return 0;
  }
  long frames = 0;
  for (const FilmOrder& order : orders) {
    const Scene scene = load_order(order);
    frames +=
        (order.made_with.end_frame < 0 ? scene.clip.frames : order.made_with.end_frame) - order.made_with.first_frame;
  }

  Progress progress;
  std::vector<FilmOutcome> outcomes;
  double seconds = 0.0;
  {
    Watch watch(progress, frames, static_cast<int>(orders.size()));
    outcomes = shoot_all(orders, project, options.jobs > 0 ? options.jobs : cores(), progress);
    seconds = watch.seconds();
  }
  int made = 0;
  bool good = true;
  for (const FilmOutcome& outcome : outcomes) {
    if (!outcome.receipt) {
      good = false;
      fmt::print(stderr, "bookspin: {}: {}\n", outcome.order.script.filename().string(), outcome.error);
      continue;
    }
    const FilmReceipt& r = *outcome.receipt;
    ++made;
    good = good && unmet(r.verdicts) == 0;
    fmt::print("{:34} {:5} frames {:6.2f} s {:>9}  {}\n", r.product.filename().string(), r.frames,
               static_cast<double>(r.frames) / r.fps, readable_size(r.bytes), met_of(r.verdicts));
    print_verdicts(r.verdicts, false);
  }
  fmt::print("{} of {} made in {}, {} frames in {:.1f} s ({:.0f} frames/s)\n", made, orders.size(), folder.string(),
             progress.frames_done.load(), seconds, static_cast<double>(progress.frames_done.load()) / seconds);
  if (orders.size() < options.scenes.size())
    fmt::print("{} more were up to date\n", options.scenes.size() - orders.size());
  if (progress.stop) throw Stopped();
  return good ? 0 : 1;
}

int draw_scene_frame(const Options& options) {
  const MadeWith size = made_with(options);
  const Scene scene = load_scene(options.scenes.front(), options.overrides);
  if (options.frame < 0 || options.frame >= scene.clip.frames) {
    fail_option("--frame", std::to_string(options.frame), fmt::format("0 to {}", scene.clip.frames - 1));
  }
  write_png(options.output, draw_frame(scene, options.frame, size.width, size.height, project));
  return 0;
}

int check_scenes(const Options& options) {
  bool good = true;
  for (const std::string& file : options.scenes) {
    const Scene scene = load_scene(file, options.overrides);
    const std::vector<Verdict> verdicts = judge(scene, simulate(scene));
    good = good && unmet(verdicts) == 0;
    fmt::print("{}: {}\n", fs::path(file).filename().string(), met_of(verdicts));
    print_verdicts(verdicts, true);
  }
  return good ? 0 : 1;
}

int write_trajectory(const Options& options) {
  const Scene scene = load_scene(options.scenes.front(), options.overrides);
  const Trajectory trajectory = simulate(scene);
  const auto write = [&](std::ostream& out) {
    out << trajectory_csv_header() << '\n';
    for (int frame = 0; out && frame < scene.clip.frames; ++frame) out << trajectory_csv_rows(scene, trajectory, frame);
  };
  if (!options.output.empty()) {
    write_file(options.output, write);
    return 0;
  }
  write(std::cout);
  std::cout.flush();
  if (!std::cout) throw std::runtime_error(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
  return 0;
}

int report(const Options& options) {
  const fs::path folder = options.folder.empty() ? project / "videos" / "site" / "report" : fs::path(options.folder);
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  make_report({folder, project, options.quick}, [&](std::string_view what, double done) {
    if (terminal) fmt::print(stderr, "\r\x1b[K{:3.0f} %  {:4.0f} s  {}", 100.0 * done, seconds(), what);
    std::fflush(stderr);
  });
  if (terminal) fmt::print(stderr, "\r\x1b[K");
  fmt::print("{} in {:.0f} s\n", (folder / "index.html").string(), seconds());
  return 0;
}

int make_page(const Options& options) {
  const fs::path folder = options.folder.empty() ? project / "videos" / "site" : fs::path(options.folder);
  const PageReceipt page = write_page({folder, project / "videos" / "page"});
  fmt::print("{}: {} film{}, {}\n", page.file.string(), page.films, page.films == 1 ? "" : "s",
             readable_size(page.bytes));
  return 0;
}

}  // namespace bookspin
