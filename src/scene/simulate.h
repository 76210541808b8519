// Scene -> Trajectory: every book of a scene, from the start to the last frame.
//
// All books start from their angular velocity plus jiggle |omega| u, where u is one random unit vector that the scene's
// seed alone decides (Mersenne twister mt19937_64, Marsaglia's rejection in the cube; no library distribution, whose
// results the standard leaves open). Time is frame * time_per_frame, with a whole number of steps a frame.
#pragma once

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] Eigen::Vector3d jiggle_direction(std::uint64_t seed);  // |u| = 1

[[nodiscard]] Trajectory simulate(const Scene& scene);

}  // namespace bookspin
