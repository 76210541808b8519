// The program with little memory: a message that says what to do, never a signal.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"

namespace bookspin {
namespace {

using testing::AnyOf;
using testing::HasSubstr;

constexpr const char* script =
    "title = 'T'\n[clip]\nframes = 4\nsubsteps = 1\n[[book]]\nmethod = 'exact'\nangular_velocity = [1, 0, 0]\n";

struct Memory : testing::Test {
  Memory() { write_text(scratch / "t.toml", script); }
  // `megabytes` of address space.
  Said limited(int megabytes, const std::string& arguments) {
    return run(scratch, "(ulimit -v " + std::to_string(1000 * megabytes) + " && " BOOKSPIN_BINARY_DIR "/bookspin " +
                            arguments + ")");
  }
  // The least, in steps of 10, with which a small scene can be checked: before that the system cannot load the program.
  int least() {
    int megabytes = 50;
    while (megabytes < 2000 && limited(megabytes, "check t.toml").exit_code != 0) megabytes += 10;
    return megabytes;
  }
  Scratch scratch;
};

TEST_F(Memory, TooLittleToDrawIsSaidBefore) {
  const int start = least();
  ASSERT_LT(start, 600);
  for (int megabytes = start; megabytes < 600; megabytes += 50) {
    const Said said = limited(megabytes, "render t.toml -o films --size 64x36");
    EXPECT_EQ(said.exit_code, 1) << megabytes << said.err;
    EXPECT_THAT(said.err, AnyOf(HasSubstr("memory is limited to"), HasSubstr("cannot start a thread")));
    EXPECT_FALSE(std::filesystem::exists(scratch / "films"));
  }
  EXPECT_THAT(limited(700, "frame t.toml --frame 0 -o a.png --size 4096x4096").err,
              HasSubstr("pictures of 4096x4096 need 27"));
}

TEST_F(Memory, TooLittleForATrajectoryEndsInAMessage) {
  const Said said = limited(least() + 20,
                            "check t.toml --set clip.frames=100000 --set \"book=[{method='exact'},{method='exact'},"
                            "{method='exact'}]\"");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.err, HasSubstr("out of memory: end other programs"));
}

}  // namespace
}  // namespace bookspin
