// The program as a user meets it: good and bad calls, exit codes, what is written where.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "cli/command.h"
#include "image/png.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

const std::string bookspin = std::string(BOOKSPIN_BINARY_DIR) + "/bookspin ";
const std::string videos = std::string(BOOKSPIN_SOURCE_DIR) + "/videos/";

constexpr const char* good_script = R"(title = "Mine"
[clip]
frames = 12
[[book]]
method = "springs"
angular_velocity = [0.115, 0, 0]
jiggle = 0.01
[[expect]]
says = "it keeps its shape"
quantity = "stretch"
at_most = 0.01
)";

struct Cli : testing::Test {
  Cli() { write_text(scratch / "mine.toml", good_script); }
  Said operator()(const std::string& arguments) { return run(scratch, bookspin + arguments); }
  Scratch scratch;
};

TEST_F(Cli, HelpOfEveryCommandHasAnExample) {
  EXPECT_EQ((*this)("--help").exit_code, 0);
  for (const char* command : {"list", "render", "frame", "check", "trajectory"}) {
    const Said said = (*this)(std::string(command) + " --help");
    EXPECT_EQ(said.exit_code, 0);
    EXPECT_THAT(said.out, HasSubstr("Example")) << command;
    EXPECT_THAT(said.out, HasSubstr(std::string("  bookspin ") + command)) << command;
    EXPECT_THAT(said.out, HasSubstr("--set")) << command;
  }
}

TEST_F(Cli, PageHasAnExampleToo) {
  EXPECT_THAT((*this)("page --help").out, HasSubstr("  bookspin page videos/site"));
}

TEST_F(Cli, ListsTheFiguresOfTheProjectAndOfAFolder) {
  EXPECT_THAT((*this)("list").out, HasSubstr("fig05_unstable_x.toml"));
  const Said said = (*this)("list .");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out, ContainsRegex("mine.toml +0.2 s  Mine"));
  EXPECT_EQ((*this)("list nowhere").exit_code, 1);
}

TEST_F(Cli, RendersAFilmSilentlyWhenPiped) {
  const Said said = (*this)("render mine.toml -o films --size 160x90");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.err, IsEmpty());
  EXPECT_THAT(said.out, ContainsRegex("mine.mp4 +12 frames +0.20 s +[0-9]+ kB +1 of 1 expectations met"));
  EXPECT_THAT(said.out, ContainsRegex("1 of 1 made in films, 12 frames in [0-9.]+ s"));
  EXPECT_EQ(read_mp4_info(scratch / "films/mine.mp4").frames, 12);
}

TEST_F(Cli, RendersTheFramesAskedFor) {
  EXPECT_EQ((*this)("render mine.toml -o . --size 64x36 --frames 3:8").exit_code, 0);
  EXPECT_EQ(read_mp4_info(scratch / "mine.mp4").frames, 5);
  EXPECT_EQ((*this)("render mine.toml -o . --size 64x36 --frames 10:").exit_code, 0);
  EXPECT_EQ(read_mp4_info(scratch / "mine.mp4").frames, 2);
}

TEST_F(Cli, UpdateMakesOnlyWhatIsStale) {
  const std::string command = "render mine.toml -o . --size 64x36 --update";
  EXPECT_THAT((*this)(command).out, HasSubstr("1 of 1 made"));
  EXPECT_THAT((*this)(command).out, HasSubstr("1 films up to date"));
  EXPECT_THAT((*this)(command + " --set seed=9").out, HasSubstr("1 of 1 made"));
}

TEST_F(Cli, AnUnmetExpectationIsShownAndTheExitCodeIsOne) {
  for (const char* command : {"check mine.toml", "render mine.toml -o . --size 64x36"}) {
    const Said said = (*this)(std::string(command) + " --set expect.0.at_most=0");
    EXPECT_EQ(said.exit_code, 1);
    EXPECT_THAT(said.out, HasSubstr("NOT MET: it keeps its shape")) << command;
    EXPECT_THAT(said.out, ContainsRegex("stretch at most 0 in frames 0 to 11: found [0-9.e-]+ in frame")) << command;
  }
  EXPECT_EQ((*this)("check mine.toml").exit_code, 0);
}

TEST_F(Cli, DrawsOneFrame) {
  EXPECT_EQ((*this)("frame mine.toml --frame 11 -o eleven.png --size 64x36").exit_code, 0);
  EXPECT_EQ(read_png(scratch / "eleven.png").height, 36);
}

TEST_F(Cli, WritesTheTrajectoryAsCsv) {
  const Said said = (*this)("trajectory mine.toml");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out, StartsWith("frame,t,book,c0x,c0y,c0z,"));
  EXPECT_EQ(std::count(said.out.begin(), said.out.end(), '\n'), 13);
  EXPECT_EQ((*this)("trajectory mine.toml -o motion.csv").exit_code, 0);
  EXPECT_EQ(read_text(scratch / "motion.csv"), said.out);
}

