// Where the drawing goes: four samples a pixel, and depth where asked for; and the way out of it.
//
// The first row is the picture's top row. Throws std::runtime_error when OpenGL has no such frame buffer.
#pragma once

#include <vector>

#include "image/image.h"
#include "render/handles.h"
#include "render/shot.h"

namespace bookspin {

class FrameBuffer {
 public:
  FrameBuffer(const GladGLContext& gl, int width, int height);

  // Until read() all drawing is to stay within the areas, which are cleared.
  void begin(const std::vector<Rect>& areas, const Color& background, bool with_depth);
  // The samples averaged, copied to the same places in image.
  void read(const std::vector<Rect>& areas, Image& image);

 private:
  const GladGLContext* gl_;
  int width_, height_;
  Handle samples_, sample_color_;
  Handle sample_depth_;  // once a picture needs it: 15 MB at 1280x720
  Handle pixels_, pixel_color_;
};

}  // namespace bookspin
