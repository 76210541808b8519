// The hardcover in the unit cube: what the trilinear map of the eight corners carries into the world.
//
// Unit coordinates (u, v, w) run along body x, y, z: the spine lies at u = 0, the front cover at w = 1, the top at v
// = 1. The proportions of boards, overhang and rounding are those of a book of 1.878 x 2.9085 x 0.5. Faces are divided
// finely enough for a sheared or twisted book to bend smoothly. Triangles wind anticlockwise seen from outside. Order:
// the boards' insides, the pages, then what lies on the book's convex hull. No face hides one that comes after it, so
// front faces drawn in this order need no depth buffer (as long as the map is nearly affine: see books.cpp).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace bookspin {

enum class BookPart { insides, pages, front, back, spine };  // in the order of drawing
constexpr std::size_t book_part_count = 5;

struct BookVertex {
  std::array<float, 3> position;  // unit coordinates
  std::array<float, 3> normal;    // outwards, of the surface in unit coordinates; any length
  std::array<float, 2> texture;   // (0, 0) is the texture's top left
  float shade;                    // share of the light that reaches this place, 0 ... 1
};

// Of a strip along the border of a face. Its inner vertices are to lie inwards of its outer ones, in the face.
struct BorderVertex {
  std::array<float, 3> position;       // unit coordinates, on the border
  std::array<float, 3> along, across;  // two directions in the face, no longer than it
  std::array<float, 2> inwards;        // -1, 0 or 1 of each of them
};

struct BookMesh {
  std::vector<BookVertex> vertices;
  std::array<std::vector<std::uint16_t>, book_part_count> triangles;  // vertex indices, three a triangle, by part
  std::vector<BorderVertex> borders;  // of the covers and the spine, three a triangle; the boards' narrow sides entire
};

// fineness 1 does for a book that is hardly bent, as each triangle costs over a microsecond a frame.
BookMesh hardcover(int fineness);

}  // namespace bookspin
