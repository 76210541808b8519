#include "render/bend.h"

#include <Eigen/LU>
#include <algorithm>

namespace bookspin {

bool keeps_orientation(const Corners& corners) {
  for (int i = 0; i < 8; ++i) {
    Eigen::Matrix3d derivative;
    for (int d = 0; d < 3; ++d) {
      const int bit = 1 << d;
      derivative.col(d) = corners.col(i | bit) - corners.col(i & ~bit);
    }
    if (!(derivative.determinant() > 0)) return false;
  }
  return true;
}

bool is_unbent(const Corners& corners) {
  constexpr double allowed = 0.03;  // of the longest edge
  Eigen::Matrix3d edges;
  for (int d = 0; d < 3; ++d) edges.col(d) = corners.col(1 << d) - corners.col(0);
  double bend = 0;
  for (const int i : {3, 5, 6, 7}) {
    const Eigen::Vector3d affine = corners.col(0) + edges * Eigen::Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    bend = std::max(bend, (corners.col(i) - affine).norm());
  }
  return bend <= allowed * edges.colwise().norm().maxCoeff() && keeps_orientation(corners);
}

}  // namespace bookspin
