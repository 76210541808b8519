// Draws books into the current frame buffer: the hardcover's mesh carried by the trilinear map of the eight corners.
//
// A ghost is one translucent layer of the same mesh, hidden by what is in front of it, and by what lies where it lies;
// its borders are drawn in full where they are seen and faintly where not. So a ghost that coincides with a solid book
// is that book with its edges traced.
//
// Needs <assets>/shaders/{book.vert,book.frag,ghost.frag,border.vert,line.frag} and
// <assets>/textures/{front,back,spine,pages}.png.
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

class BookPainter {
 public:
  BookPainter(const GladGLContext& gl, const std::filesystem::path& assets);

  // Without depth the book is drawn over what is there; that is right for a book that is not bent (see bend.h).
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

  Mesh upload(const BookMesh& mesh);
  void upload_borders(const BookMesh& mesh);
  static Uniforms find_uniforms(const Program& program);
  // nearer: in clip coordinates, at the same place on the screen.
  void place(const View& view, const Corners& corners_W, const Uniforms& uniforms, double nearer = 0.0);
  void draw_part(const Mesh& mesh, std::size_t part);
  [[nodiscard]] const Mesh& mesh_for(const Corners& corners) const;

  const GladGLContext* gl_;
  Program solid_, ghost_, border_;
  Uniforms solid_uniforms_, ghost_uniforms_, border_uniforms_;
  GLint brightness_;                 // of the solid
  GLint half_frame_, color_;         // of the borders
  Mesh hardcover_, fine_hardcover_;  // the fine one for bent books
  Handle border_vertex_array_, border_vertices_;
  GLsizei border_count_ = 0;  // of vertices
  std::array<Handle, book_part_count> textures_;
};

}  // namespace bookspin
