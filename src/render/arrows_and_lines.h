// Draws arrows and lines into the current frame buffer, hidden by and hiding the books by depth.
//
// strokes.h says what they look like. Needs <assets>/shaders/{solid,line}.{vert,frag}. Throws std::runtime_error as
// Program does.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "render/camera.h"
#include "render/program.h"
#include "render/shot.h"

namespace bookspin {

class ArrowAndLinePainter {
 public:
  ArrowAndLinePainter(const GladGLContext& gl, const std::filesystem::path& assets);

  void draw_arrow(const View& camera, const Arrow& arrow);
  void draw_lines(const View& view, std::span<const Line> lines);

 private:
  struct Stream {
    Handle vertex_array, vertices;
  };
  void draw(const Stream& stream, const std::vector<float>& vertices, GLsizei floats_a_vertex);

  const GladGLContext* gl_;
  Program solid_, line_;
  GLint clip_from_world_, R_CW_;
  Stream solid_stream_, line_stream_;
};

}  // namespace bookspin
