#include "cli/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <stdexcept>
#include <thread>

#include "cli/assets.h"
#include "cli/effort.h"
#include "cli/standard_output.h"
#include "cli/version.h"
#include "cli/watch.h"
#include "files/files.h"
#include "film/film_data.h"
#include "film/shoot.h"
#include "film/storyboard.h"
#include "image/compare.h"
#include "image/png.h"
#include "page/page.h"
#include "page/verify.h"
#include "report/report.h"
#include "scene/doubts.h"
#include "scene/judge.h"
#include "scene/scene_file.h"
#include "scene/scene_json.h"
#include "scene/simulate.h"
#include "scene/trajectory_csv.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

// "1 film", "3 films".
template <typename Number>
std::string counted(Number count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// To standard error, where a line is rewritten. That nobody reads it is no reason to stop: fmt::print would throw.
void tell(const std::string& text) {
  std::fputs(text.c_str(), stderr);
  std::fflush(stderr);
}

fs::path folder_or(const std::string& folder, const fs::path& otherwise) {
  return folder.empty() ? otherwise : fs::path(folder);
}

// What a script holds; nothing, with its message shown, when it cannot be read: others may be good.
template <class Load>
auto try_load(const Load& load) -> std::optional<decltype(load())> {
  try {
    return load();
  } catch (const Stopped&) {
    throw;
  } catch (const std::exception& error) {
    complain(error.what());
    return {};
  }
}

// No font at all is no matter of a check, and an error of the drawing.
void remark(const std::string& script, const Scene& scene) {
  for (const std::string& what : remarks_on(scene)) complain(fmt::format("{}: {}", script, what));
  try {
    for (const std::string& characters : lacking_characters(scene)) {
      complain(fmt::format("{}: {}: not in the font, drawn as a box", script, characters));
    }
  } catch (const std::runtime_error&) {
  }
}

void announce(const std::string& script, const Scene& scene, const std::optional<Drawing>& drawing = {}) {
  const std::string effort = announcement(scene, drawing);
  if (!effort.empty()) complain(fmt::format("{}: {}", script, effort));
}

Trajectory simulate_watched(const std::string& script, const Scene& scene, const std::stop_token& stop) {
  announce(script, scene);
  Progress progress;
  const Watch watch(progress, scene);
  return simulate(scene, stop, &progress.frames_simulated);
}

void refuse_to_replace(const fs::path& script, const fs::path& output) {
  std::error_code ignored;  // of an output that does not exist
  if (fs::equivalent(script, output, ignored)) {
    throw WrongCall(fmt::format("--output: found '{}'; allowed: not the script itself", output.string()));
  }
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
      print(fmt::format("    {} {}\n          {}\n",
                        v.met ? "met:    " : "NOT MET:", v.says.empty() ? "(unnamed)" : v.says, v.text));
    }
  }
}

std::string met_of(const std::vector<Verdict>& verdicts) {
  if (verdicts.empty()) return "nothing expected";
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
  const fs::path folder = options.folder.empty() ? find_assets(options.assets) / "videos" : fs::path(options.folder);
  bool good = true;
  for (const fs::path& script : scripts_in(folder)) {
    const auto scene = try_load([&] { return load_scene(script, options.overrides); });
    good = good && scene;
    if (!scene) continue;
    const double seconds = static_cast<double>(scene->clip.frames) / scene->clip.fps;
    print(fmt::format("{:36}  {:>7}  {}\n", script.filename().string(),
                      scene->clip.frames == 1 ? "still" : fmt::format("{:.1f} s", seconds), scene->title));
  }
  return good ? 0 : 1;
}

