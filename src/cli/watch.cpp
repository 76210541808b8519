#include "cli/watch.h"

#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <mutex>
#include <new>

#include "cli/standard_output.h"
#include "files/part.h"

namespace bookspin {
namespace {

constexpr std::array stop_signals{SIGINT, SIGTERM, SIGHUP};
constexpr int last_straw = 3;     // some senders signal twice: process and group
constexpr int patience = 5;       // tenths of a second, with a command that does not look at its token
constexpr int wake_up = SIGUSR2;  // ends the listener's wait
constexpr int nudge = SIGUSR1;    // ends the command's wait for a pipe

void do_nothing(int) {}

// Without SA_RESTART: a read, a write or an open that waits for somebody else, maybe for ever, fails with EINTR.
void handle(int number, void (*handler)(int), struct sigaction* before = nullptr) {
  struct sigaction action {};
  action.sa_handler = handler;
  sigaction(number, &action, before);
}

// Waits for signals in a thread of its own: they are blocked in all others, those that the command starts included.
class Listener {
 public:
  Listener() {
    handle(nudge, do_nothing, &nudge_before_);
    sigemptyset(&signals_);
    sigaddset(&signals_, wake_up);
    for (const int number : stop_signals) {
      struct sigaction now {};
      sigaction(number, nullptr, &now);
      if (now.sa_handler != SIG_IGN) sigaddset(&signals_, number);
    }
    pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    thread_ = std::jthread([this] { listen(); });
  }
  ~Listener() {
    pthread_kill(thread_.native_handle(), wake_up);
    thread_.join();
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    sigaction(nudge, &nudge_before_, nullptr);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] std::stop_token token() const { return source_.get_token(); }
  // The command is over. Returns the last signal, 0: none.
  [[nodiscard]] int end() {
    while (over_.exchange(true)) pause();  // until the other thread has ended the program
    return last_signal_;
  }

 private:
  void listen() {
    constexpr timespec a_while{0, 100'000'000};
    for (int count = 0, nudges = 0;;) {
      const int number =
          last_signal_ == 0 ? sigwaitinfo(&signals_, nullptr) : sigtimedwait(&signals_, nullptr, &a_while);
      if (number == wake_up) return;
      if (number < 0) {
        if (last_signal_ != 0) pthread_kill(command_, nudge);
        if (last_signal_ != 0 && ++nudges == patience) end_without_the_command();
        continue;
      }
      last_signal_ = number;
      source_.request_stop();
      if (++count < last_straw) continue;
      pthread_sigmask(SIG_UNBLOCK, &signals_, nullptr);
      std::raise(number);
    }
  }

  void end_without_the_command() {
    abandon_parts();
    if (over_.exchange(true)) return;
    complain(Stopped().what());
    _exit(128 + last_signal_);
  }

  const pthread_t command_ = pthread_self();
  struct sigaction nudge_before_ {};
  sigset_t signals_{};
  sigset_t before_{};
  std::atomic<int> last_signal_ = 0;
  std::atomic<bool> over_ = false;
  std::stop_source source_;
  std::jthread thread_;
};

volatile std::sig_atomic_t interrupts = 0;  // a handler reaches nothing else
volatile std::sig_atomic_t last_interrupt = 0;

// Again, each second: a signal may come just before the command begins to wait for a pipe.
void nudge_again(int) {
  alarm(1);
}

void count_interrupt(int number) {
  last_interrupt = number;
  interrupts = interrupts + 1;
  alarm(1);
  if (interrupts < last_straw) return;
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

int stoppable(const std::function<int(const std::stop_token&)>& command) {
  Listener listener;
  try {
    const int exit_code = command(listener.token());
    const int signal = listener.end();
    return exit_code == 0 || signal == 0 ? exit_code : 128 + signal;
  } catch (const std::exception& error) {
    const int signal = listener.end();
    if (signal == 0) throw;
    complain(error.what());
    return 128 + signal;
  }
}

Interrupts::Interrupts() {
  interrupts = 0;
  last_interrupt = 0;
  for (const int number : stop_signals) {
    struct sigaction now {};
    sigaction(number, nullptr, &now);
    if (now.sa_handler == SIG_IGN) continue;
    before_.emplace_back(number, now);
    handle(number, count_interrupt);
  }
  struct sigaction alarm_before {};
  handle(SIGALRM, nudge_again, &alarm_before);
  before_.emplace_back(SIGALRM, alarm_before);
}

Interrupts::~Interrupts() {
  alarm(0);
  for (const auto& [number, action] : before_) sigaction(number, &action, nullptr);
}

int Interrupts::last_signal() {
  return last_interrupt;
}

Watch::Watch(const Progress& progress, std::span<const Film> films)
    : progress_(progress),
      terminal_(isatty(STDERR_FILENO) == 1),
      films_(films.size()),
      start_(std::chrono::steady_clock::now()) {
  for (const Film& film : films) {
    frames_ += film.frames();
    book_frames_ += static_cast<long>(film.scene.books.size()) * film.scene.clip.frames;
  }
}

Watch::Watch(const Progress& progress, const Scene& scene)
    : progress_(progress),
      terminal_(isatty(STDERR_FILENO) == 1),
      book_frames_(static_cast<long>(scene.books.size()) * scene.clip.frames),
      start_(std::chrono::steady_clock::now()) {
  if (!terminal_) return;
  thread_ = std::jthread([this](const std::stop_token& token) {
    std::mutex mutex;
    std::condition_variable_any end;
    std::unique_lock lock(mutex);
    do {
      print_line();
    } while (!end.wait_for(lock, token, std::chrono::milliseconds(100), [&] { return token.stop_requested(); }));
  });
}

Watch::~Watch() {
  thread_ = {};
  if (terminal_) std::fputs("\r\x1b[K", stderr);
}

double Watch::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

// The terminal may be gone, or memory short: a line that cannot be written is dropped.
void Watch::print_line() const try {
  if (!terminal_) return;
  const long simulated = progress_.frames_simulated;
  const long drawn = progress_.frames_drawn;
  std::string line = fmt::format("{} % simulated", 100 * simulated / book_frames_);
  if (frames_ > 0) {
    line = fmt::format("{}/{} films, {}, {} of {} frames drawn", progress_.films_done.load(), films_, line, drawn,
                       frames_);
  }
  const long done = frames_ > 0 ? drawn : simulated;
  const double rate = static_cast<double>(done) / seconds();
  if (drawn > 0) line += fmt::format(", {:.0f}/s", rate);
  if (done > 0) {
    const long left = std::lround(static_cast<double>((frames_ > 0 ? frames_ : book_frames_) - done) / rate);
    line += fmt::format(", {}:{:02} left", left / 60, left % 60);
  }
  std::fprintf(stderr, "\r\x1b[K%s", line.c_str());
  std::fflush(stderr);
} catch (const std::bad_alloc&) {
}

}  // namespace bookspin
