#include "render/books.h"

#include <Eigen/LU>
#include <algorithm>
#include <cstddef>
#include <vector>

#include "image/png.h"
#include "render/gl_color.h"

namespace bookspin {
namespace {

constexpr Color ghost_tint{190, 228, 255, 255};
constexpr double coincident = 4e-5;  // depths that differ by less are one, in clip coordinates: an 800th of a book

// Mipmapped and trilinear. The smaller pictures are averaged in linear light, by a texture that OpenGL knows to be
// sRGB; the one that is drawn holds the same bytes as plain numbers (see book.frag).
Handle upload_texture(const GladGLContext& gl, const std::filesystem::path& file) {
  const Image image = read_png(file);
  const Handle averaged = make_texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, averaged.id());
  gl.TexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
                image.rgba.data());
  gl.GenerateMipmap(GL_TEXTURE_2D);
  std::vector<Image> levels{image};
  while (levels.back().width > 1 || levels.back().height > 1) {
    Image level(std::max(1, levels.back().width / 2), std::max(1, levels.back().height / 2));
    gl.GetTexImage(GL_TEXTURE_2D, static_cast<GLint>(levels.size()), GL_RGBA, GL_UNSIGNED_BYTE, level.rgba.data());
    levels.push_back(std::move(level));
  }

  Handle texture = make_texture(gl);
  gl.BindTexture(GL_TEXTURE_2D, texture.id());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    gl.TexImage2D(GL_TEXTURE_2D, static_cast<GLint>(i), GL_RGBA8, levels[i].width, levels[i].height, 0, GL_RGBA,
                  GL_UNSIGNED_BYTE, levels[i].rgba.data());
  }
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  return texture;
}

// The winding seen on the screen holds only where the map keeps its orientation: everywhere, if it does so at the
// corners of a book that is not badly bent. Otherwise depth alone decides what is seen.
bool keeps_orientation(const Corners& corners) {
  for (int i = 0; i < 8; ++i) {
    Eigen::Matrix3d derivative;
    for (int d = 0; d < 3; ++d) {
      const int bit = 1 << d;
      derivative.col(d) = corners.col(i | bit) - corners.col(i & ~bit);
    }
    if (!(derivative.determinant() > 0)) return false;
  }
  return true;
}

}  // namespace

bool is_unbent(const Corners& corners) {
  constexpr double allowed = 0.03;  // of the longest edge
  Eigen::Matrix3d edges;
  for (int d = 0; d < 3; ++d) edges.col(d) = corners.col(1 << d) - corners.col(0);
  double bend = 0;
  for (const int i : {3, 5, 6, 7}) {
    const Eigen::Vector3d affine = corners.col(0) + edges * Eigen::Vector3d(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    bend = std::max(bend, (corners.col(i) - affine).norm());
  }
  return bend <= allowed * edges.colwise().norm().maxCoeff() && keeps_orientation(corners);
}

BookPainter::BookPainter(const GladGLContext& gl, const std::filesystem::path& assets)
    : gl_(&gl),
      solid_(gl, assets / "shaders" / "book.vert", assets / "shaders" / "book.frag"),
      ghost_(gl, assets / "shaders" / "book.vert", assets / "shaders" / "ghost.frag"),
      solid_uniforms_(find_uniforms(solid_)),
      ghost_uniforms_(find_uniforms(ghost_)),
      brightness_(solid_.uniform("brightness")),
      opacity_(ghost_.uniform("opacity")),
      hardcover_(upload(gl, hardcover(1))),
      fine_hardcover_(upload(gl, hardcover(4))) {
  const std::array<const char*, book_part_count> names{"pages.png", "front.png", "back.png", "spine.png"};
  for (std::size_t i = 0; i < book_part_count; ++i) {
    textures_[i] = upload_texture(gl, assets / "textures" / names[i]);
  }
  ghost_.use();
  const std::array<float, 4> tint = gl_color(ghost_tint);
  gl.Uniform3fv(ghost_.uniform("tint"), 1, tint.data());
}

BookPainter::Uniforms BookPainter::find_uniforms(const Program& program) {
  return {program.uniform("corners_C"), program.uniform("clip_from_camera")};
}

BookPainter::Mesh BookPainter::upload(const GladGLContext& gl, const BookMesh& mesh) {
  Mesh result{make_vertex_array(gl), make_buffer(gl), make_buffer(gl), {}};
  gl.BindVertexArray(result.vertex_array.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, result.vertices.id());
  gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(BookVertex)),
                mesh.vertices.data(), GL_STATIC_DRAW);
  const auto attribute = [&](GLuint location, GLint size, std::size_t offset) {
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, size, GL_FLOAT, GL_FALSE, sizeof(BookVertex), buffer_offset(offset));
  };
  attribute(0, 3, offsetof(BookVertex, position));
  attribute(1, 3, offsetof(BookVertex, normal));
  attribute(2, 2, offsetof(BookVertex, texture));
  attribute(3, 1, offsetof(BookVertex, shade));

  std::vector<std::uint16_t> indices;
  for (std::size_t i = 0; i < book_part_count; ++i) {
    result.parts[i] = {static_cast<GLsizei>(mesh.triangles[i].size()), indices.size() * sizeof(std::uint16_t)};
    indices.insert(indices.end(), mesh.triangles[i].begin(), mesh.triangles[i].end());
  }
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, result.indices.id());
  gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices.size() * sizeof(std::uint16_t)),
                indices.data(), GL_STATIC_DRAW);
  return result;
}