int render_scenes(const Options& options) {
  const Interrupts interrupts;
  const fs::path folder = folder_or(options.folder, "site");
  const fs::path assets = find_assets(options.assets);
  require_room(options.width, options.height);
  const FilmSettings settings{options.width,
                              options.height,
                              options.format,
                              options.first_frame,
                              options.end_frame,
                              options.overrides,
                              fingerprint_of_drawing(assets)};
  std::vector<Film> films;
  std::vector<std::string> not_made;  // names of scripts
  for (const std::string& script : options.scenes) {
    for (const std::string& other : options.scenes) {
      if (&other != &script && fs::path(other).stem() == fs::path(script).stem()) {
        throw WrongCall(fmt::format("{} and {} would make the same film", other, script));
      }
    }
    if (Interrupts::last_signal() != 0) {
      not_made.push_back(fs::path(script).filename().string());
      continue;
    }
    const std::optional<bool> is_due = try_load([&] {
      Film film = load_film(script, settings);
      if (options.update && is_up_to_date(film, products(film, folder))) return false;
      require_products(film, folder);
      remark(film.file.filename().string(), film.scene);
      announce(film.file.filename().string(), film.scene, Drawing{film.frames(), film.width, film.height});
      films.push_back(std::move(film));
      return true;
    });
    if (!is_due) not_made.push_back(fs::path(script).filename().string());
  }
  const std::size_t up_to_date = options.scenes.size() - films.size() - not_made.size();

  Progress progress;
  bool good = not_made.empty();
  if (!films.empty()) {
    std::vector<FilmOutcome> outcomes;
    double seconds = 0.0;
    {
      const Watch watch(progress, films);
      outcomes = shoot_all(films, folder, assets, options.jobs > 0 ? options.jobs : cores(), progress, [&] {
        watch.print_line();
        return Interrupts::last_signal() == 0;
      });
      seconds = watch.seconds();
    }
    for (std::size_t i = 0; i < films.size(); ++i) {
      const Film& film = films[i];
      const FilmOutcome& outcome = outcomes[i];
      const std::string script = film.file.filename().string();
      if (!outcome.error.empty()) complain(fmt::format("{}: {}", script, outcome.error));
      if (!outcome.receipt) {
        good = false;
        not_made.push_back(script);
        continue;
      }
      const FilmReceipt& r = *outcome.receipt;
      good = good && unmet(r.verdicts) == 0;
      const double length = static_cast<double>(r.frames) / film.scene.clip.fps;
      print(fmt::format("{:34} {:21} {:>9}  {}\n", r.product.filename().string(),
                        film.is_still()
                            ? "    still"
                            : fmt::format("{:5} {:6} {:6.2f} s", r.frames, r.frames == 1 ? "frame" : "frames", length),
                        readable_size(r.bytes), met_of(r.verdicts)));
      print_verdicts(r.verdicts, false);
    }
    const long drawn = progress.frames_drawn;
    const std::string rate = drawn > 1 ? fmt::format(" ({:.0f} frames/s)", static_cast<double>(drawn) / seconds) : "";
    print(fmt::format("{} of {} made in {}, {} in {:.1f} s{}\n", progress.films_done.load(),
                      options.scenes.size() - up_to_date, folder.string(), counted(drawn, "frame"), seconds, rate));
  }
  if (up_to_date > 0) print(fmt::format("{} up to date in {}\n", counted(up_to_date, "film"), folder.string()));
  if (!not_made.empty()) print(fmt::format("not made: {}\n", fmt::join(not_made, ", ")));
  if (Interrupts::last_signal() != 0) {
    complain(Stopped().what());
    return 128 + Interrupts::last_signal();
  }
  return good ? 0 : 1;
}

int draw_scene_frame(const Options& options) {
  const fs::path assets = find_assets(options.assets);
  refuse_to_replace(options.scenes.front(), options.output);
  const Scene scene = load_scene(options.scenes.front(), options.overrides);
  if (options.frame >= scene.clip.frames) {
    throw std::invalid_argument(fmt::format("{}: found frame {}; allowed: 0 to {}", options.scenes.front(),
                                            options.frame, scene.clip.frames - 1));
  }
  require_room(options.width, options.height);
  announce(options.scenes.front(), scene);
  Part picture(options.output);
  write_png(picture, draw_frame(scene, options.frame, options.width, options.height, assets, options.stop));
  publish({&picture});
  return 0;
}

int check_scenes(const Options& options) {
  std::size_t met = 0;
  std::size_t failed = 0;
  std::vector<std::string> not_read;
  for (const std::string& file : options.scenes) {
    const std::string script = fs::path(file).filename().string();
    const auto verdicts = try_load([&] {
      const Scene scene = load_scene(file, options.overrides);
      remark(script, scene);
      const Trajectory trajectory = simulate_watched(script, scene, options.stop);
      for (const Doubt& doubt : doubts_about(scene, trajectory)) {
        complain(
            fmt::format("{}: book.{}: more than {} rad from the exact book from frame {} on, at most {:.2g}, and "
                        "nothing in the film says so: {}",
                        script, doubt.book, visible_error, doubt.frame, doubt.error, doubt.why));
      }
      return judge(scene, trajectory);
    });
    if (!verdicts) {
      not_read.push_back(script);
      continue;
    }
    ++(unmet(*verdicts) == 0 ? met : failed);
    print(fmt::format("{}: {}\n", script, met_of(*verdicts)));
    print_verdicts(*verdicts, true);
  }
  if (options.scenes.size() > 1) {
    print(fmt::format("{}: {} as expected, {} not\n", counted(options.scenes.size(), "script"), met, failed));
    if (!not_read.empty()) print(fmt::format("not checked: {}\n", fmt::join(not_read, ", ")));
  }
  return failed == 0 && not_read.empty() ? 0 : 1;
}

