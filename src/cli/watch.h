// Stopping a command, and watching films in the making.
#pragma once

#include <chrono>
#include <csignal>
#include <functional>
#include <span>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

#include "film/shoot.h"

namespace bookspin {

// Runs a command, which SIGINT, SIGTERM or SIGHUP asks to stop (unless the caller had them ignored, as nohup does); the
// third of them ends the program at once. A call of the command that waits for a pipe then fails with EINTR. Returns the
// command's exit code, or 128 + the signal's number when it failed or threw after a signal. What it throws otherwise
// passes. A command that goes on for half a second is ended with that code, and leaves no Part.
int stoppable(const std::function<int(const std::stop_token&)>& command);

// The same signals, counted without a thread, for a command that forks.
class Interrupts {
 public:
  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  [[nodiscard]] static int last_signal();  // 0: none

 private:
  std::vector<std::pair<int, struct sigaction>> before_;
};

// A progress line with the time left, on standard error when that is a terminal: of films, or of a scene that is
// simulated alone, which a thread then prints.
class Watch {
 public:
  Watch(const Progress& progress, std::span<const Film> films);
  Watch(const Progress& progress, const Scene& scene);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  void print_line() const;
  [[nodiscard]] double seconds() const;  // since the start

 private:
  const Progress& progress_;
  bool terminal_;
  std::size_t films_ = 0;
  long frames_ = 0;       // to be drawn
  long book_frames_ = 0;  // to be simulated
  std::chrono::steady_clock::time_point start_;
  std::jthread thread_;
};

}  // namespace bookspin
