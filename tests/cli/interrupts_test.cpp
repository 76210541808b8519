// Signals, and a terminal that goes away, while the program works.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "cli/my_script.h"
#include "cli/watch.h"
#include "files/part.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;

// Starts the program without a shell, which would have it ignore SIGINT; `error` and `output` are its standard streams.
// Whoever runs the tests may have them ignore signals: in the background of a script, or by nohup.
pid_t start(const fs::path& folder, std::vector<const char*> arguments, const char* error = "/dev/null",
            const char* output = "/dev/null", void (*on_hangup)(int) = SIG_DFL) {
  std::fflush(stdout);  // once, not by the child too
  const pid_t child = fork();
  if (child != 0) return child;
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGHUP, on_hangup);
  fs::current_path(folder);
  if (std::freopen(output, "w", stdout) == nullptr || std::freopen(error, "w", stderr) == nullptr) _exit(126);
  arguments.insert(arguments.begin(), "bookspin");
  arguments.push_back(nullptr);
  execv((std::string(BOOKSPIN_BINARY_DIR) + "/bookspin").c_str(), const_cast<char* const*>(arguments.data()));
  _exit(127);
}

int exit_code_of(pid_t child) {
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

// Until it holds; not for a child that ended without.
template <class Holds>
void wait_until(const Holds& holds, pid_t child) {
  while (!holds()) {
    siginfo_t ended{};
    ASSERT_EQ(waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOHANG | WNOWAIT), 0);
    ASSERT_EQ(ended.si_pid, 0) << "the program ended before";
    usleep(10000);
  }
}

void wait_for_a_file_in(const fs::path& folder, pid_t child) {
  std::error_code not_yet;
  wait_until([&] { return fs::directory_iterator(folder, not_yet) != fs::directory_iterator(); }, child);
}

// Not before it is the program: until then it has what this process has.
bool has_open(pid_t child, const fs::path& file) {
  const fs::path process = "/proc/" + std::to_string(child);
  std::error_code gone;
  if (fs::read_symlink(process / "exe", gone) == fs::read_symlink("/proc/self/exe")) return false;
  for (const auto& descriptor : fs::directory_iterator(process / "fd", gone)) {
    if (fs::read_symlink(descriptor, gone) == file) return true;
  }
  return false;
}

struct Interruption {
  const char* name;
  int signal;
  const char* set;
};

using Interrupts = Cli;

class Interrupted : public testing::TestWithParam<Interruption> {};

// The films, and the simulation of one, would last for minutes.
TEST_P(Interrupted, LeavesNothingHalfMadeAndSaysBySignal) {
  const Scratch scratch;
  write_text(scratch / "mine.toml", good_script);
  const pid_t child = start(
      scratch.folder(),
      {"render", "mine.toml", "-o", "films", "--size", "64x36", "--set", "clip.frames=100000", "--set", GetParam().set},
      "error");
  wait_for_a_file_in(scratch / "films", child);
  kill(child, GetParam().signal);
  EXPECT_EQ(exit_code_of(child), 128 + GetParam().signal);
  const std::string error = read_text(scratch / "error");
  EXPECT_THAT(error, ContainsRegex("^bookspin: mine.toml: 100000 frames of 64x36, 1666.7 s long; [0-9]+ steps; about "
                                   "[0-9]+ min to make\nbookspin: stopped\n$"));
  EXPECT_TRUE(fs::is_empty(scratch / "films"));
}

INSTANTIATE_TEST_SUITE_P(Cli, Interrupted,
                         testing::Values(Interruption{"filming_by_ctrl_c", SIGINT, "clip.substeps=1"},
                                         Interruption{"filming_by_kill", SIGTERM, "clip.substeps=1"},
                                         Interruption{"filming_by_hangup", SIGHUP, "clip.substeps=1"},
                                         Interruption{"simulating_by_ctrl_c", SIGINT, "clip.substeps=100000"}),
                         [](const auto& param_info) { return param_info.param.name; });

