#include "dynamics/book.h"

namespace bookspin {

Corners corners_at_rest(const Eigen::Vector3d& size) {
  Corners corners_B;
  for (int i = 0; i < 8; ++i) {
    for (int d = 0; d < 3; ++d) {
      corners_B(d, i) = (((i >> d) & 1) != 0 ? 0.5 : -0.5) * size(d);
    }
  }
  return corners_B;
}

Eigen::Vector3d principal_moments(const Eigen::Vector3d& size, double particle_mass) {
  const Eigen::Vector3d s = size.cwiseAbs2();
  return 2.0 * particle_mass * Eigen::Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
}

}  // namespace bookspin