int write_trajectory(const Options& options) {
  refuse_to_replace(options.scenes.front(), options.output);
  const Scene scene = load_scene(options.scenes.front(), options.overrides);
  std::optional<Part> file;
  if (!options.output.empty()) file.emplace(options.output);
  const Trajectory trajectory = simulate_watched(options.scenes.front(), scene, options.stop);
  const auto write = [&](std::ostream& out) {
    out << trajectory_csv_header() << '\n';
    for (int frame = 0; out && frame < scene.clip.frames; ++frame) {
      if (options.stop.stop_requested()) throw Stopped();
      out << trajectory_csv_rows(scene, trajectory, frame);
    }
  };
  if (file) {
    write_part(*file, write);
    publish({&*file});
    return 0;
  }
  write(std::cout);
  finish_output();
  return 0;
}

int print_scene(const Options& options) {
  print_data(scene_json(load_scene(options.scenes.front(), options.overrides)) + '\n');
  return 0;
}

int report(const Options& options) {
  const fs::path folder = folder_or(options.folder, fs::path("site") / "report");
  const bool terminal = isatty(STDERR_FILENO) == 1;
  const auto start = std::chrono::steady_clock::now();
  const auto seconds = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  make_report({folder, find_assets(options.assets), options.quick, commit()}, [&](std::string_view what) {
    if (terminal) tell(fmt::format("\r\x1b[K{:4.0f} s  {}", seconds(), what));
  });
  if (terminal) tell("\r\x1b[K");
  print(fmt::format("{} in {:.0f} s\n", (folder / "index.html").string(), seconds()));
  return 0;
}

int make_page(const Options& options) {
  const fs::path assets = find_assets(options.assets);
  PageOrder order{folder_or(options.folder, "site"), assets / "videos" / "page"};
  if (const std::optional<fs::path> module = find_live_module(assets)) {
    order.live = LiveParts{*module, assets / "shaders", assets / "textures"};
  }
  const PageReceipt page = write_page(order);
  print(fmt::format("{}: {}, {}\n", page.file.string(), counted(page.films, "film"), readable_size(page.bytes)));
  return 0;
}

int verify_products(const Options& options) {
  const fs::path folder = folder_or(options.folder, "site");
  const std::vector<Finding> findings = verify(folder);
  const auto good = std::count_if(findings.begin(), findings.end(), [](const Finding& f) { return f.whole && f.met; });
  for (const Finding& f : findings) {
    const char* verdict = !f.whole ? "DAMAGED" : !f.met ? "NOT MET" : "whole";
    print(fmt::format("{:36}  {:7}  {}\n", f.file, verdict, f.says));
  }
  print(fmt::format("{}: {} of {} as they should be\n", folder.string(), good, findings.size()));
  return good == static_cast<std::ptrdiff_t>(findings.size()) ? 0 : 1;
}

int compare_pictures(const Options& options) {
  const auto picture = [](const std::string& file) {
    try {
      return read_png(file);
    } catch (const std::runtime_error& error) {
      throw WrongCall(error.what());
    }
  };
  const Image a = picture(options.pictures[0]);
  const Image b = picture(options.pictures[1]);
  const ImageDelta delta = compare(a, b, options.threshold);
  if (!delta.same_size) {
    print(fmt::format("{} is {}x{}, {} is {}x{}\n", options.pictures[0], a.width, a.height, options.pictures[1],
                      b.width, b.height));
    return 1;
  }
  print(fmt::format("max delta {}, mean {:.4g}, {:.4g} % of pixels off by more than {}\n{}", delta.max_delta,
                    delta.mean_delta, 100.0 * delta.share_above, counted(options.threshold, "level"),
                    worst_pixels(a, b, 10)));
  if (!options.output.empty()) write_png(options.output, delta_picture(a, b));
  const bool unbounded = !options.max_delta && !options.mean_delta && !options.share;
  return delta.max_delta <= options.max_delta.value_or(unbounded ? 0 : 255) &&
                 delta.mean_delta <= options.mean_delta.value_or(HUGE_VAL) &&
                 delta.share_above <= options.share.value_or(1.0)
             ? 0
             : 1;
}

}  // namespace bookspin
