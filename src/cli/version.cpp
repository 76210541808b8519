#include "cli/version.h"

#include <fmt/format.h>
#include <ft2build.h>
#include <png.h>
#include FT_FREETYPE_H

#include <Eigen/Core>
#if __has_include(<toml++/impl/version.hpp>)  // from 3.4 on
#include <toml++/impl/version.hpp>
#else
#include <toml++/impl/version.h>
#endif

#include "commit.h"  // written by the build: BOOKSPIN_COMMIT

extern "C" {
#include <libavcodec/avcodec.h>
}

namespace bookspin {
namespace {

std::string freetype_version() {
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return "unknown";
  int major = 0;
  int minor = 0;
  int patch = 0;
  FT_Library_Version(library, &major, &minor, &patch);
  FT_Done_FreeType(library);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

std::string eigen_version() {
#ifdef EIGEN_VERSION_STRING  // from 5 on
  return EIGEN_VERSION_STRING;
#else
  return fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
#endif
}

}  // namespace

std::string commit() {
  return BOOKSPIN_COMMIT;
}

std::string version() {
  return "bookspin " BOOKSPIN_VERSION;
}

std::string version_text() {
  const unsigned avcodec = avcodec_version();
  return fmt::format(
      "{}{}\n{}\n"
      "libavcodec {}.{}.{}, libpng {}, FreeType {}, Eigen {}, fmt {}.{}.{}, toml++ {}.{}.{}",
      version(), commit().empty() ? "" : fmt::format(" (commit {})", commit()), BOOKSPIN_COMPILER, avcodec >> 16U,
      avcodec >> 8U & 0xffU, avcodec & 0xffU, png_get_libpng_ver(nullptr), freetype_version(), eigen_version(),
      FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH);
}

}  // namespace bookspin
