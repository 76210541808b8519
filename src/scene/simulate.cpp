#include "scene/simulate.h"

#include <algorithm>

#include "scene/book_run.h"

namespace bookspin {

long steps_of(const Scene& scene) {
  const auto stepping = std::count_if(scene.books.begin(), scene.books.end(),
                                      [](const BookSetup& book) { return book.method != Method::exact; });
  return static_cast<long>(scene.clip.frames - 1) * scene.clip.substeps * stepping;
}

Trajectory simulate(const Scene& scene, const std::stop_token& stop, std::atomic<long>* frames_done) {
  std::atomic<long> nobody_counts = 0;
  std::atomic<long>& counter = frames_done == nullptr ? nobody_counts : *frames_done;
  const auto look = [&stop] {
    if (stop.stop_requested()) throw Stopped();
  };
  Trajectory trajectory;
  for (const BookSetup& setup : scene.books) {
    BookRun run(setup, scene.clip, scene.seed);
    ++counter;
    for (int frame = 1; frame < scene.clip.frames; ++frame) {
      look();
      run.advance(look);
      ++counter;
    }
    trajectory.books.push_back(std::move(run).take());
  }
  return trajectory;
}

}  // namespace bookspin
