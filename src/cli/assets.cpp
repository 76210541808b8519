#include "cli/assets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "files/files.h"

namespace bookspin {

namespace fs = std::filesystem;

fs::path find_assets(const std::string& option) {
  const char* variable = std::getenv("BOOKSPIN_ASSETS");
  std::vector<fs::path> places;
  if (!option.empty()) {
    places = {option};
  } else if (variable != nullptr && *variable != '\0') {
    places = {variable};
  } else {
    std::error_code unknown;
    const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
    const fs::path prefix = program.parent_path().parent_path();
    if (!unknown) places = {prefix / "share" / "bookspin", prefix};
    places.emplace_back(BOOKSPIN_SOURCE_DIR);
  }
  constexpr std::array parts{"shaders", "textures", "videos", "data"};
  std::string looked;
  for (const fs::path& place : places) {
    if (std::all_of(parts.begin(), parts.end(), [&](const char* part) { return fs::is_directory(place / part); })) {
      return place;
    }
    looked += "\n  " + place.string();
  }
  throw std::runtime_error(fmt::format(
      "the program's files (folders {}) are not in{}\nsay where they are: --assets DIR, or BOOKSPIN_ASSETS=DIR "
      "in the environment",
      fmt::join(parts, ", "), looked));
}

std::optional<fs::path> find_live_module(const fs::path& assets) {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown);
  for (const fs::path& file : {program.parent_path() / "live" / "live.wasm", assets / "live" / "live.wasm"}) {
    if (is_file(file)) return file;
  }
  return {};
}

}  // namespace bookspin
