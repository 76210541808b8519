// Where the camera sees what.
//
// Pixels: x right, y down, (0, 0) the top left corner of the top left pixel. Depth is the distance from the eye along
// the view. The clip coordinates are OpenGL's with y downwards, so that the frame buffer's first row is the picture's
// top row; the far plane lies at infinity, the near plane at near_share of the distance from eye to target.
// Preconditions: eye and target differ, the view is not straight up or down, 0 < vertical_fov < pi.
#pragma once

#include <Eigen/Core>
#include <span>

#include "image/image.h"
#include "render/shot.h"

namespace bookspin {

struct PixelPoint {
  double x = 0;      // pixels from the left
  double y = 0;      // pixels from the top
  double depth = 0;  // world units in front of the eye; behind it: negative, and x, y mean nothing
};

// R_CW, world to camera (x right, y up, z towards the eye), of a camera whose eye lies in the direction from_W of its
// target, any length > 0.
[[nodiscard]] Eigen::Matrix3d camera_axes(const Eigen::Vector3d& from_W);

class View {
 public:
  View(const Camera& camera, int width, int height);
  [[nodiscard]] View shifted(const Eigen::Vector2d& shift) const;  // see shot.h

  [[nodiscard]] Eigen::Vector2d half_frame() const { return {width_ / 2.0, height_ / 2.0}; }  // pixels
  [[nodiscard]] const Eigen::Matrix4d& clip_from_world() const { return clip_from_world_; }
  // The same from the camera frame in units of distance().
  [[nodiscard]] const Eigen::Matrix4d& clip_from_unit_camera() const { return clip_from_unit_camera_; }
  [[nodiscard]] const Eigen::Matrix3d& R_CW() const { return R_CW_; }  // see camera_axes
  [[nodiscard]] const Eigen::Vector3d& eye_W() const { return eye_W_; }
  [[nodiscard]] double distance() const { return distance_; }  // eye to target
  [[nodiscard]] double near() const { return near_; }
  [[nodiscard]] bool drawable(const Eigen::Vector3d& point_W) const;
  [[nodiscard]] PixelPoint project(const Eigen::Vector3d& point_W) const;
  // The smallest rectangle of whole pixels, grown by margin, that holds the convex hull of the points; the whole frame
  // when a point is not in front of the near plane.
  [[nodiscard]] Rect bounds(std::span<const Eigen::Vector3d> points_W, double margin_px) const;

 private:
  int width_, height_;
  Eigen::Vector3d eye_W_;
  double distance_, near_;
  Eigen::Matrix3d R_CW_;
  Eigen::Matrix4d clip_from_unit_camera_, clip_from_world_;
};

}  // namespace bookspin
