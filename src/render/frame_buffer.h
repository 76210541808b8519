// Where the drawing goes: four samples a pixel, and depth where asked for; and the way out of it.
//
// The first row is the picture's top row. Throws std::runtime_error when OpenGL has no such frame buffer.
#pragma once

#include "image/image.h"
#include "render/handles.h"
#include "render/shot.h"

namespace bookspin {

class FrameBuffer {
 public:
  FrameBuffer(const GladGLContext& gl, int width, int height);

  // All drawing until read() stays within area, which is cleared.
  void begin(const Rect& area, const Color& background, bool with_depth);
  // The samples averaged, copied to the same place in image.
  void read(const Rect& area, Image& image);

 private:
  const GladGLContext* gl_;
  int width_, height_;
  Handle samples_, sample_color_;
  Handle sample_depth_;  // once a picture needs it: 15 MB at 1280x720
  Handle pixels_, pixel_color_;
};

}  // namespace bookspin