void BookPainter::draw_solid(const View& view, const BookPose& book, bool with_depth) {
  solid_.use();
  gl_->Uniform1f(brightness_, static_cast<float>(book.brightness));
  if (with_depth) {
    gl_->Enable(GL_DEPTH_TEST);
  } else {
    gl_->Disable(GL_DEPTH_TEST);
  }
  draw(view, book.corners_W, solid_uniforms_);
}

void BookPainter::draw_ghost(const View& view, const Corners& corners_W) {
  ghost_.use();
  gl_->Enable(GL_DEPTH_TEST);
  // Depth first, so that of its own faces only the nearest are seen.
  gl_->ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  draw(view, corners_W, ghost_uniforms_, -coincident);
  gl_->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  gl_->DepthMask(GL_FALSE);
  gl_->Enable(GL_BLEND);
  struct Layer {
    GLenum depth;
    double nearer;
    float faces, edges;  // opacity
    BookPart first_part;
  };
  for (const Layer& layer : {Layer{GL_EQUAL, -coincident, 0.40F, 0.40F, BookPart::pages},
                             Layer{GL_ALWAYS, 0.0, 0.0F, 0.40F, BookPart::front},
                             Layer{GL_LESS, coincident, 0.0F, 0.80F, BookPart::front}}) {
    gl_->DepthFunc(layer.depth);
    gl_->Uniform2f(opacity_, layer.faces, layer.edges);
    draw(view, corners_W, ghost_uniforms_, layer.nearer, layer.first_part);
  }
  gl_->Disable(GL_BLEND);
  gl_->DepthFunc(GL_LESS);
  gl_->DepthMask(GL_TRUE);
}

void BookPainter::draw(const View& view, const Corners& corners_W, const Uniforms& uniforms, double nearer,
                       BookPart first_part) {
  const Mesh& mesh = is_unbent(corners_W) ? hardcover_ : fine_hardcover_;
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
  gl_->BindVertexArray(mesh.vertex_array.id());
  for (auto i = static_cast<std::size_t>(first_part); i < book_part_count; ++i) {
    gl_->BindTexture(GL_TEXTURE_2D, textures_[i].id());
    gl_->DrawElements(GL_TRIANGLES, mesh.parts[i].indices, GL_UNSIGNED_SHORT, buffer_offset(mesh.parts[i].first_byte));
  }
}

}  // namespace bookspin
