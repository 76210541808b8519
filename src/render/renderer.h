// Shots to pixels.
//
// assets is the folder that holds shaders/ and textures/. A Renderer belongs to the thread that made it; several
// threads may each have one, and all draw the same bytes. Only what differs from the previous shot is drawn again, and
// the picture is byte for byte the one that a new Renderer would draw. The constructor throws std::runtime_error: no
// OpenGL, a shader or texture or font that is missing or bad.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "image/image.h"
#include "render/shot.h"

namespace bookspin {

enum class ContextKind { any, osmesa, egl };  // whose OpenGL; any: OSMesa's, else EGL's

class Renderer {
 public:
  Renderer(int width, int height, const std::filesystem::path& assets, ContextKind kind = ContextKind::any);
  ~Renderer();
  Renderer(Renderer&&) = delete;
  Renderer& operator=(Renderer&&) = delete;

  const Image& draw(const Shot& shot);  // valid until the next draw
  // These hold every pixel in which the last two pictures differ.
  [[nodiscard]] const std::vector<Rect>& changed() const;
  [[nodiscard]] const std::string& description() const;  // the OpenGL that draws

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

// The OpenGL that would draw. Throws std::runtime_error when there is none of the kind.
[[nodiscard]] std::string describe_opengl(ContextKind kind);

[[nodiscard]] std::string freetype_version();

// Every file that a renderer reads: shaders, textures, fonts.
[[nodiscard]] std::vector<std::filesystem::path> files_drawn_from(const std::filesystem::path& assets);

}  // namespace bookspin
