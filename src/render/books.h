// Draws books into the current frame buffer: the hardcover's mesh carried by the trilinear map of the eight corners.
//
// A ghost is one translucent layer of the same mesh, hidden by what is in front of it, and by what lies where it lies; its
// edges are drawn in full where they are seen and faintly where not. So a ghost that coincides with a solid book is that
// book with its edges traced.
//
// Needs <assets>/shaders/{book.vert,book.frag,ghost.frag} and <assets>/textures/{front,back,spine,pages}.png.
// Throws std::runtime_error as Program and read_png do.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <filesystem>

#include "dynamics/corners.h"
#include "render/book_mesh.h"
#include "render/camera.h"
#include "render/program.h"

namespace bookspin {

// Whether the map of the corners is so nearly affine, and keeps its orientation, that the book looks convex from
// everywhere.
bool is_unbent(const Corners& corners);

class BookPainter {
 public:
  BookPainter(const GladGLContext& gl, const std::filesystem::path& assets);

  // Without depth the book is drawn over what is there; that is right for a book that is not bent (see is_unbent).
  void draw_solid(const View& view, const BookPose& book, bool with_depth);
  void draw_ghost(const View& view, const Corners& corners_W);

 private:
  struct Part {
    GLsizei indices;
    std::size_t first_byte;
  };
  struct Mesh {
    Handle vertex_array, vertices, indices;
    std::array<Part, book_part_count> parts;
  };
  struct Uniforms {
    GLint corners_C, clip_from_camera;
  };

  static Mesh upload(const GladGLContext& gl, const BookMesh& mesh);
  static Uniforms find_uniforms(const Program& program);
  void draw(const View& view, const Corners& corners_W, const Uniforms& uniforms, double nearer = 0.0,
            BookPart first_part = BookPart::pages);

  const GladGLContext* gl_;
  Program solid_, ghost_;
  Uniforms solid_uniforms_, ghost_uniforms_;
  GLint brightness_;                 // of the solid
  GLint opacity_;                    // of the ghost's faces and edges
  Mesh hardcover_, fine_hardcover_;  // the fine one for bent books
  std::array<Handle, book_part_count> textures_;
};

}  // namespace bookspin
