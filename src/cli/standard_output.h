// Standard output, and what becomes of the program when nobody can read it.
#pragma once

#include <string_view>

namespace bookspin {

// A closed standard stream stays closed: without this the next file that is opened would take its number, and with it
// what the program prints.
void reserve_standard_streams();

// Both throw std::runtime_error when standard output is full or closed.
void print(std::string_view text);
void finish_output();

}  // namespace bookspin
