// Faults of the outside world, one at a time: a system call that fails or is cut short, or a process that is killed
// at it.
//
// lseek is left alone: of a regular file it cannot fail. So are pipes, which are no files.
//
// For a process forked from a test: after arm() its calls that touch files go through a handler (seccomp's SIGSYS), also
// those that libraries and the C library make themselves. Only on Linux for x86-64 and arm64: elsewhere
// can_inject_faults() is false, as it is where the kernel refuses the filter. Source: seccomp(2).
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <string>

namespace bookspin {

enum class Fault {
  none,           // calls are counted
  fails,          // the call returns `error`
  keeps_failing,  // it, and all after it
  cut_short,      // a write takes half of what it is given; other calls are left alone
  kills,          // the process dies at it, before it is done
};

struct Experiment {
  Fault fault = Fault::none;
  int number = 0;  // which call, from 1
  int error = 0;   // errno
};

struct Outcome {
  bool killed = false;  // by SIGKILL
  int exit_code = -1;   // 0: the work is done; 1: it threw; -1: another end
  std::string message;  // what it threw
  int calls = 0;        // that it made
};

[[nodiscard]] bool can_inject_faults();

// Where a file that is flushed to the disk costs nothing, if there is such a place.
[[nodiscard]] std::filesystem::path folder_in_memory();

// Does the work in a child of this process, which it leaves as it is.
[[nodiscard]] Outcome attempt(const Experiment& experiment, const std::function<void()>& work);

}  // namespace bookspin
