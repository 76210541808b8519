#include "render/frame_buffer.h"

#include <fmt/format.h>

#include <stdexcept>

#include "render/gl_color.h"

namespace bookspin {
namespace {

constexpr GLsizei samples = 4;

Handle storage(const GladGLContext& gl, GLsizei count, GLenum format, int width, int height) {
  Handle buffer = make_renderbuffer(gl);
  gl.BindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  gl.RenderbufferStorageMultisample(GL_RENDERBUFFER, count, format, width, height);
  return buffer;
}

void check_complete(const GladGLContext& gl, const char* what) {
  const GLenum status = gl.CheckFramebufferStatus(GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE) {
    throw std::runtime_error(fmt::format("OpenGL: make {} frame buffer: status {:#x}", what, status));
  }
}

}  // namespace

FrameBuffer::FrameBuffer(const GladGLContext& gl, int width, int height)
    : gl_(&gl),
      width_(width),
      height_(height),
      samples_(make_framebuffer(gl)),
      sample_color_(storage(gl, samples, GL_RGBA8, width, height)),
      pixels_(make_framebuffer(gl)),
      pixel_color_(storage(gl, 0, GL_RGBA8, width, height)) {
  gl.BindFramebuffer(GL_FRAMEBUFFER, pixels_.id());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, pixel_color_.id());
  check_complete(gl, "resolved");
  gl.BindFramebuffer(GL_FRAMEBUFFER, samples_.id());
  gl.FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, sample_color_.id());
  check_complete(gl, "multisample");

  gl.Viewport(0, 0, width, height);
  gl.Enable(GL_SCISSOR_TEST);
  gl.FrontFace(GL_CW);  // y runs down
  gl.CullFace(GL_BACK);
  gl.DepthFunc(GL_LESS);
  // Alpha stays 1: the picture is opaque.
  gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
}

void FrameBuffer::begin(const std::vector<Rect>& areas, const Color& background, bool with_depth) {
  gl_->BindFramebuffer(GL_FRAMEBUFFER, samples_.id());
  if (with_depth && sample_depth_.id() == 0) {
    sample_depth_ = storage(*gl_, samples, GL_DEPTH_COMPONENT24, width_, height_);
    gl_->FramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, sample_depth_.id());
    check_complete(*gl_, "multisample");
  }
  const std::array<float, 4> color = gl_color(background);
  gl_->ClearColor(color[0], color[1], color[2], 1);
  Rect all;
  for (const Rect& area : areas) {
    gl_->Scissor(area.x, area.y, area.width, area.height);
    gl_->Clear(with_depth ? GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT : GL_COLOR_BUFFER_BIT);
    all = union_of(all, area);
  }
  gl_->Scissor(all.x, all.y, all.width, all.height);
}

void FrameBuffer::read(const std::vector<Rect>& areas, Image& image) {
  gl_->BindFramebuffer(GL_DRAW_FRAMEBUFFER, pixels_.id());
  for (const Rect& area : areas) {
    const int x1 = area.x + area.width, y1 = area.y + area.height;
    gl_->BlitFramebuffer(area.x, area.y, x1, y1, area.x, area.y, x1, y1, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  }
  gl_->BindFramebuffer(GL_READ_FRAMEBUFFER, pixels_.id());
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, image.width);
  for (const Rect& area : areas) {
    gl_->ReadPixels(area.x, area.y, area.width, area.height, GL_RGBA, GL_UNSIGNED_BYTE, image.pixel(area.x, area.y));
  }
}

}  // namespace bookspin
