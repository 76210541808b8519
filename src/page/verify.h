// Whether what bookspin made in a folder is still as it was made: every file that the folder's list names
// (files/checksums.h), and of each film whether film, poster and data are of one making, and its claims met.
//
// Throws std::runtime_error when the folder has no list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace bookspin {

struct Finding {
  std::string file;  // a film is its data's name
  bool whole = false;
  bool met = true;   // every claim
  std::string says;  // what is wrong, or how it was made
};

// Films first, then what else is listed; by name.
[[nodiscard]] std::vector<Finding> verify(const std::filesystem::path& folder);

}  // namespace bookspin
