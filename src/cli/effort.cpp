#include "cli/effort.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "scene/simulate.h"

namespace bookspin {
namespace {

// Largest sizes of a process that makes a film, measured with Mesa 22.3 from 320x180 to 4096x4096, and a tenth more.
constexpr double megabyte = 1e6;
constexpr double bytes_of_the_program = 680 * megabyte;
constexpr double bytes_of_a_pixel = 125;

// For an estimate to the minute; a frame of 1280x720 takes 10 to 14 ms of one core (docs/NUMBERS.md).
constexpr double seconds_of_a_frame = 3e-3;
constexpr double seconds_of_a_pixel = 8e-9;
constexpr double seconds_of_measuring = 1e-5;  // a book in a frame

// By a trial: some integrators take a hundred times as long as others.
double seconds_of_a_step(Scene scene) {
  constexpr int steps = 2000;
  constexpr int short_frames = 2;
  scene.clip.time_per_frame *= std::min(1.0, static_cast<double>(steps) / scene.clip.substeps);
  scene.clip.substeps = std::min(scene.clip.substeps, steps);
  scene.clip.frames = short_frames;
  const auto start = std::chrono::steady_clock::now();
  (void)simulate(scene);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return took.count() / static_cast<double>(steps_of(scene));
}

}  // namespace

void require_room(int width, int height) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  const double needed = bytes_of_the_program + bytes_of_a_pixel * width * height;
  if (static_cast<double>(limit.rlim_cur) >= needed) return;
  throw std::runtime_error(fmt::format(
      "memory is limited to {:.0f} MB (ulimit -v), and pictures of {}x{} need {:.0f} MB: raise the limit, or "
      "choose a smaller --size; check, list and trajectory need less",
      static_cast<double>(limit.rlim_cur) / megabyte, width, height, std::ceil(needed / megabyte)));
}

std::string announcement(const Scene& scene, const std::optional<Drawing>& drawing) {
  const auto steps = static_cast<double>(steps_of(scene));
  double seconds = seconds_of_measuring * scene.clip.frames * static_cast<double>(scene.books.size());
  if (drawing) {
    seconds += drawing->frames * (seconds_of_a_frame + seconds_of_a_pixel * drawing->width * drawing->height);
  }
  constexpr double steps_worth_a_trial = 1e6;
  if (steps > steps_worth_a_trial) seconds += steps * seconds_of_a_step(scene);
  if (seconds < 60.0) return {};
  const std::string frames = drawing
                                 ? fmt::format("{} frames of {}x{}, {:.1f} s long", drawing->frames, drawing->width,
                                               drawing->height, static_cast<double>(drawing->frames) / scene.clip.fps)
                                 : fmt::format("{} frames", scene.clip.frames);
  return fmt::format("{}; {:.0f} steps; about {:.0f} min to {}", frames, steps, std::ceil(seconds / 60.0),
                     drawing ? "make" : "simulate");
}

}  // namespace bookspin
