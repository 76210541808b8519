#include "render/program.h"

#include <fmt/format.h>

#include <stdexcept>
#include <string>

#include "files/files.h"

namespace bookspin {
namespace {

Handle compile(const GladGLContext& gl, GLenum stage, const std::filesystem::path& file) {
  const std::string source = read_file(file);
  const char* const text = source.c_str();
  Handle shader = make_shader(gl, stage);
  gl.ShaderSource(shader.id(), 1, &text, nullptr);
  gl.CompileShader(shader.id());
  GLint good = 0;
  gl.GetShaderiv(shader.id(), GL_COMPILE_STATUS, &good);
  if (good == GL_FALSE) {
    GLint length = 0;
    gl.GetShaderiv(shader.id(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl.GetShaderInfoLog(shader.id(), length, nullptr, log.data());
    throw std::runtime_error(fmt::format("{}: compile shader: {}", file.string(), log.c_str()));
  }
  return shader;
}

}  // namespace

Program::Program(const GladGLContext& gl, const std::filesystem::path& vertex_file,
                 const std::filesystem::path& fragment_file)
    : gl_(&gl), vertex_file_(vertex_file), handle_(make_program(gl)) {
  const Handle vertex = compile(gl, GL_VERTEX_SHADER, vertex_file);
  const Handle fragment = compile(gl, GL_FRAGMENT_SHADER, fragment_file);
  gl.AttachShader(handle_.id(), vertex.id());
  gl.AttachShader(handle_.id(), fragment.id());
  gl.LinkProgram(handle_.id());
  gl.DetachShader(handle_.id(), vertex.id());
  gl.DetachShader(handle_.id(), fragment.id());
  GLint good = 0;
  gl.GetProgramiv(handle_.id(), GL_LINK_STATUS, &good);
  if (good == GL_FALSE) {
    GLint length = 0;
    gl.GetProgramiv(handle_.id(), GL_INFO_LOG_LENGTH, &length);
    std::string log(static_cast<std::size_t>(length), '\0');
    gl.GetProgramInfoLog(handle_.id(), length, nullptr, log.data());
    throw std::runtime_error(
        fmt::format("{}, {}: link shaders: {}", vertex_file.string(), fragment_file.string(), log.c_str()));
  }
}

GLint Program::uniform(const char* name) const {
  const GLint location = gl_->GetUniformLocation(handle_.id(), name);
  if (location < 0) {
    throw std::runtime_error(fmt::format("{}: find uniform: no {} in use", vertex_file_.string(), name));
  }
  return location;
}

}  // namespace bookspin
