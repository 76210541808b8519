// What README.md promises a newcomer, run word for word: the lines of a section that are indented as commands.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "cli/command.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string commands_below(const std::string& heading) {
  std::istringstream readme(read_text(BOOKSPIN_SOURCE_DIR "/README.md"));
  std::string commands;
  bool below = false;
  for (std::string line; std::getline(readme, line);) {
    if (line.starts_with("## ")) below = line == "## " + heading;
    if (below && line.starts_with("    ")) commands += line.substr(4) + "\n";
    if (below && line.empty()) commands += "\n";
  }
  return commands;
}

TEST(Readme, AFilmAndAPageOfOnesOwn) {
  const Scratch scratch;
  write_text(scratch / "commands", commands_below("Your own film in five minutes"));
  const std::string path = "PATH=" BOOKSPIN_BINARY_DIR ":$PATH ";
  const Said said = run(scratch, path + "sh -e commands");
  EXPECT_EQ(said.exit_code, 0) << said.out << said.err;
  for (const char* product : {"site/mine.mp4", "site/mine.png", "site/mine.json", "site/index.html"}) {
    EXPECT_TRUE(fs::exists(scratch / product)) << product;
  }
  EXPECT_THAT(read_text(scratch / "site/index.html"), HasSubstr("My book, thrown badly"));

  const Said about_y = run(scratch, path + "bookspin check mine.toml --set 'book.0.angular_velocity=[0, 0.3, 0]'");
  EXPECT_EQ(about_y.exit_code, 1) << "README says that the claim then fails: " << about_y.out;
}

}  // namespace
}  // namespace bookspin
