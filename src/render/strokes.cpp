#include "render/strokes.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "render/gl_color.h"

namespace bookspin {
namespace {

constexpr int sides = 24;
constexpr double head_radius = 2.6;  // shaft radii
constexpr double head_length = 7.0;  // shaft radii
constexpr double line_bias = 0.004;  // share of its distance that a line is drawn nearer

template <typename Derived>
void push(std::vector<float>& out, const Eigen::MatrixBase<Derived>& vector) {
  for (Eigen::Index i = 0; i < vector.size(); ++i) out.push_back(static_cast<float>(vector(i)));
}

struct ArrowShape {
  double length, head, radius;  // a short arrow is all head, and shrinks in proportion
  explicit ArrowShape(const Arrow& arrow)
      : length((arrow.to_W - arrow.from_W).norm()),
        head(std::min(head_length * arrow.radius, length)),
        radius(head / head_length) {}
};

// Two triangles as wide as asked on the screen, or nothing when the line is behind the eye.
void push_line(std::vector<float>& out, const View& camera, const Line& line) {
  const View view = camera.shifted(line.shift);
  Eigen::Vector4d a = view.clip_from_world() * line.from_W.homogeneous();
  Eigen::Vector4d b = view.clip_from_world() * line.to_W.homogeneous();
  const double near = view.near() / view.distance();
  if (a.w() < near && b.w() < near) return;
  if (a.w() < near) a += (near - a.w()) / (b.w() - a.w()) * (b - a);
  if (b.w() < near) b += (near - b.w()) / (a.w() - b.w()) * (a - b);

  const Eigen::Vector2d half_frame = view.half_frame();
  const Eigen::Vector2d a_px = (a.head<2>() / a.w()).cwiseProduct(half_frame);
  const Eigen::Vector2d b_px = (b.head<2>() / b.w()).cwiseProduct(half_frame);
  const double length = (b_px - a_px).norm();
  if (!(length > 0)) return;
  const Eigen::Vector2d along = (b_px - a_px) / length;
  const Eigen::Vector2d across = (line.width_px / 2 * Eigen::Vector2d(-along.y(), along.x())).cwiseQuotient(half_frame);

  const std::array<float, 4> color = gl_color(line.color);
  const auto vertex = [&](const Eigen::Vector4d& end, double side) {
    Eigen::Vector4d clip = end;
    clip.head<2>() += side * end.w() * across;
    // With the far plane at infinity z_clip = w - 2 near: what z would be at a smaller distance, at the same place on
    // the screen.
    const double nearer = end.w() * (1 - line_bias);
    clip.z() = (nearer - 2 * near) / nearer * end.w();
    push(out, clip);
    out.insert(out.end(), color.begin(), color.end());
  };
  vertex(a, -1);
  vertex(b, -1);
  vertex(b, 1);
  vertex(a, -1);
  vertex(b, 1);
  vertex(a, 1);
}

}  // namespace

std::vector<float> arrow_triangles(const Arrow& arrow) {
  const ArrowShape shape(arrow);
  const Eigen::Vector3d axis = (arrow.to_W - arrow.from_W) / shape.length;
  const Eigen::Vector3d right = axis.unitOrthogonal();
  const Eigen::Vector3d up = axis.cross(right);
  const std::array<float, 4> color = gl_color(arrow.color);

  struct Ring {
    double along, radius;
  };
  struct Band {
    Ring a, b;
    double normal_out, normal_along;
  };
  const double neck = shape.length - shape.head, r = shape.radius, R = head_radius * shape.radius;
  const double slant = std::hypot(shape.head, R);
  const std::array<Band, 4> bands{Band{{0, 0}, {0, r}, 0, -1}, Band{{0, r}, {neck, r}, 1, 0},
                                  Band{{neck, r}, {neck, R}, 0, -1},
                                  Band{{neck, R}, {shape.length, 0}, shape.head / slant, R / slant}};
  std::vector<float> out;
  out.reserve(bands.size() * sides * 6 * arrow_floats);
  const auto vertex = [&](const Ring& ring, const Band& band, int side) {
    const double angle = 2 * std::numbers::pi * side / sides;
    const Eigen::Vector3d outwards = std::cos(angle) * right + std::sin(angle) * up;
    push(out, arrow.from_W + ring.along * axis + ring.radius * outwards);
    push(out, band.normal_out * outwards + band.normal_along * axis);
    out.insert(out.end(), color.begin(), color.end());
  };
  for (const Band& band : bands) {
    for (int side = 0; side < sides; ++side) {
      vertex(band.a, band, side);
      vertex(band.a, band, side + 1);
      vertex(band.b, band, side + 1);
      vertex(band.a, band, side);
      vertex(band.b, band, side + 1);
      vertex(band.b, band, side);
    }
  }
  return out;
}

std::vector<float> line_triangles(const View& view, std::span<const Line> lines, bool opaque) {
  std::vector<float> out;
  for (const Line& line : lines) {
    if ((line.color.a == 255) == opaque) push_line(out, view, line);
  }
  return out;
}

std::array<Eigen::Vector3d, 16> arrow_hull(const Arrow& arrow) {
  const double reach = head_radius * ArrowShape(arrow).radius;
  std::array<Eigen::Vector3d, 16> points;
  for (unsigned i = 0; i < 16; ++i) {
    const Eigen::Vector3d offset((i & 1U) != 0 ? reach : -reach, (i & 2U) != 0 ? reach : -reach,
                                 (i & 4U) != 0 ? reach : -reach);
    points[i] = ((i & 8U) != 0 ? arrow.to_W : arrow.from_W) + offset;
  }
  return points;
}

}  // namespace bookspin
