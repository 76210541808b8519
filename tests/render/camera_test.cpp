#include "render/camera.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace bookspin {
namespace {

TEST(Camera, TargetIsInTheMiddleAndAxesPointRightAndUp) {
  Camera camera;
  camera.eye_W = {3, 2, 5};
  camera.target_W = {1, 1, 0};
  const View view(camera, 640, 360);
  const PixelPoint middle = view.project(camera.target_W);
  EXPECT_NEAR(middle.x, 320, 1e-9);  // measured 0
  EXPECT_NEAR(middle.y, 180, 1e-9);
  EXPECT_NEAR(middle.depth, std::sqrt(30.0), 1e-12);
  EXPECT_LT(view.project(camera.target_W + Eigen::Vector3d(0, 0.1, 0)).y, 180);
  EXPECT_GT(view.project(camera.target_W + Eigen::Vector3d(0.1, 0, 0)).x, 320);
  EXPECT_LT(view.project(Eigen::Vector3d(5, 3, 10)).depth, 0);
}

TEST(Camera, FieldOfViewSpansTheHeight) {
  const Camera camera;  // 8 away, 30 degrees
  const View view(camera, 640, 360);
  const double half = 8 * std::tan(camera.vertical_fov / 2);
  EXPECT_NEAR(view.project({0, half, 0}).y, 0, 1e-9);
  EXPECT_NEAR(view.project({half * 640 / 360, 0, 0}).x, 640, 1e-9);
}

TEST(Camera, BoundsHoldThePointsAndNothingMuch) {
  const View view(Camera{}, 640, 360);
  const std::array points{Eigen::Vector3d(-0.5, -0.25, 0), Eigen::Vector3d(0.5, 0.25, 0)};
  const Rect bounds = view.bounds(points, 0);
  const PixelPoint a = view.project(points[0]), b = view.project(points[1]);
  EXPECT_EQ(bounds, (Rect{static_cast<int>(std::floor(a.x)), static_cast<int>(std::floor(b.y)),
                          static_cast<int>(std::ceil(b.x)) - static_cast<int>(std::floor(a.x)),
                          static_cast<int>(std::ceil(a.y)) - static_cast<int>(std::floor(b.y))}));
  EXPECT_EQ(view.bounds(std::array{Eigen::Vector3d(0, 0, 9)}, 0), (Rect{0, 0, 640, 360}));  // behind the eye: anywhere
  EXPECT_TRUE(view.bounds(std::array{Eigen::Vector3d(1e5, 0, 0)}, 0).empty());              // beside the frame
}

}  // namespace
}  // namespace bookspin
