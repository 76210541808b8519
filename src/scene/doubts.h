// What a film would get wrong in silence: a book that leaves the exact motion from the same start by more than the eye
// forgives, where neither the script nor the picture says so.
//
// It is said by an exact book or its ghost, by a figure or an expectation of angle_error, exact_tilt or exact_flips, and
// by an explosion. Energy and angular momentum may be kept to the last digit while the orientation is lost.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

inline constexpr double visible_error = 0.1;  // radians

struct Doubt {
  std::size_t book;
  int frame;     // the first one beyond visible_error
  double error;  // the largest angle_error, radians
  std::string why;
};

[[nodiscard]] std::vector<Doubt> doubts_about(const Scene& scene, const Trajectory& trajectory);

}  // namespace bookspin
