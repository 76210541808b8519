// Tolerances of the numerical tests. Each stands beside the value that was measured when it was chosen.
//
// BOOKSPIN_TOLERANCE_SCALE multiplies all of them: 0 makes every comparison fail and so print its residual.
#pragma once

#include <cstdlib>

namespace bookspin {

inline double tolerance(double value) {
  const char* scale = std::getenv("BOOKSPIN_TOLERANCE_SCALE");
  return scale == nullptr ? value : value * std::strtod(scale, nullptr);
}

}  // namespace bookspin
