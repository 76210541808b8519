// An off-screen OpenGL 3.3 core context on Mesa's software renderer.
//
// The library is found at run time: OSMesa, or EGL without a surface where OSMesa is missing (Mesa dropped it in 25.1).
// The frames of both are identical. A context is used by the thread that made it; several threads may each have their
// own. LP_NUM_THREADS=0 and LIBGL_ALWAYS_SOFTWARE=1 are set unless the environment sets them: one thread draws one
// film, and a graphics card does not make it another film. Throws std::runtime_error with each library's reason when
// none gives a context.
#pragma once

#include <glad/gl.h>

#include <memory>
#include <string>

namespace bookspin {

enum class ContextKind;  // in renderer.h

class Context {
 public:
  explicit Context(ContextKind kind);
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  void make_current();
  [[nodiscard]] const GladGLContext& gl() const { return gl_; }
  [[nodiscard]] const std::string& description() const { return description_; }  // library, GL_RENDERER, GL_VERSION

 private:
  struct Library;
  std::unique_ptr<Library> library_;
  GladGLContext gl_{};
  std::string description_;
};

}  // namespace bookspin
