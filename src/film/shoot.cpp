#include "film/shoot.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "files/files.h"
#include "film/storyboard.h"
#include "image/png.h"
#include "scene/scene_file.h"
#include "video/mp4_writer.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

fs::path product(const FilmOrder& order, const char* extension) {
  return order.folder / (order.script.stem().string() + extension);
}

int end_frame(const FilmOrder& order, const Scene& scene) {
  return order.made_with.end_frame < 0 ? scene.clip.frames : order.made_with.end_frame;
}

bool is_still(const Scene& scene) {
  return scene.clip.frames == 1;
}

// Newest change of a file, or of anything in a folder.
fs::file_time_type newest(const fs::path& path) {
  fs::file_time_type time = fs::last_write_time(path);
  if (fs::is_directory(path)) {
    for (const auto& entry : fs::recursive_directory_iterator(path)) time = std::max(time, entry.last_write_time());
  }
  return time;
}

}  // namespace

Scene load_order(const FilmOrder& order) {
  Scene scene = load_scene(order.script, order.made_with.overrides);
  const int end = end_frame(order, scene);
  if (order.made_with.first_frame < 0 || order.made_with.first_frame >= end || end > scene.clip.frames) {
    throw std::invalid_argument(fmt::format("{}: found frames {}:{}; allowed: A:B with 0 <= A < B <= {}",
                                            order.script.string(), order.made_with.first_frame, end,
                                            scene.clip.frames));
  }
  return scene;
}

FilmReceipt shoot(const FilmOrder& order, Renderer& renderer, Progress& progress) {
  const Scene scene = load_order(order);
  const Trajectory trajectory = simulate(scene);
  const int first = order.made_with.first_frame;
  const int end = end_frame(order, scene);
  const MadeWith& made_with = order.made_with;
  fs::create_directories(order.folder);

  FilmReceipt receipt;
  receipt.product = product(order, is_still(scene) ? ".png" : ".mp4");
  receipt.frames = end - first;
  receipt.fps = scene.clip.fps;
  receipt.verdicts = judge(scene, trajectory);

  const Storyboard storyboard(scene, trajectory, static_cast<double>(made_with.width) / made_with.height);
  std::optional<Mp4Writer> film;
  if (!is_still(scene)) {
    film.emplace(receipt.product, Mp4Writer::Settings{made_with.width, made_with.height, scene.clip.fps, scene.title});
  }
  const int poster_frame = first + (end - first) / 2;
  Image poster;
  for (int frame = first; frame < end; ++frame) {
    if (progress.stop) throw Stopped();
    const Image& picture = renderer.draw(storyboard.shot(frame));
    if (film) film->write(picture, renderer.changed());
    if (frame == poster_frame) poster = picture;
    ++progress.frames_done;
  }
  if (film) film->finish();
  write_png(product(order, ".png"), poster);
  write_film_data(product(order, ".json"), {scene, trajectory, receipt.verdicts, read_file(order.script),
                                            film ? receipt.product.filename().string() : "",
                                            product(order, ".png").filename().string(), made_with});
  receipt.bytes = fs::file_size(receipt.product);
  ++progress.films_done;
  return receipt;
}

std::vector<FilmOutcome> shoot_all(std::span<const FilmOrder> orders, const fs::path& assets, int workers,
                                   Progress& progress) {
  std::vector<FilmOutcome> outcomes;
  std::vector<long> lengths;
  for (const FilmOrder& order : orders) {
    outcomes.push_back({order, {}, {}});
    const Scene scene = load_order(order);
    lengths.push_back(static_cast<long>(end_frame(order, scene) - order.made_with.first_frame) *
                      static_cast<long>(scene.books.size()));
  }
  std::vector<std::size_t> queue(orders.size());
  std::iota(queue.begin(), queue.end(), 0U);
  std::stable_sort(queue.begin(), queue.end(), [&](std::size_t a, std::size_t b) { return lengths[a] > lengths[b]; });

  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    std::optional<Renderer> renderer;
    for (std::size_t i = next++; i < queue.size(); i = next++) {
      FilmOutcome& outcome = outcomes[queue[i]];
      try {
        if (!renderer) renderer.emplace(outcome.order.made_with.width, outcome.order.made_with.height, assets);
        outcome.receipt = shoot(outcome.order, *renderer, progress);
      } catch (const std::exception& error) {
        outcome.error = error.what();
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < std::min<int>(workers, static_cast<int>(orders.size())); ++i) threads.emplace_back(work);
  threads.clear();  // joins
  return outcomes;
}

bool is_up_to_date(const FilmOrder& order, std::span<const fs::path> inputs) {
  const fs::path data = product(order, ".json");
  const fs::path poster = product(order, ".png");
  if (!fs::exists(data) || !fs::exists(poster) || !was_made_with(data, order.made_with)) return false;
  const bool still = is_still(load_order(order));
  if (!still && !fs::exists(product(order, ".mp4"))) return false;
  const fs::file_time_type made = fs::last_write_time(data);
  fs::file_time_type changed = newest(order.script);
  for (const fs::path& input : inputs) changed = std::max(changed, newest(input));
  return changed <= made;
}

Image draw_frame(const Scene& scene, int frame, int width, int height, const fs::path& assets) {
  const Trajectory trajectory = simulate(scene);
  const Storyboard storyboard(scene, trajectory, static_cast<double>(width) / height);
  return Renderer(width, height, assets).draw(storyboard.shot(frame));
}

}  // namespace bookspin
