#include "render/book_mesh.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace bookspin {
namespace {

constexpr double book_width = 1.878, book_height = 2.9085, book_thickness = 0.5;
constexpr double overhang_x = 0.05 / book_width;  // boards stand out over the pages
constexpr double overhang_y = 0.05 / book_height;
constexpr double board = 0.042 / book_thickness;     // thickness of a board
constexpr double shell = 0.030 / book_width;         // thickness of the spine
constexpr double bulge = 0.105 / book_width;         // depth of the spine's round
constexpr double groove_width = 0.085 / book_width;  // the hinge beside the spine
constexpr double groove_depth = 0.020 / book_thickness;
constexpr double fore_edge_hollow = 0.045 / book_width;

struct Divisions {
  int rows;        // along v
  int cover;       // along u, beside the groove
  int spine;       // round the spine
  int groove = 4;  // across the groove
  int across;      // through the pages, from cover to cover
  int along;       // along u, on the pages' top and bottom
  int inside;      // of the boards' and the spine's insides

  explicit Divisions(int fineness)
      : rows(4 * fineness),
        cover(3 * fineness),
        spine(4 + 4 * fineness),
        across(4 + 2 * fineness),
        along(4 * fineness),
        inside(fineness) {}
};

struct Point {
  double u, w;
};

// A smooth curve in the (u, w) plane with its outward normals, and a texture coordinate along it.
struct Profile {
  std::vector<Point> points, normals;
  std::vector<double> texture;
};

struct Vertex {
  double u, v, w, nu, nv, nw, s, t;
  double shade = 1;
};

std::array<float, 3> as_floats(double x, double y, double z) {
  return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

class Builder {
 public:
  // A grid of columns x rows vertices; position (column, row) -> vertex. Columns run right and rows up seen from
  // outside.
  void grid(BookPart part, int columns, int row_count, const std::function<Vertex(int, int)>& vertex) {
    const std::size_t first = mesh.vertices.size();
    for (int row = 0; row < row_count; ++row) {
      for (int column = 0; column < columns; ++column) {
        const Vertex p = vertex(column, row);
        mesh.vertices.push_back({as_floats(p.u, p.v, p.w),
                                 as_floats(p.nu, p.nv, p.nw),
                                 {static_cast<float>(p.s), static_cast<float>(p.t)},
                                 static_cast<float>(p.shade)});
      }
    }
    auto& triangles = mesh.triangles[static_cast<std::size_t>(part)];
    for (int row = 0; row + 1 < row_count; ++row) {
      for (int column = 0; column + 1 < columns; ++column) {
        const auto index = [&](int c, int r) {
          return static_cast<std::uint16_t>(first + static_cast<std::size_t>(r * columns + c));
        };
        const std::uint16_t a = index(column, row), b = index(column + 1, row);
        const std::uint16_t c = index(column + 1, row + 1), d = index(column, row + 1);
        triangles.insert(triangles.end(), {a, b, c, a, c, d});
      }
    }
  }

  // The profile drawn out along v from v0 to v1. The profile's points run right seen from outside.
  void extrude(BookPart part, const Profile& profile, double v0, double v1, int row_count, double shade = 1) {
    grid(part, static_cast<int>(profile.points.size()), row_count + 1, [&](int column, int row) {
      const auto i = static_cast<std::size_t>(column);
      const double v = v0 + (v1 - v0) * row / row_count;
      return Vertex{profile.points[i].u,  v,     profile.points[i].w,
                    profile.normals[i].u, 0,     profile.normals[i].w,
                    profile.texture[i],   1 - v, shade};
    });
  }

  // The same, and all of it border: a narrow side of a board.
  void narrow_side(BookPart part, int columns, int row_count, const std::function<Vertex(int, int)>& vertex) {
    auto& triangles = mesh.triangles[static_cast<std::size_t>(part)];
    std::size_t i = triangles.size();
    grid(part, columns, row_count, vertex);
    for (; i < triangles.size(); ++i) mesh.borders.push_back({mesh.vertices[triangles[i]].position, {}, {}, {}});
  }

  // Strips round what a profile, drawn out along v from 0 to 1, makes; its points run right seen from outside.
  void border(const std::vector<Point>& profile) {
    const std::size_t last = profile.size() - 1;
    const auto vertex = [&](std::size_t i, double v, bool inner) {
      const Point& p = profile[i];
      const Point& from = profile[i < last ? i : last / 2];
      const Point& to = profile[i == 0 ? (last + 1) / 2 : std::min(i + 1, last)];
      const float right = i == 0 ? 1.0F : i == last ? -1.0F : 0.0F;
      const float up = v == 0.0 ? 1.0F : -1.0F;
      mesh.borders.push_back({as_floats(p.u, v, p.w), as_floats(to.u - from.u, 0, to.w - from.w), as_floats(0, 1, 0),
                              inner ? std::array{right, up} : std::array{0.0F, 0.0F}});
    };
    const auto strip = [&](std::size_t i, double vi, std::size_t j, double vj) {  // anticlockwise
      vertex(i, vi, false);
      vertex(j, vj, false);
      vertex(j, vj, true);
      vertex(i, vi, false);
      vertex(j, vj, true);
      vertex(i, vi, true);
    };
    for (std::size_t i = 0; i < last; ++i) {
      strip(i, 0, i + 1, 0);
      strip(i + 1, 1, i, 1);
    }
    strip(last, 0, last, 1);
    strip(0, 1, 0, 0);
  }

  BookMesh mesh;
};

// The front cover's outside from the spine to the fore-edge: the hinge's groove, then flat. The groove is in the
// normals alone: so shallow, it is seen by its shading, and the hull stays convex.
Profile front_outside(const Divisions& n) {
  Profile profile;
  for (int i = 0; i <= n.groove; ++i) {
    const double phase = 2 * std::numbers::pi * i / n.groove;
    const double slope = groove_depth * std::numbers::pi / groove_width * std::sin(phase);  // -dw/du
    profile.points.push_back({bulge + groove_width * i / n.groove, 1});
    profile.normals.push_back({slope, 1});
  }
  const double start = bulge + groove_width;
  for (int i = 1; i <= n.cover; ++i) {
    profile.points.push_back({start + (1 - start) * i / n.cover, 1});
    profile.normals.push_back({0, 1});
  }
  for (const Point& p : profile.points) profile.texture.push_back((p.u - bulge) / (1 - bulge));
  return profile;
}

// The same on the back, from the fore-edge to the spine.
Profile back_outside(const Divisions& n) {
  const Profile front = front_outside(n);
  Profile profile;
  for (std::size_t i = front.points.size(); i-- > 0;) {
    profile.points.push_back({front.points[i].u, 1 - front.points[i].w});
    profile.normals.push_back({front.normals[i].u, -front.normals[i].w});
    profile.texture.push_back(1 - front.texture[i]);
  }
  return profile;
}

// Half an ellipse from the back cover round to the front cover; inset > 0 is the inside of the spine.
Profile spine(const Divisions& n, double inset_u, double inset_w) {
  Profile profile;
  const double depth = bulge - inset_u, half = 0.5 - inset_w;
  for (int i = 0; i <= n.spine; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / n.spine - 0.5);
    profile.points.push_back({bulge - depth * std::cos(angle), 0.5 + half * std::sin(angle)});
    profile.normals.push_back({-half * std::cos(angle), depth * std::sin(angle)});
    profile.texture.push_back(static_cast<double>(i) / n.spine);
  }
  return profile;
}

// The narrow faces that close a board or the spine at the top and the bottom, between outside and inside.
void add_rims(Builder& builder, BookPart part, const Profile& outside, const std::vector<Point>& inside) {
  const auto columns = static_cast<int>(outside.points.size());
  for (const bool top : {true, false}) {
    builder.narrow_side(part, columns, 2, [&](int column, int row) {
      const auto i = static_cast<std::size_t>(column);
      const Point p = (row == 0) == top ? outside.points[i] : inside[i];
      return Vertex{p.u, top ? 1.0 : 0.0, p.w, 0, top ? 1.0 : -1.0, 0, outside.texture[i], top ? 0.004 : 0.996, 0.9};
    });
  }
}

void add_boards(Builder& builder, const Divisions& n) {
  const Profile front = front_outside(n), back = back_outside(n);
  builder.extrude(BookPart::front, front, 0, 1, n.rows);
  builder.extrude(BookPart::back, back, 0, 1, n.rows);
  builder.border({front.points.front(), front.points.back()});
  builder.border({back.points.front(), back.points.back()});
  for (const bool is_front : {true, false}) {
    const BookPart part = is_front ? BookPart::front : BookPart::back;
    const Profile& outside = is_front ? front : back;
    const double inner_w = is_front ? 1 - board : board;
    const double outer_w = is_front ? 1 : 0;
    std::vector<Point> inside;
    for (const Point& p : outside.points) inside.push_back({p.u, inner_w});
    add_rims(builder, part, outside, inside);

    const double s = is_front ? 0.996 : 0.004;
    builder.narrow_side(part, 2, n.rows + 1, [&](int column, int row) {  // the fore-edge of the board
      const double v = static_cast<double>(row) / n.rows;
      const double w = (column == 0) == is_front ? outer_w : inner_w;
      return Vertex{1, v, w, 1, 0, 0, s, 1 - v, 0.9};
    });
  }
}

// How far the fore-edge of the pages lies within their corner, by height between the covers.
double hollow(double w) {
  return fore_edge_hollow * std::sqrt(1 - std::pow(2 * w - 1, 2));
}

// The insides of the boards and the spine, lined with paper and in the shade. Only where they stand out over the pages:
// the rest, which is never seen, would cost half of a book's drawing.
void add_insides(Builder& builder, const Divisions& n) {
  constexpr double tuck = 0.005;  // under the pages
  const double margin = overhang_y + tuck, pages_end = 1 - overhang_x - hollow(board) - tuck;
  const auto board_inside = [&](bool is_front, int columns, double u0, int rows, double v0, double v1) {
    builder.grid(BookPart::insides, columns + 1, rows + 1, [&](int column, int row) {
      const double from_fore_edge = static_cast<double>(is_front ? column : columns - column) / columns;
      return Vertex{1 - from_fore_edge * (1 - u0),
                    v0 + (v1 - v0) * row / rows,
                    is_front ? 1 - board : board,
                    0,
                    0,
                    is_front ? -1.0 : 1.0,
                    0.5,
                    0.5,
                    0.16};
    });
  };
  const Profile inside = spine(n, shell, board);
  Profile facing_in;
  for (std::size_t i = inside.points.size(); i-- > 0;) {
    facing_in.points.push_back(inside.points[i]);
    facing_in.normals.push_back({-inside.normals[i].u, -inside.normals[i].w});
    facing_in.texture.push_back(0.5);
  }
  for (const double v0 : {0.0, 1 - margin}) {
    for (const bool is_front : {true, false}) board_inside(is_front, n.inside, bulge, 1, v0, v0 + margin);
    builder.extrude(BookPart::insides, facing_in, v0, v0 + margin, 1, 0.14);
  }
  for (const bool is_front : {true, false}) board_inside(is_front, 1, pages_end, n.rows, margin, 1 - margin);
}

void add_spine(Builder& builder, const Divisions& n) {
  const Profile outside = spine(n, 0, 0);
  const Profile inside = spine(n, shell, board);
  builder.extrude(BookPart::spine, outside, 0, 1, n.rows);
  builder.border(outside.points);
  add_rims(builder, BookPart::spine, outside, inside.points);
}

// The pages end a little inside the boards; towards the spine they follow its round. Texture s runs along the edge, t
// across the leaves, so that the lines of the paper lie in the plane of the covers.
void add_pages(Builder& builder, const Divisions& n) {
  const double v0 = overhang_y, v1 = 1 - overhang_y, end = 1 - overhang_x;
  const auto w_at = [&](int i) { return board + (1 - 2 * board) * i / n.across; };
  builder.grid(BookPart::pages, n.across + 1, n.rows + 1,
               [&](int column, int row) {  // fore-edge, seen from +x: right is -w
                 const double w = w_at(n.across - column);
                 const double v = v0 + (v1 - v0) * row / n.rows;
                 const double tilt = fore_edge_hollow * 2 * (2 * w - 1) / std::sqrt(1 - std::pow(2 * w - 1, 2));
                 return Vertex{end - hollow(w), v, w, 1, 0, -tilt, v, w, 1};
               });
  const double round = bulge - shell;
  for (const bool top : {true, false}) {
    builder.grid(BookPart::pages, n.along + 1, n.across + 1, [&](int column, int row) {
      const double w = w_at(top ? n.across - row : row);
      const double span = std::sqrt(std::max(0.0, 1 - std::pow((w - 0.5) / (0.5 - board), 2)));
      const double start = bulge - round * span;
      const double u = start + (end - hollow(w) - start) * column / n.along;
      return Vertex{u, top ? v1 : v0, w, 0, top ? 1.0 : -1.0, 0, u, w, 1};
    });
  }
}

}  // namespace

BookMesh hardcover(int fineness) {
  const Divisions n(fineness);
  Builder builder;
  add_insides(builder, n);
  add_pages(builder, n);
  add_boards(builder, n);
  add_spine(builder, n);
  return std::move(builder.mesh);
}

}  // namespace bookspin
