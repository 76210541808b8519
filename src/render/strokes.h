// Arrows and lines as triangles: what their painter draws.
//
// Arrows are lit shafts with cones; lines keep their width in pixels and lie a hair nearer to the eye than they are, so
// that a spring along a book's edge is seen.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/shot.h"

namespace bookspin {

inline constexpr int arrow_floats = 10;  // of a vertex: point and normal, world frame; color
inline constexpr int line_floats = 8;    // of a vertex: clip coordinates, color

[[nodiscard]] std::vector<float> arrow_triangles(const Arrow& arrow);  // of one that is longer than 0

// Of those lines that are opaque, or of those that are not.
[[nodiscard]] std::vector<float> line_triangles(const View& view, std::span<const Line> lines, bool opaque);

// World points whose convex hull holds the arrow.
[[nodiscard]] std::array<Eigen::Vector3d, 16> arrow_hull(const Arrow& arrow);

}  // namespace bookspin
