// Scene -> Trajectory: every book of a scene, from the start to the last frame.
//
// All books start from their angular velocity plus jiggle |omega| u, where u is one random unit vector that the scene's
// seed alone decides (Mersenne twister mt19937_64, Marsaglia's rejection in the cube; no library distribution, whose
// results the standard leaves open). Time is frame * time_per_frame, with a whole number of steps a frame.
// Asked to stop, it throws Stopped within some thousand steps.
#pragma once

#include <atomic>
#include <stdexcept>
#include <stop_token>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] Eigen::Vector3d jiggle_direction(std::uint64_t seed);  // |u| = 1

// Of all books, from the start to the last frame; the exact motion takes none.
[[nodiscard]] long steps_of(const Scene& scene);

struct Stopped : std::runtime_error {
  Stopped() : std::runtime_error("stopped") {}
};

// `frames_done`, if any, counts each frame of each book.
[[nodiscard]] Trajectory simulate(const Scene& scene, const std::stop_token& stop = {},
                                  std::atomic<long>* frames_done = nullptr);

}  // namespace bookspin
