// Stopping a command, and watching films in the making.
#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <stop_token>
#include <thread>

#include "film/shoot.h"

namespace bookspin {

// Runs a command, which SIGINT, SIGTERM or SIGHUP asks to stop (unless the caller had them ignored, as nohup does); the
// third of them ends the program at once. Returns the command's exit code, or 128 + the signal's number when it threw
// after a signal. What it throws otherwise passes.
int stoppable(const std::function<int(const std::stop_token&)>& command);

// A progress line with the time left, on standard error when that is a terminal: of films, or of a scene that is
// simulated alone.
class Watch {
 public:
  Watch(const Progress& progress, std::span<const Film> films);
  Watch(const Progress& progress, const Scene& scene);

  [[nodiscard]] double seconds() const;  // since the start

 private:
  void start();
  void print_line() const;

  const Progress& progress_;
  std::size_t films_ = 0;
  long frames_ = 0;       // to be drawn
  long book_frames_ = 0;  // to be simulated
  std::chrono::steady_clock::time_point start_;
  std::jthread thread_;
};

}  // namespace bookspin
