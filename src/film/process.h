// A function at work in a process of its own: what it returns, or throws, comes back through a pipe.
//
// Processes, not threads: Mesa's software renderer has one lock for all threads that draw (two of them spend a sixth of
// their time waiting for it), and one that is killed takes nobody with it. Fork before OpenGL or threads are begun. The
// function's token is asked to stop by ask_to_stop(), by SIGTERM from anywhere, and when the parent has gone; when it has
// thrown thereupon, or goes on for half a second, the process ends by SIGTERM and leaves no Part. SIGINT and SIGHUP,
// which a terminal sends to all, are the parent's to pass on. Throws std::runtime_error when the system has no process or
// pipe left.
#pragma once

#include <functional>
#include <stop_token>
#include <string>

namespace bookspin {

class Process {
 public:
  explicit Process(const std::function<std::string(const std::stop_token&)>& work);
  ~Process();  // asks it to stop, and waits
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  [[nodiscard]] int descriptor() const { return pipe_; }  // to be polled: readable when read() has something to do
  bool read();                                            // takes what has come; false: that was all
  void ask_to_stop() const;
  // Waits for the end. Throws std::runtime_error: what the function threw, or how the process died.
  [[nodiscard]] std::string result();

 private:
  int pid_ = 0;
  int pipe_ = -1;
  std::string said_;
};

}  // namespace bookspin
