#include "render/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace bookspin {
namespace {

TEST(Camera, TargetIsInTheMiddleAndAxesPointRightAndUp) {
  Camera camera;
  camera.eye_W = {3, 2, 5};
  camera.target_W = {1, 1, 0};
  const PixelPoint middle = project(camera, 640, 360, camera.target_W);
  EXPECT_NEAR(middle.x, 320, 1e-9);  // measured 0
  EXPECT_NEAR(middle.y, 180, 1e-9);
  EXPECT_NEAR(middle.depth, std::sqrt(30.0), 1e-12);
  EXPECT_LT(project(camera, 640, 360, camera.target_W + Eigen::Vector3d(0, 0.1, 0)).y, 180);
  EXPECT_GT(project(camera, 640, 360, camera.target_W + Eigen::Vector3d(0.1, 0, 0)).x, 320);
  EXPECT_LT(project(camera, 640, 360, Eigen::Vector3d(5, 3, 10)).depth, 0);
}

TEST(Camera, FieldOfViewSpansTheHeight) {
  Camera camera;  // 8 away, 30 degrees
  const double half = 8 * std::tan(camera.vertical_fov / 2);
  EXPECT_NEAR(project(camera, 640, 360, {0, half, 0}).y, 0, 1e-9);
  EXPECT_NEAR(project(camera, 640, 360, {half * 640 / 360, 0, 0}).x, 640, 1e-9);
}

TEST(Camera, FramedSphereTouchesTheNearerEdges) {
  for (const double aspect : {16.0 / 9, 1.0, 0.5}) {
    const double fov = 0.6, radius = 1.7;
    Camera camera;
    camera.vertical_fov = fov;
    camera.eye_W = {0, 0, distance_that_frames(radius, fov, aspect)};
    const int height = 1000;
    const int width = static_cast<int>(std::lround(aspect * height));
    double top = height, left = width;
    for (int i = 0; i <= 2000; ++i) {  // the sphere's profiles in the vertical and the horizontal plane
      const double angle = std::numbers::pi * i / 2000;
      top = std::min(top, project(camera, width, height, {0, radius * std::sin(angle), radius * std::cos(angle)}).y);
      left = std::min(left, project(camera, width, height, {-radius * std::sin(angle), 0, radius * std::cos(angle)}).x);
    }
    EXPECT_NEAR(std::min(top, left), 0, 3e-4);  // measured 3e-5: the profile is sampled
  }
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

TEST(Rectangles, IntersectionAndUnion) {
  const Rect a{0, 0, 10, 10}, b{5, 8, 10, 10}, apart{20, 20, 2, 2};
  EXPECT_EQ(intersection(a, b), (Rect{5, 8, 5, 2}));
  EXPECT_TRUE(intersection(a, apart).empty());
  EXPECT_EQ(union_of(a, b), (Rect{0, 0, 15, 18}));
  EXPECT_EQ(union_of(a, Rect{}), a);
  EXPECT_EQ(union_of(Rect{}, a), a);
}

}  // namespace
}  // namespace bookspin
