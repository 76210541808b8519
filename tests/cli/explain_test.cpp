// What is printed of the table of commands: the manual page, and the completions of the shells.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"

namespace bookspin {
namespace {

using testing::HasSubstr;

const std::string bookspin = BOOKSPIN_BINARY_DIR "/bookspin ";

TEST(Explain, TheManualPageHasCommandsOptionsAndExitCodes) {
  const std::string page = run(Scratch(), bookspin + "help man").out;
  EXPECT_THAT(page, testing::StartsWith(".TH BOOKSPIN 1 "));
  EXPECT_THAT(page, HasSubstr("\n.SS render\nMake films"));
  EXPECT_THAT(page, HasSubstr("\n.TP\n.B \\-j, \\-\\-jobs N\nProcesses that film at the same time"));
  EXPECT_THAT(page, HasSubstr("\n.SH EXIT STATUS\n"));
}

TEST(Explain, BashCompletesCommandsAndOptions) {
  const Scratch scratch;
  const auto completed = [&](const std::string& words, int at) {
    return run(scratch, "bash -c 'source <(" + bookspin + "completion bash); COMP_WORDS=(bookspin " + words +
                            "); COMP_CWORD=" + std::to_string(at) + "; _bookspin; echo ${COMPREPLY[@]}'")
        .out;
  };
  EXPECT_EQ(completed("re", 1), "render report\n");
  EXPECT_EQ(completed("render --s", 2), "--size --set\n");
  EXPECT_EQ(completed("render a.toml --up", 3), "--update\n");
  EXPECT_EQ(completed("render mine", 2), "\n");  // bash goes on with files
  EXPECT_EQ(completed("help sce", 2), "scene\n");
  EXPECT_EQ(completed("completion z", 2), "zsh\n");
}

TEST(Explain, ZshHasThemWithTheirHelp) {
  const Scratch scratch;
  const std::string script = run(scratch, bookspin + "completion zsh").out;
  EXPECT_THAT(script, testing::StartsWith("#compdef bookspin\n"));
  EXPECT_THAT(script, HasSubstr("'check:Simulate and judge every expectation, without drawing'"));
  EXPECT_THAT(script, HasSubstr("    report) known=( '--help:"));
  EXPECT_EQ(run(scratch, bookspin + "completion fish").exit_code, 2);
}

}  // namespace
}  // namespace bookspin
