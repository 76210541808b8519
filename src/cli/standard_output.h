// Standard output and error, and what becomes of the program when nobody can read them.
//
// Control characters, which names of files and titles may hold, are said as '?': they would command the terminal. Lines
// and tabs stay, and data are given as they are.
#pragma once

#include <string_view>

namespace bookspin {

// A closed standard stream stays closed: without this the next file that is opened would take its number, and with it
// what the program prints.
void reserve_standard_streams();

void complain(std::string_view what);  // "bookspin: WHAT" to standard error; that nobody reads it is no reason to stop

// All throw std::runtime_error when standard output is full or closed.
void print(std::string_view text);
void print_data(std::string_view data);
void finish_output();

}  // namespace bookspin
