#include "dynamics/book.h"

#include <cmath>
#include <limits>

namespace bookspin {

Body body_of(const BookOptions& options) {
  Body body;
  const double thin = 0.01 * options.size.maxCoeff();
  const Eigen::Vector3d edges = options.size.unaryExpr([=](double edge) { return edge > 0.0 ? edge : thin; });
  for (int i = 0; i < 8; ++i) {
    for (int d = 0; d < 3; ++d) body.corners_B(d, i) = (((i >> d) & 1) != 0 ? 0.5 : -0.5) * edges(d);
  }
  const Eigen::Vector3d s = options.size.cwiseAbs2();
  const Eigen::Vector3d of_size = 2.0 * Eigen::Vector3d(s.y() + s.z(), s.x() + s.z(), s.x() + s.y());
  body.I_B = options.particle_mass * (options.moments.x() > 0.0 ? options.moments : of_size);
  body.reach = 0.5 * edges.norm();
  return body;
}

std::optional<Eigen::Vector3d> size_of(const Eigen::Vector3d& moments) {
  const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * moments.maxCoeff();
  Eigen::Vector3d size;
  for (int d = 0; d < 3; ++d) {
    const double excess = moments((d + 1) % 3) + moments((d + 2) % 3) - moments(d);  // 4 a^2
    if (excess < -rounding) return {};
    size(d) = excess > rounding ? 0.5 * std::sqrt(excess) : 0.0;
  }
  return size;
}

}  // namespace bookspin
