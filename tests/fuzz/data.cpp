// A film's data, as the page reads them: read, or refused with a message.

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "page/film_record.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  try {
    (void)bookspin::parse_film_record({reinterpret_cast<const char*>(bytes), size}, "fuzz.json");
  } catch (const std::invalid_argument&) {
  }
  return 0;
}
