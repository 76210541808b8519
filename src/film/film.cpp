#include "film/film.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "drawing_source.h"
#include "files/checksums.h"
#include "files/files.h"
#include "image/png.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "video/film_writer.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

void require_utf8(const std::string& place, const std::string& text) {
  try {
    (void)nlohmann::json(text).dump();
  } catch (const nlohmann::json::exception&) {
    throw std::invalid_argument(fmt::format("{}: found '{}'; allowed: text in UTF-8", place, text));
  }
}

}  // namespace

Film load_film(const fs::path& script, const FilmSettings& settings) {
  require_utf8("file name", script.stem().string());
  for (const std::string& text : settings.overrides) require_utf8("--set", text);
  Film film;
  film.file = script;
  film.script = read_file_or_pipe(script);
  film.scene = parse_scene(film.script, script.string(), settings.overrides);
  film.first_frame = settings.first_frame;
  film.end_frame = settings.end_frame.value_or(film.scene.clip.frames);
  film.width = settings.width;
  film.height = settings.height;
  film.format = settings.format;
  film.overrides = settings.overrides;
  film.drawn_by = settings.drawn_by;
  if (film.first_frame < 0 || film.first_frame >= film.end_frame || film.end_frame > film.scene.clip.frames) {
    throw std::invalid_argument(fmt::format("{}: found frames {}:{}; allowed: A:B with 0 <= A < B <= {}",
                                            script.string(), film.first_frame, film.end_frame, film.scene.clip.frames));
  }
  return film;
}

Products products(const Film& film, const fs::path& folder) {
  const std::string name = film.file.stem().string();
  return {folder / (name + "." + film.format), folder / (name + ".png"), folder / (name + ".json")};
}

std::map<std::string, std::string> library_versions() {
  return {{"libavcodec", encoder_version()}, {"libpng", png_version()}, {"FreeType", freetype_version()}};
}

std::string fingerprint_of_drawing(const fs::path& assets) {
  std::string all = drawing_source;
  for (const auto& [name, version] : library_versions()) all += fmt::format("\n{} {}", name, version);
  for (const fs::path& file : files_drawn_from(assets)) {
    all += fmt::format("\n{} {}", file.filename().string(), sha256(read_file(file)));
  }
  return sha256(all);
}

}  // namespace bookspin
