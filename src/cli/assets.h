// Where the program's own files are: the folder of shaders, textures, videos and data.
//
// --assets DIR, else $BOOKSPIN_ASSETS, else what stands beside the program: PREFIX/share/bookspin for PREFIX/bin/bookspin,
// the checkout for CHECKOUT/build/bookspin, wherever it was moved; else the source tree that it was built from. Throws
// std::runtime_error with all places that it looked at.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace bookspin {

[[nodiscard]] std::filesystem::path find_assets(const std::string& option);

// The motion in WebAssembly (src/live): where the program was built, or among the assets. None where it could not be
// built.
[[nodiscard]] std::optional<std::filesystem::path> find_live_module(const std::filesystem::path& assets);

}  // namespace bookspin
