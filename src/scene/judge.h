// What a script expects of its film, judged on the simulated motion.
//
// at_least and at_most bind every frame of the range, and one value that is not a number breaks them; rises_to and
// falls_to must be reached by some frame of it, which a value that is not a number never does. A range beyond the end
// of the film meets nothing.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

struct Verdict {
  std::string says;  // the expectation's words
  Q quantity = Q::tilt;
  bool met = false;
  double found = 0.0;  // of all values in the range the one that decides: the smallest or the largest
  int frame = 0;       // where it was found
  std::string text;    // "tilt at most 5 degrees in frames 0 to 899: found 2.31 in frame 411"
};

// One verdict a bound, in the scene's order.
[[nodiscard]] std::vector<Verdict> judge(const Scene& scene, const Trajectory& trajectory);

}  // namespace bookspin
