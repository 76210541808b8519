// doctor: each thing that films and reports need of the machine is tried as they would use it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <functional>
#include <stdexcept>

#include "cli/assets.h"
#include "cli/commands.h"
#include "cli/effort.h"
#include "cli/standard_output.h"
#include "cli/version.h"
#include "files/files.h"
#include "render/renderer.h"
#include "render/text.h"
#include "report/plots.h"
#include "video/film_writer.h"

namespace bookspin {
namespace {

struct Check {
  const char* what;
  std::function<std::string()> found;  // throws when it is missing
  const char* without;                 // what it means, what to install
};

// Whether it is there; prints what was found.
bool passes(const Check& check) {
  try {
    print(fmt::format("have     {:12} {}\n", check.what, check.found()));
    return true;
  } catch (const std::exception& error) {
    print(fmt::format("MISSING  {:12} {}\n                      {}\n", check.what, error.what(), check.without));
    return false;
  }
}

std::string own_files(const std::string& option) {
  const std::filesystem::path folder = find_assets(option);
  for (const std::filesystem::path& file : files_drawn_from(folder)) (void)read_file(file);
  return folder.string();
}

std::string fonts() {
  const TextPainter opens_them;
  return fmt::format("{}", fmt::join(font_files(), " "));
}

}  // namespace

int examine(const Options& options) {
  require_room(options.width, options.height);
  print(version_text() + "\n\n");
  const bool osmesa = passes({"OSMesa", [] { return describe_opengl(ContextKind::osmesa); },
                              "where EGL is there it draws the same films; package libosmesa6"});
  const bool egl = passes({"EGL", [] { return describe_opengl(ContextKind::egl); },
                           "where OSMesa is there it draws the same films; packages libegl1 and libgl1-mesa-dri"});
  const bool encoder = passes({"encoder", describe_encoder, "no films, only frames; FFmpeg's libraries with libx264"});
  const bool font = passes({"fonts", fonts, "no pictures; package fonts-inter"});
  const bool assets = passes({"own files", [&] { return own_files(options.assets); },
                              "no pictures; install bookspin again, or say where they are"});
  (void)passes({"gnuplot",
                [] {
                  require_gnuplot();
                  return std::string("draws the plots of the report");
                },
                "no report, and nothing else is lost; package gnuplot-nox"});
  const bool films = (osmesa || egl) && encoder && font && assets;
  print(films ? "\nFilms can be made.\n" : "\nFilms cannot be made; `check`, `list` and `trajectory` work.\n");
  return films ? 0 : 1;
}

}  // namespace bookspin
