// One book of a scene, frame after frame.
//
// It starts from its angular velocity plus jiggle |omega| u, where u is one random unit vector that the scene's seed
// alone decides (Mersenne twister mt19937_64, Marsaglia's rejection in the cube; no library distribution, whose results
// the standard leaves open). Time is frame * time_per_frame, with a whole number of steps a frame.
#pragma once

#include <functional>
#include <memory>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] Eigen::Vector3d jiggle_direction(std::uint64_t seed);  // |u| = 1

class BookRun {
 public:
  BookRun(const BookSetup& setup, const Clip& clip, std::uint64_t seed);  // at frame 0
  ~BookRun();
  BookRun(BookRun&&) noexcept;

  void advance(const std::function<void()>& look = {});  // one frame on; `look` is called every thousand steps

  [[nodiscard]] const BookTrack& track() const;  // so far
  [[nodiscard]] BookTrack take() &&;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace bookspin
