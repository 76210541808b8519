#include "render/books.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "image/halved.h"
#include "image/png.h"
#include "render/bend.h"
#include "render/gl_color.h"

namespace bookspin {
namespace {

constexpr Color ghost_tint{190, 228, 255, 255};
constexpr double coincident = 4e-5;  // depths that differ by less are one, in clip coordinates: an 800th of a book

// Mipmapped: of the level nearest to a slightly finer one than OpenGL would choose. Against 64 samples a pixel of three
// films the mean error is 2.4 levels, that of trilinear filtering 2.6, and books cost a sixth less to draw.
// Encoded colors are drawn as plain numbers: see book.frag. OpenGL would make the levels too, but not of encoded colors,
// and in five times the time.
Handle upload_texture(const GladGLContext& gl, const std::filesystem::path& file) {
  Image level = read_png(file);
  Handle texture = make_texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.id());
  for (GLint i = 0;; ++i) {
    gl.TexImage2D(GL_TEXTURE_2D, i, GL_RGBA8, level.width, level.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                  level.rgba.data());
    if (level.width == 1 && level.height == 1) break;
    level = halved(level);
  }
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  gl.TexParameterf(GL_TEXTURE_2D, GL_TEXTURE_LOD_BIAS, -0.25F);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

struct Attribute {
  GLint size;
  std::size_t offset;
};

// Into the vertex array that is bound.
template <typename Vertex>
void upload_vertices(const GladGLContext& gl, const Handle& buffer, const std::vector<Vertex>& vertices,
                     std::initializer_list<Attribute> attributes) {
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer.id());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)), vertices.data(),
                GL_STATIC_DRAW);
  GLuint location = 0;
  for (const Attribute& attribute : attributes) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location++, attribute.size, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                           buffer_offset(attribute.offset));
  }
}

}  // namespace

BookPainter::BookPainter(const GladGLContext& gl, const std::filesystem::path& assets)
    : gl_(&gl),
      solid_(gl, assets / "shaders" / "book.vert", assets / "shaders" / "book.frag"),
      ghost_(gl, assets / "shaders" / "book.vert", assets / "shaders" / "ghost.frag"),
      border_(gl, assets / "shaders" / "border.vert", assets / "shaders" / "line.frag"),
      solid_uniforms_(find_uniforms(solid_)),
      ghost_uniforms_(find_uniforms(ghost_)),
      border_uniforms_(find_uniforms(border_)),
      brightness_(solid_.uniform("brightness")),
      half_frame_(border_.uniform("half_frame")),
      color_(border_.uniform("color")),
      hardcover_(upload(hardcover(1))),
      fine_hardcover_(upload(hardcover(4))) {
  upload_borders(hardcover(1));
  const std::array<const char*, book_part_count> names{"", "pages.png", "front.png", "back.png", "spine.png"};
  for (std::size_t i = 1; i < book_part_count; ++i) {
    textures_[i] = upload_texture(gl, assets / "textures" / names[i]);
  }
  ghost_.use();
  const std::array<float, 4> tint = gl_color(ghost_tint);
  gl.Uniform3fv(ghost_.uniform("tint"), 1, tint.data());
}

BookPainter::Uniforms BookPainter::find_uniforms(const Program& program) {
  return {program.uniform("corners_C"), program.uniform("clip_from_camera")};
}

BookPainter::Mesh BookPainter::upload(const BookMesh& mesh) {
  Mesh result{make_vertex_array(*gl_), make_buffer(*gl_), make_buffer(*gl_), {}};
  gl_->BindVertexArray(result.vertex_array.id());
  upload_vertices(*gl_, result.vertices, mesh.vertices,
                  {{3, offsetof(BookVertex, position)},
                   {3, offsetof(BookVertex, normal)},
                   {2, offsetof(BookVertex, texture)},
                   {1, offsetof(BookVertex, shade)}});
  std::vector<std::uint16_t> indices;
  for (std::size_t i = 0; i < book_part_count; ++i) {
    result.parts[i] = {static_cast<GLsizei>(mesh.triangles[i].size()), indices.size() * sizeof(std::uint16_t)};
    indices.insert(indices.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
  }
  gl_->BindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.indices.id());
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                  indices.data(), GL_STATIC_DRAW);
  return result;
}

