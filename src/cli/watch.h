// Watches films in the making: a progress line with the time left, when standard error is a terminal, and Ctrl-C.
//
// While it lives, SIGINT and SIGTERM ask every film to stop at its next frame; no half-made file stays behind. A third
// signal ends the program at once.
#pragma once

#include <chrono>
#include <thread>

#include "film/shoot.h"

namespace bookspin {

class Watch {
 public:
  Watch(Progress& progress, long frames, int films);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  [[nodiscard]] double seconds() const;  // since the start

 private:
  void print_line() const;

  Progress* progress_;
  long frames_;
  int films_;
  std::chrono::steady_clock::time_point start_;
  std::jthread thread_;
};

}  // namespace bookspin
