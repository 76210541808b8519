#include "cli/watch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

namespace bookspin {
namespace {

// A signal handler reaches nothing but a lock-free global.
volatile std::sig_atomic_t signal_seen = 0;

void remember_signal(int number) {
  signal_seen = signal_seen + 1;
  if (signal_seen >= 2) std::signal(number, SIG_DFL);  // some senders signal twice: process and group
}

}  // namespace

Watch::Watch(Progress& progress, long frames, int films)
    : progress_(&progress), frames_(frames), films_(films), start_(std::chrono::steady_clock::now()) {
  std::signal(SIGINT, remember_signal);
  std::signal(SIGTERM, remember_signal);
  thread_ = std::jthread([this](const std::stop_token& token) {
    const bool terminal = isatty(STDERR_FILENO) == 1;
    while (!token.stop_requested()) {
      if (signal_seen != 0) progress_->stop = true;
      if (terminal) print_line();
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    if (terminal) fmt::print(stderr, "\r\x1b[K");
  });
}

Watch::~Watch() {
  thread_.request_stop();
  thread_.join();
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
}

double Watch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void Watch::print_line() const {
  const long done = progress_->frames_done;
  const double rate = static_cast<double>(done) / seconds();
  const int left = rate > 0.0 ? static_cast<int>(static_cast<double>(frames_ - done) / rate) : 0;
  fmt::print(stderr, "\r\x1b[K{} of {} films, frame {} of {} ({} %), {:.0f} frames/s, {}:{:02} left",
             progress_->films_done.load(), films_, done, frames_, 100 * done / frames_, rate, left / 60, left % 60);
  std::fflush(stderr);
}

}  // namespace bookspin
