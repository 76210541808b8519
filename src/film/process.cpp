#include "film/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <thread>

#include "files/part.h"

namespace bookspin {
namespace {

constexpr std::chrono::milliseconds patience{500};  // with work that does not look at its token
constexpr char returned = 'r', threw = 't';         // the first byte of what is said

[[noreturn]] void work_as_child(const std::function<std::string(const std::stop_token&)>& work, int pipe,
                                pid_t parent) {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGHUP, SIG_IGN);
  sigset_t term;
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);  // blocked since before the fork
  std::stop_source source;
  std::atomic<bool> over = false;
  const auto end_by_term = [&term] {
    std::signal(SIGTERM, SIG_DFL);
    pthread_sigmask(SIG_UNBLOCK, &term, nullptr);
    std::raise(SIGTERM);
  };
  std::thread([&] {
    int number = 0;
    sigwait(&term, &number);
    source.request_stop();
    std::this_thread::sleep_for(patience);
    abandon_parts();
    if (!over.exchange(true)) end_by_term();
  }).detach();
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) source.request_stop();

  std::string said;
  try {
    said = returned + work(source.get_token());
  } catch (const std::exception& error) {
    if (source.stop_requested()) end_by_term();  // all is taken back: now as the signal would have it
    said = std::string(1, threw) + error.what();
  }
  while (over.exchange(true)) pause();  // until the other thread has ended the process
  for (std::size_t at = 0; at < said.size();) {
    const ssize_t written = write(pipe, said.data() + at, said.size() - at);
    if (written < 0 && errno != EINTR) _exit(1);
    if (written > 0) at += static_cast<std::size_t>(written);
  }
  _exit(0);  // what the parent has begun is not this process's to end
}

}  // namespace

Process::Process(const std::function<std::string(const std::stop_token&)>& work) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("pipe: {}", std::strerror(errno)));
  pipe_ = ends[0];
  sigset_t stops, before;
  sigemptyset(&stops);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&stops, number);
  pthread_sigmask(SIG_BLOCK, &stops, &before);
  const pid_t parent = getpid();
  pid_ = fork();
  const int error = errno;
  if (pid_ == 0) work_as_child(work, ends[1], parent);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(ends[1]);
  if (pid_ > 0) return;
  close(pipe_);
  throw std::runtime_error(fmt::format("fork: {}", std::strerror(error)));
}

Process::~Process() {
  if (pipe_ >= 0) close(pipe_);
  if (pid_ <= 0) return;
  ask_to_stop();
  waitpid(pid_, nullptr, 0);
}

bool Process::read() {
  std::array<char, 4096> block{};
  const ssize_t count = ::read(pipe_, block.data(), block.size());
  if (count > 0) said_.append(block.data(), static_cast<std::size_t>(count));
  return count > 0 || (count < 0 && errno == EINTR);
}

void Process::ask_to_stop() const {
  kill(pid_, SIGTERM);
}

std::string Process::result() {
  while (read()) {
  }
  int status = 0;
  while (waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  pid_ = 0;
  if (WIFSIGNALED(status)) {
    throw std::runtime_error(fmt::format(
        "its process was ended by signal {} ({}){}", WTERMSIG(status), strsignal(WTERMSIG(status)),
        WTERMSIG(status) == SIGKILL ? ": so does the system when memory runs out; take fewer --jobs or pixels" : ""));
  }
  if (said_.empty()) throw std::runtime_error("its process ended without a word");
  if (said_.front() == threw) throw std::runtime_error(said_.substr(1));
  return said_.substr(1);
}

}  // namespace bookspin
