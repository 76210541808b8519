// Which method, and how many steps a frame, keep a scene's book within an error of the exact motion, at the least work.
//
// Error: the quantity angle_error, radians, the largest over the film's frames: what `bookspin check` would find. Every
// rigid method runs from the book's own start with 1, 2, 3, 4, 6, 8, ... steps a frame; so do the script's springs, for
// which no exact motion is known: theirs is the distance from the rigid book, and no step takes away what is the
// model's. A ladder ends when the error is reached, or before it would pass a limit of work. Work is counted in
// evaluations of the equations of motion (of what stands for them where a method has none), so that every machine gives
// the same advice; CPU times only inform. Throws Stopped when asked to stop.
#pragma once

#include <stop_token>
#include <vector>

#include "report/runs.h"

namespace bookspin {

struct Candidate {
  Solver solver;
  std::size_t book;      // whose script it is
  int substeps = 1;      // steps a frame
  double error = none;   // radians; infinite where numbers end
  long evaluations = 0;  // a frame
  double ns = none;      // CPU time of a frame's steps
};

struct Advice {
  std::vector<std::size_t> books;     // that share a start, and how often they are normalized
  std::vector<double> errors;         // as the script has them
  std::vector<Candidate> candidates;  // those within the error first, at the least work; then the nearest
};

[[nodiscard]] std::vector<Advice> advise(const Scene& scene, double error, const std::stop_token& stop = {});

}  // namespace bookspin
