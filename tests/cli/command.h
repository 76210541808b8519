// Runs a command line as a user would, and catches what it says.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <string>

#include "scratch.h"

namespace bookspin {

struct Said {
  int exit_code = -1;
  std::string out;
  std::string err;
};

inline Said run(const Scratch& scratch, const std::string& command) {
  const std::string out = (scratch / ".out").string();
  const std::string err = (scratch / ".err").string();
  const int status = std::system(
      ("cd " + scratch.folder().string() + " && " + command + " >" + out + " 2>" + err + " </dev/null").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_text(out), read_text(err)};
}

}  // namespace bookspin
