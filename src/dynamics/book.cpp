#include "dynamics/book.h"

namespace bookspin {

Body body_of(const BookOptions& options) {
  Body body;
  for (int i = 0; i < 8; ++i) {
    for (int d = 0; d < 3; ++d) body.corners_B(d, i) = (((i >> d) & 1) != 0 ? 0.5 : -0.5) * options.size(d);
  }
  const Eigen::Vector3d s = options.size.cwiseAbs2();
  body.I_B = 2.0 * options.particle_mass * Eigen::Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  body.reach = 0.5 * options.size.norm();
  return body;
}

}  // namespace bookspin
