// A texture, with every checksum put right: read, or refused with a message.

#include <zlib.h>

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "image/png.h"

namespace {

std::size_t number_at(const std::string& bytes, std::size_t at) {
  std::size_t number = 0;
  for (std::size_t i = 0; i < 4; ++i) number = number << 8U | static_cast<unsigned char>(bytes[at + i]);
  return number;
}

// A chunk: length, type, as many bytes as that, and their checksum. Without this hardly an input gets beyond it.
void put_checksums_right(std::string& bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const auto* type = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const std::size_t sum = crc32(0, type, static_cast<uInt>(length + 4));
    for (std::size_t i = 0; i < 4; ++i) bytes[at + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
    at += length + 12;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes(reinterpret_cast<const char*>(data), size);
  put_checksums_right(bytes);
  constexpr std::size_t width = 16, height = 20, largest = 256;  // a larger picture is none the better, and slow
  if (size < height + 4 || number_at(bytes, width) > largest || number_at(bytes, height) > largest) return 0;
  try {
    (void)bookspin::parse_png(bytes, "fuzz.png");
  } catch (const std::runtime_error&) {
  }
  return 0;
}