TEST_F(Interrupts, CheckAndTrajectoryCanBeStopped) {
  for (const char* command : {"check", "trajectory"}) {
    ASSERT_EQ(mkfifo((scratch / "script").c_str(), 0600), 0);
    const pid_t child = start(scratch.folder(), {command, "script", "--set", "clip.substeps=1000000"});
    write_text(scratch / "script", good_script);  // from now on the command listens, or will before it simulates
    kill(child, SIGTERM);
    EXPECT_EQ(exit_code_of(child), 128 + SIGTERM) << command;
    fs::remove(scratch / "script");
  }
}

// A picture of 16 million pixels takes Mesa and libpng a while each, and neither looks for signals.
TEST(Stoppable, ACommandThatDoesNotLookIsEndedAndLeavesNothing) {
  const Scratch scratch;
  std::array<int, 2> pipe{};
  ASSERT_EQ(::pipe(pipe.data()), 0);
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, SIG_DFL);
    _exit(stoppable([&](const std::stop_token&) -> int {
      const Part part(scratch / "picture");
      if (write(pipe[1], "!", 1) != 1) return 1;
      for (;;) pause();
    }));
  }
  close(pipe[1]);
  char ready = 0;
  EXPECT_EQ(read(pipe[0], &ready, 1), 1);
  close(pipe[0]);
  kill(child, SIGINT);
  EXPECT_EQ(exit_code_of(child), 128 + SIGINT);
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

// A script that nobody writes, an output that nobody reads.
TEST_F(Interrupts, WhoWaitsForAPipeCanBeStopped) {
  const std::string pipe = (scratch / "pipe").string();
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  for (const auto& [command, signal] : {std::pair("check", SIGTERM), std::pair("render", SIGINT)}) {
    const pid_t child = start(scratch.folder(), {command, "pipe"});
    int writer = -1;
    while (writer < 0) writer = open(pipe.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);  // not before the child reads
    kill(child, signal);
    EXPECT_EQ(exit_code_of(child), 128 + signal) << command;
    close(writer);
  }
  const int reader = open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  const pid_t child =
      start(scratch.folder(), {"trajectory", "mine.toml", "--set", "clip.frames=5000"}, "/dev/null", pipe.c_str());
  char first = 0;
  EXPECT_EQ(read(reader, &first, 1), 1);
  kill(child, SIGHUP);
  EXPECT_EQ(exit_code_of(child), 128 + SIGHUP);
  close(reader);
}

TEST_F(Interrupts, WhoWaitsForAFolderCanBeStopped) {
  fs::create_directory(scratch / "locked");
  const int folder = open((scratch / "locked").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  const pid_t child = start(scratch.folder(), {"trajectory", "mine.toml", "-o", "locked/a.csv"}, "error");
  wait_until([&] { return has_open(child, scratch / "locked"); }, child);
  kill(child, SIGTERM);
  EXPECT_EQ(exit_code_of(child), 128 + SIGTERM);
  EXPECT_THAT(read_text(scratch / "error"), HasSubstr("stopped while another program had locked it"));
  EXPECT_TRUE(fs::is_empty(scratch / "locked"));
  close(folder);
}

// The terminal goes away; whoever ignores the hangup, as nohup does, has the film made to its end.
TEST_F(Interrupts, AProgressLineThatCannotBeWrittenIsDropped) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_GE(terminal, 0);
  ASSERT_EQ(grantpt(terminal) + unlockpt(terminal), 0);
  const pid_t child =
      start(scratch.folder(), {"render", "mine.toml", "-o", "films", "--size", "64x36", "--set", "clip.frames=300"},
            ptsname(terminal), "/dev/null", SIG_IGN);
  wait_for_a_file_in(scratch / "films", child);
  close(terminal);
  EXPECT_EQ(exit_code_of(child), 0);
  EXPECT_EQ(read_mp4_info(scratch / "films/mine.mp4").frames, 300);
}

}  // namespace
}  // namespace bookspin
