#include "render/camera.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

namespace bookspin {
namespace {

constexpr double near_share = 0.02;
constexpr double drawable_share = 1e6;

}  // namespace

Eigen::Matrix3d camera_axes(const Eigen::Vector3d& from_W) {
  const Eigen::Vector3d back_W = from_W.normalized();
  const Eigen::Vector3d right_W = Eigen::Vector3d::UnitY().cross(back_W).normalized();
  Eigen::Matrix3d R_CW;
  R_CW << right_W.transpose(), back_W.cross(right_W).transpose(), back_W.transpose();
  return R_CW;
}

View::View(const Camera& camera, int width, int height)
    : width_(width),
      height_(height),
      eye_W_(camera.eye_W),
      distance_((camera.eye_W - camera.target_W).norm()),
      near_(near_share * distance_),
      R_CW_(camera_axes(camera.eye_W - camera.target_W)) {
  assert(distance_ > 0 && camera.vertical_fov > 0);
  const double focal = 1 / std::tan(camera.vertical_fov / 2);
  clip_from_unit_camera_.setZero();
  clip_from_unit_camera_(0, 0) = focal * height / width;
  clip_from_unit_camera_(1, 1) = -focal;
  clip_from_unit_camera_(2, 2) = -1;
  clip_from_unit_camera_(2, 3) = -2 * near_share;
  clip_from_unit_camera_(3, 2) = -1;
  Eigen::Matrix4d camera_from_world = Eigen::Matrix4d::Identity();
  camera_from_world.topLeftCorner<3, 3>() = R_CW_ / distance_;
  camera_from_world.topRightCorner<3, 1>() = -R_CW_ * eye_W_ / distance_;
  clip_from_world_ = clip_from_unit_camera_ * camera_from_world;
}

View View::shifted(const Eigen::Vector2d& shift) const {
  View view = *this;
  for (Eigen::Matrix4d* clip_from : {&view.clip_from_unit_camera_, &view.clip_from_world_}) {
    clip_from->row(0) += 2 * std::round(shift.x() * height_) / width_ * clip_from->row(3);
    clip_from->row(1) += 2 * std::round(shift.y() * height_) / height_ * clip_from->row(3);
  }
  return view;
}

bool View::drawable(const Eigen::Vector3d& point_W) const {
  // Written so that NaN is not drawable.
  return (point_W - eye_W_).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() <= drawable_share * distance_;
}

PixelPoint View::project(const Eigen::Vector3d& point_W) const {
  const Eigen::Vector4d clip = clip_from_world_ * point_W.homogeneous();
  return {(clip.x() / clip.w() + 1) / 2 * width_, (clip.y() / clip.w() + 1) / 2 * height_, clip.w() * distance_};
}

Rect View::bounds(std::span<const Eigen::Vector3d> points_W, double margin_px) const {
  const Rect frame{0, 0, width_, height_};
  double left = width_, right = 0, top = height_, bottom = 0;
  for (const Eigen::Vector3d& point_W : points_W) {
    const PixelPoint p = project(point_W);
    if (!(p.depth > near_)) return frame;
    left = std::min(left, p.x);
    right = std::max(right, p.x);
    top = std::min(top, p.y);
    bottom = std::max(bottom, p.y);
  }
  // Clamped before the conversion: a point far outside the frame does not fit into an int.
  const auto column = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, double(width_))); };
  const auto row = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, double(height_))); };
  const int x0 = column(std::floor(left - margin_px));
  const int y0 = row(std::floor(top - margin_px));
  return {x0, y0, column(std::ceil(right + margin_px)) - x0, row(std::ceil(bottom + margin_px)) - y0};
}

}  // namespace bookspin
