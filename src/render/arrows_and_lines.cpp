#include "render/arrows_and_lines.h"

#include "render/strokes.h"

namespace bookspin {
ArrowAndLinePainter::ArrowAndLinePainter(const GladGLContext& gl, const std::filesystem::path& assets)
    : gl_(&gl),
      solid_(gl, assets / "shaders" / "solid.vert", assets / "shaders" / "solid.frag"),
      line_(gl, assets / "shaders" / "line.vert", assets / "shaders" / "line.frag"),
      clip_from_world_(solid_.uniform("clip_from_world")),
      R_CW_(solid_.uniform("R_CW")) {
  const auto make_stream = [&](std::span<const GLint> sizes, GLsizei floats_a_vertex) {
    Stream stream{make_vertex_array(gl), make_buffer(gl)};
    gl.BindVertexArray(stream.vertex_array.id());
    gl.BindBuffer(GL_ARRAY_BUFFER, stream.vertices.id());
    std::size_t offset = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      gl.EnableVertexAttribArray(static_cast<GLuint>(i));
      gl.VertexAttribPointer(static_cast<GLuint>(i), sizes[i], GL_FLOAT, GL_FALSE,
                             floats_a_vertex * static_cast<GLsizei>(sizeof(float)), buffer_offset(offset));
      offset += static_cast<std::size_t>(sizes[i]) * sizeof(float);
    }
    return stream;
  };
  solid_stream_ = make_stream(std::array{3, 3, 4}, arrow_floats);
  line_stream_ = make_stream(std::array{4, 4}, line_floats);
}

void ArrowAndLinePainter::draw(const Stream& stream, const std::vector<float>& vertices, GLsizei floats_a_vertex) {
  gl_->BindVertexArray(stream.vertex_array.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, stream.vertices.id());
  gl_->BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(float)), vertices.data(),
                  GL_STREAM_DRAW);
  gl_->DrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(vertices.size()) / floats_a_vertex);
}

void ArrowAndLinePainter::draw_arrow(const View& camera, const Arrow& arrow) {
  if (!((arrow.to_W - arrow.from_W).norm() > 0)) return;
  const View view = camera.shifted(arrow.shift);
  solid_.use();
  const Eigen::Matrix4f clip_from_world = view.clip_from_world().cast<float>();
  const Eigen::Matrix3f R_CW = view.R_CW().cast<float>();
  gl_->UniformMatrix4fv(clip_from_world_, 1, GL_FALSE, clip_from_world.data());
  gl_->UniformMatrix3fv(R_CW_, 1, GL_FALSE, R_CW.data());
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  draw(solid_stream_, arrow_triangles(arrow), arrow_floats);
}

void ArrowAndLinePainter::draw_lines(const View& view, std::span<const Line> lines) {
  line_.use();
  gl_->Enable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  // Opaque lines hide by depth; translucent ones go over them in the order given.
  for (const bool opaque : {true, false}) {
    const std::vector<float> vertices = line_triangles(view, lines, opaque);
    if (vertices.empty()) continue;
    if (!opaque) {
      gl_->Enable(GL_BLEND);
      gl_->DepthMask(GL_FALSE);
    }
    draw(line_stream_, vertices, line_floats);
    gl_->Disable(GL_BLEND);
    gl_->DepthMask(GL_TRUE);
  }
}

}  // namespace bookspin
