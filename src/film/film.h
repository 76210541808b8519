// What is to be made: a film of a scene script, read once and complete.
//
// The script's text is kept: the scene, what the data show as the script and what is compared when a film may be up to
// date are one reading, whatever becomes of the file meanwhile. It may be a FIFO. Throws std::invalid_argument for a bad
// script, for frames that the scene lacks, and for a name or an override that is not UTF-8, as the data must be;
// std::runtime_error when a file cannot be read.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace bookspin {

struct FilmSettings {
  int width = 1280;                    // pixels, even
  int height = 720;                    // pixels, even
  std::string format = "mp4";          // mp4, webm, gif
  int first_frame = 0;                 // of the scene's frames
  std::optional<int> end_frame;        // the first one not drawn; none: all to the end
  std::vector<std::string> overrides;  // as given, in order
  std::string drawn_by;                // fingerprint_of_drawing()
};

struct Film {
  std::filesystem::path file;  // the script; its stem is the name of the products
  std::string script;          // its text, of which `scene` was read
  Scene scene;
  int first_frame = 0;
  int end_frame = 0;  // the first one not drawn
  int width = 1280;   // pixels
  int height = 720;   // pixels
  std::string format = "mp4";
  std::vector<std::string> overrides;
  std::string drawn_by;

  [[nodiscard]] int frames() const { return end_frame - first_frame; }    // drawn
  [[nodiscard]] bool is_still() const { return scene.clip.frames == 1; }  // a picture, no film
};

[[nodiscard]] Film load_film(const std::filesystem::path& script, const FilmSettings& settings);

// What a film leaves in its folder. A still has no film.
struct Products {
  std::filesystem::path film;    // NAME.mp4, or of another format
  std::filesystem::path poster;  // NAME.png, the middle frame
  std::filesystem::path data;    // NAME.json, as film_data.h says
};

[[nodiscard]] Products products(const Film& film, const std::filesystem::path& folder);

// Of the libraries, beside OpenGL, whose version shapes the bytes of a film.
[[nodiscard]] std::map<std::string, std::string> library_versions();

// Of all that makes a picture, beside the script and OpenGL: shaders, textures, fonts, libraries, and the program's own
// source from dynamics to film. Another program that draws alike has the same. Throws std::runtime_error when one is missing.
[[nodiscard]] std::string fingerprint_of_drawing(const std::filesystem::path& assets);

}  // namespace bookspin
