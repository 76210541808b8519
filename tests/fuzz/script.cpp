// A scene script, then overrides, each behind a byte 1: read, or refused with a message.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(bytes), size);
  std::vector<std::string> overrides;
  for (std::size_t at = text.rfind('\x01'); at != std::string::npos; at = text.rfind('\x01')) {
    overrides.push_back(text.substr(at + 1));
    text.resize(at);
  }
  try {
    (void)bookspin::parse_scene(text, "fuzz.toml", overrides);
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
