// A shader program from two files of GLSL.
//
// Throws std::runtime_error: a file that cannot be read, a stage that does not compile or a program that does not link
// (with the file and OpenGL's own log), and a uniform that the program does not use.
#pragma once

#include <filesystem>

#include "render/handles.h"

namespace bookspin {

class Program {
 public:
  Program(const GladGLContext& gl, const std::filesystem::path& vertex_file,
          const std::filesystem::path& fragment_file);

  void use() const { gl_->UseProgram(handle_.id()); }
  [[nodiscard]] GLint uniform(const char* name) const;

 private:
  const GladGLContext* gl_;
  std::filesystem::path vertex_file_;
  Handle handle_;
};

}  // namespace bookspin