void BookPainter::upload_borders(const BookMesh& mesh) {
  border_vertex_array_ = make_vertex_array(*gl_);
  border_vertices_ = make_buffer(*gl_);
  border_count_ = static_cast<GLsizei>(mesh.borders.size());
  gl_->BindVertexArray(border_vertex_array_.id());
  upload_vertices(*gl_, border_vertices_, mesh.borders,
                  {{3, offsetof(BorderVertex, position)},
                   {3, offsetof(BorderVertex, along)},
                   {3, offsetof(BorderVertex, across)},
                   {2, offsetof(BorderVertex, inwards)}});
}

const BookPainter::Mesh& BookPainter::mesh_for(const Corners& corners) const {
  return is_unbent(corners) ? hardcover_ : fine_hardcover_;
}

void BookPainter::draw_solid(const View& view, const BookPose& book, bool with_depth) {
  solid_.use();
  gl_->Uniform1f(brightness_, static_cast<float>(book.brightness));
  if (with_depth) {
    gl_->Enable(GL_DEPTH_TEST);
  } else {
    gl_->Disable(GL_DEPTH_TEST);
  }
  place(view, book.corners_W, solid_uniforms_);
  const Mesh& mesh = mesh_for(book.corners_W);
  for (std::size_t part = 0; part < book_part_count; ++part) draw_part(mesh, part);
}

void BookPainter::draw_ghost(const View& view, const Corners& corners_W) {
  const Mesh& mesh = mesh_for(corners_W);
  // The nearest of its own faces first, so that no other shines through; of a bent book depth alone knows which they are.
  const auto draw_faces = [&] {
    ghost_.use();
    place(view, corners_W, ghost_uniforms_, -coincident);
    for (std::size_t part = book_part_count; part-- > 0;) draw_part(mesh, part);
  };
  gl_->Enable(GL_DEPTH_TEST);
  const bool bent = &mesh == &fine_hardcover_;
  if (bent) {
    gl_->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    draw_faces();
    gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  }

  gl_->Enable(GL_BLEND);
  border_.use();
  place(view, corners_W, border_uniforms_, coincident);
  gl_->BindVertexArray(border_vertex_array_.id());
  const Eigen::Vector2f half_frame = view.half_frame().cast<float>();
  gl_->Uniform2fv(half_frame_, 1, half_frame.data());
  std::array<float, 4> color = gl_color(ghost_tint);
  for (const bool seen : {false, true}) {
    gl_->DepthFunc(seen ? GL_LESS : GL_ALWAYS);
    gl_->DepthMask(seen ? GL_TRUE : GL_FALSE);
    color[3] = seen ? 0.85F : 0.4F;
    gl_->Uniform4fv(color_, 1, color.data());
    gl_->DrawArrays(GL_TRIANGLES, 0, border_count_);
  }

  gl_->DepthFunc(bent ? GL_LEQUAL : GL_LESS);
  draw_faces();
  gl_->DepthFunc(GL_LESS);
  gl_->Disable(GL_BLEND);
}

void BookPainter::place(const View& view, const Corners& corners_W, const Uniforms& uniforms, double nearer) {
  // In units of the camera's distance, so that single precision does for scenes of any size.
  const Eigen::Matrix<float, 3, 8> corners_C =
      (view.R_CW() * (corners_W.colwise() - view.eye_W()) / view.distance()).cast<float>();
  Eigen::Matrix4f clip_from_camera = view.clip_from_unit_camera().cast<float>();
  clip_from_camera.row(2) -= static_cast<float>(nearer) * clip_from_camera.row(3);
  gl_->Uniform3fv(uniforms.corners_C, 8, corners_C.data());
  gl_->UniformMatrix4fv(uniforms.clip_from_camera, 1, GL_FALSE, clip_from_camera.data());
  if (keeps_orientation(corners_W)) {
    gl_->Enable(GL_CULL_FACE);
  } else {
    gl_->Disable(GL_CULL_FACE);
  }
}

void BookPainter::draw_part(const Mesh& mesh, std::size_t part) {
  gl_->BindVertexArray(mesh.vertex_array.id());
  gl_->BindTexture(GL_TEXTURE_2D, textures_[std::max<std::size_t>(part, 1)].id());  // the insides are of paper, too
  gl_->DrawElements(GL_TRIANGLES, mesh.parts[part].indices, GL_UNSIGNED_SHORT,
                    buffer_offset(mesh.parts[part].first_byte));
}

}  // namespace bookspin
