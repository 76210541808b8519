// Move-only owners of OpenGL objects: a handle deletes its object when it goes, and needs its context current for that.
// The context's entry points must outlive the handles.
#pragma once

#include <glad/gl.h>

#include <cstddef>
#include <utility>

namespace bookspin {

class Handle {
 public:
  using Delete = void (*)(const GladGLContext&, GLuint);

  Handle() = default;
  Handle(const GladGLContext& gl, GLuint id, Delete destroy) : gl_(&gl), id_(id), destroy_(destroy) {}
  Handle(Handle&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)), destroy_(other.destroy_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    std::swap(destroy_, other.destroy_);
    return *this;
  }
  ~Handle() {
    if (id_ != 0) destroy_(*gl_, id_);
  }

  [[nodiscard]] GLuint id() const { return id_; }

 private:
  const GladGLContext* gl_ = nullptr;
  GLuint id_ = 0;
  Delete destroy_ = nullptr;
};

// OpenGL takes offsets into the bound buffer in the guise of pointers.
inline const void* buffer_offset(std::size_t bytes) {
  return reinterpret_cast<const void*>(bytes);  // NOLINT(performance-no-int-to-ptr)
}

inline Handle make_buffer(const GladGLContext& gl) {
  GLuint id = 0;
  gl.GenBuffers(1, &id);
  return {gl, id, [](const GladGLContext& g, GLuint i) { g.DeleteBuffers(1, &i); }};
}

inline Handle make_vertex_array(const GladGLContext& gl) {
  GLuint id = 0;
  gl.GenVertexArrays(1, &id);
  return {gl, id, [](const GladGLContext& g, GLuint i) { g.DeleteVertexArrays(1, &i); }};
}

inline Handle make_texture(const GladGLContext& gl) {
  GLuint id = 0;
  gl.GenTextures(1, &id);
  return {gl, id, [](const GladGLContext& g, GLuint i) { g.DeleteTextures(1, &i); }};
}

inline Handle make_framebuffer(const GladGLContext& gl) {
  GLuint id = 0;
  gl.GenFramebuffers(1, &id);
  return {gl, id, [](const GladGLContext& g, GLuint i) { g.DeleteFramebuffers(1, &i); }};
}

inline Handle make_renderbuffer(const GladGLContext& gl) {
  GLuint id = 0;
  gl.GenRenderbuffers(1, &id);
  return {gl, id, [](const GladGLContext& g, GLuint i) { g.DeleteRenderbuffers(1, &i); }};
}

inline Handle make_shader(const GladGLContext& gl, GLenum stage) {
  return {gl, gl.CreateShader(stage), [](const GladGLContext& g, GLuint i) { g.DeleteShader(i); }};
}

inline Handle make_program(const GladGLContext& gl) {
  return {gl, gl.CreateProgram(), [](const GladGLContext& g, GLuint i) { g.DeleteProgram(i); }};
}

}  // namespace bookspin