TEST_F(Cli, TheMethodsStartAlikeAndPartSlowly) {
  const auto row = [this](const std::string& set) {
    const std::string csv = (*this)("trajectory mine.toml --set book.0.method=" + set).out;
    return csv.substr(csv.find("\n0,") + 1, csv.find("\n1,") - csv.find("\n0,"));
  };
  const std::string matrix = row("matrix");
  EXPECT_EQ(matrix, row("quaternion"));
  EXPECT_NE((*this)("trajectory mine.toml --set book.0.method=matrix").out,
            (*this)("trajectory mine.toml --set book.0.method=quaternion").out);
}

struct BadCall {
  const char* name;
  const char* arguments;
  int exit_code;
  const char* says;
};

class BadCalls : public testing::TestWithParam<BadCall> {};

TEST_P(BadCalls, SayWhatIsWrongAndMakeNothing) {
  const Scratch scratch;
  write_text(scratch / "mine.toml", good_script);
  write_text(scratch / "bad.toml", "title = \"Bad\"\n[[book]]\nstiffness = -3\n");
  const Said said = run(scratch, bookspin + GetParam().arguments);
  EXPECT_EQ(said.exit_code, GetParam().exit_code);
  EXPECT_THAT(said.err, HasSubstr(GetParam().says));
  for (const auto& entry : fs::recursive_directory_iterator(scratch.folder())) {
    const std::string extension = entry.path().extension().string();
    EXPECT_TRUE(extension == ".toml" || entry.path().filename().string().starts_with(".")) << entry.path();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Cli, BadCalls,
    testing::Values(
        BadCall{"nothing", "", 2, "A subcommand is required"},
        BadCall{"unknown_command", "film mine.toml", 2, "subcommand is required"},
        BadCall{"unknown_option", "check mine.toml --fast", 2, "--fast"}, BadCall{"no_scene", "render", 2, "SCENE"},
        BadCall{"missing_file", "render nowhere.toml -o .", 1, "nowhere.toml: cannot be read"},
        BadCall{"bad_value", "render bad.toml -o .", 1,
                "bad.toml:3:13: book.0.stiffness: found -3; allowed: a number more than 0"},
        BadCall{"bad_among_good", "render mine.toml bad.toml -o .", 1, "bad.toml:3:13"},
        BadCall{"bad_override", "check mine.toml --set book.0.method=magic", 1,
                "--set book.0.method=magic: book.0.method: found 'magic'; allowed: one of \"springs\""},
        BadCall{"override_of_no_book", "check mine.toml --set book.4.jiggle=0", 1,
                "--set book.4.jiggle=0: there is no '4' in a list of 1"},
        BadCall{"override_without_value", "check mine.toml --set seed", 1, "allowed: KEY=VALUE"},
        BadCall{"odd_size", "render mine.toml -o . --size 161x90", 1,
                "--size: found '161x90'; allowed: WxH, both even"},
        BadCall{"size_in_words", "render mine.toml -o . --size big", 1, "--size: found 'big'"},
        BadCall{"size_too_large", "frame mine.toml --frame 0 -o a.png --size 9000x9000", 1, "from 16 to 4096"},
        BadCall{"frames_reversed", "render mine.toml -o . --frames 8:3", 1, "--frames: found '8:3'; allowed: A:B"},
        BadCall{"frames_beyond", "render mine.toml -o . --frames 0:13", 1,
                "found frames 0:13; allowed: A:B with 0 <= A < B <= 12"},
        BadCall{"frame_beyond", "frame mine.toml --frame 12 -o a.png", 1, "--frame: found '12'; allowed: 0 to 11"},
        BadCall{"unwritable", "render mine.toml -o /proc/nowhere --size 64x36", 1, "/proc/nowhere"},
        BadCall{"trajectory_nowhere", "trajectory mine.toml -o nowhere/a.csv", 1, "nowhere/a.csv: cannot be opened"},
        BadCall{"page_without_films", "page .", 1, ".: holds no films; `bookspin render SCENE.toml -o .`"},
        BadCall{"twice", "render mine.toml ./mine.toml -o .", 1, "would make the same film"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST_F(Cli, AFullDiskIsAnError) {
  const Said said = run(scratch, "(" + bookspin + "trajectory mine.toml >/dev/full)");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.err, HasSubstr("standard output: cannot be written: No space left on device"));
}

// Ctrl-C in the middle of a long film.
TEST_F(Cli, AnInterruptLeavesNothingHalfMade) {
  const Said said = run(scratch, "timeout -s INT 2 " + bookspin +
                                     "render mine.toml -o films --set clip.frames=100000 --set clip.substeps=1");
  EXPECT_NE(said.exit_code, 0);
  EXPECT_THAT(said.err, HasSubstr("bookspin: stopped"));
  EXPECT_TRUE(fs::is_empty(scratch / "films"));
}

}  // namespace
}  // namespace bookspin
