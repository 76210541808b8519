#include "film/framing.h"

#include <algorithm>
#include <cmath>

namespace bookspin {
namespace {

const double tan_half_fov = std::tan(film_fov / 2.0);
constexpr double margin = 1.04;  // free space about the motion

}  // namespace

Eigen::AlignedBox2d picture_of(const std::vector<Stand>& stands, const Eigen::Matrix3d& R_CW, double distance) {
  Eigen::AlignedBox2d picture;
  for (const Stand& stand : stands) {
    for (const Sphere& sphere : stand.spheres) {
      const Eigen::Vector3d center_C = R_CW * sphere.center_W;
      const double depth = distance - center_C.z();
      for (const double side : {-1.0, 1.0}) {
        const auto edge = [&](int axis) {
          const double half = std::asin(margin * sphere.radius / std::hypot(center_C(axis), depth));
          return std::tan(std::atan2(center_C(axis), depth) + side * half) + stand.place(axis) / distance;
        };
        picture.extend(Eigen::Vector2d(edge(0), edge(1)));
      }
    }
  }
  return picture;
}

double distance_that_frames(const std::vector<Stand>& stands, const Eigen::Matrix3d& R_CW, double aspect, double band) {
  double near = 0.0;
  for (const Stand& stand : stands) {
    for (const Sphere& s : stand.spheres) near = std::max(near, 1.01 * (s.center_W.norm() + margin * s.radius));
  }
  const Eigen::Array2d room = 2.0 * tan_half_fov * Eigen::Array2d(aspect, band);
  const auto fits = [&](double distance) { return (picture_of(stands, R_CW, distance).sizes().array() <= room).all(); };
  double far = 2.0 * near;
  while (!fits(far)) far *= 2.0;
  for (int i = 0; i < 50; ++i) {
    const double middle = (near + far) / 2.0;
    (fits(middle) ? far : near) = middle;
  }
  return far;
}

Eigen::Vector2d shift_of(const Stand& stand, double distance, const Eigen::Vector2d& middle) {
  const Eigen::Vector2d place = stand.place / distance - middle;
  return Eigen::Vector2d(place.x(), -place.y()) / (2.0 * tan_half_fov);
}

bool is_gone(const BookFrame& frame, double too_near) {
  return frame.exploded() && !(frame.corners_W.allFinite() && frame[Q::extent] < too_near);
}

}  // namespace bookspin
