// Scene -> Trajectory: every book of a scene, from the start to the last frame (scene/book_run.h).
//
// Asked to stop, it throws Stopped within some thousand steps.
#pragma once

#include <atomic>
#include <stdexcept>
#include <stop_token>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

// Of all books, from the start to the last frame; the exact motion takes none.
[[nodiscard]] long steps_of(const Scene& scene);

struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped") {}
};

// `frames_done`, if any, counts each frame of each book.
[[nodiscard]] Trajectory simulate(const Scene& scene, const std::stop_token& stop = {},
                                  std::atomic<long>* frames_done = nullptr);

}  // namespace bookspin
