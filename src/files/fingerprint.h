// Tells contents apart: 64 bits, FNV-1a, as 16 hexadecimal digits. No protection against forgery.
// Source: Fowler, Noll and Vo, the FNV hash.
#pragma once

#include <string>
#include <string_view>

namespace bookspin {

[[nodiscard]] std::string fingerprint(std::string_view bytes);

}  // namespace bookspin
