// Where and from what the report was made: so that its times mean something elsewhere.
#pragma once

#include <filesystem>
#include <string>

namespace bookspin {

struct Machine {
  std::string processor;  // as the kernel names it
  int cores = 0;
  std::string compiler;  // name and version
  std::string flags;     // of every object file
  std::string commit;    // of the source, with "+" when files differ from it; "unknown" outside a repository
};

[[nodiscard]] Machine this_machine(const std::filesystem::path& project);

}  // namespace bookspin
