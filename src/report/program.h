// Another program, run to its end: no shell, so that a name may hold any character.
//
// Found by PATH. `status` is what it exited with, 128 + n when signal n ended it, program_not_found when it could not be
// started. Throws std::runtime_error when the system refuses.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bookspin {

inline constexpr int program_not_found = 127;

struct Finished {
  int status = 0;
  std::string out;     // its standard output
  std::string errors;  // its standard error
};

[[nodiscard]] Finished run_program(const std::string& program, const std::vector<std::string>& arguments,
                                   std::string_view input);

}  // namespace bookspin
