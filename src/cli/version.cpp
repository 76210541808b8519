#include "cli/version.h"

#include <fmt/format.h>
#include <Eigen/Core>
#if __has_include(<toml++/impl/version.hpp>)  // from 3.4 on
#include <toml++/impl/version.hpp>
#else
#include <toml++/impl/version.h>
#endif

#include "commit.h"  // written by the build: BOOKSPIN_COMMIT
#include "film/film.h"

namespace bookspin {
namespace {

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
  std::string libraries;
  for (const auto& [name, version] : library_versions()) libraries += fmt::format("{} {}, ", name, version);
  return fmt::format("{}{}\n{}\n{}Eigen {}, fmt {}.{}.{}, toml++ {}.{}.{}", version(),
                     commit().empty() ? "" : fmt::format(" (commit {})", commit()), BOOKSPIN_COMPILER, libraries,
                     eigen_version(), FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, TOML_LIB_MAJOR,
                     TOML_LIB_MINOR, TOML_LIB_PATCH);
}

}  // namespace bookspin
