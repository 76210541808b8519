// The program as a user meets it: good and bad calls, exit codes, what is written where.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <sstream>

#include "cli/my_script.h"
#include "image/png.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST_F(Cli, HelpOfEveryCommandHasAnExample) {
  EXPECT_EQ((*this)("--help").exit_code, 0);
  for (const char* command : {"list", "render", "frame", "check", "trajectory", "page", "verify", "report", "advise",
                              "compare", "doctor", "help", "schema", "completion"}) {
    const Said said = (*this)(std::string(command) + " --help");
    EXPECT_EQ(said.exit_code, 0);
    EXPECT_THAT(said.out, HasSubstr("Example")) << command;
    EXPECT_THAT(said.out, HasSubstr(std::string("  bookspin ") + command)) << command;
    EXPECT_EQ((*this)(std::string("help ") + command).out, said.out);
  }
  EXPECT_EQ((*this)("help").out, (*this)("--help").out);
  EXPECT_EQ((*this)("help scene").out, read_text(videos + "README.md"));
  EXPECT_THAT((*this)("schema").out, StartsWith("{\n  \"$schema\": "));
  EXPECT_THAT((*this)("render --help").out, ContainsRegex("--size WxH.*1280x720"));
}

TEST_F(Cli, SaysWhatItIsMadeOf) {
  const Said said = (*this)("--version");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out, ContainsRegex("^bookspin [0-9.]+"));
  for (const char* library : {"libavcodec", "libpng", "FreeType", "Eigen", "fmt", "toml\\+\\+"}) {
    EXPECT_THAT(said.out, ContainsRegex(std::string(library) + " [0-9]+\\.[0-9]+\\.[0-9]+"));
  }
}

TEST_F(Cli, AdviceKeepsItsPromise) {
  const Said said = (*this)("advise mine.toml --error 1e-9");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out,
              StartsWith("mine.toml: angle_error at most 1e-09 rad in each of 12 frames\n\nbook 0, springs by "
                         "explicit_euler, 6 steps a frame: "));
  EXPECT_THAT(said.out, HasSubstr("no step takes away what the model adds"));
  EXPECT_THAT(said.out, HasSubstr("in [[book]], without integrator:\n  method = \"exact\"\n"));
  EXPECT_THAT(said.out, ContainsRegex("integrator = \"[a-z0-9]+\"\nand in .clip., for all its books:\n  substeps = "));
  int tried = 0;
  std::istringstream lines(said.out);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("  bookspin ")) continue;
    const Said check = (*this)(line.substr(11));
    EXPECT_EQ(check.exit_code, 0) << line << check.out << check.err;
    EXPECT_THAT(check.out, HasSubstr("1 of 1 expectations met")) << line;
    ++tried;
  }
  EXPECT_EQ(tried, 2);
}

TEST_F(Cli, ListsTheFiguresOfTheProjectAndOfAFolder) {
  EXPECT_THAT((*this)("list").out, HasSubstr("fig05_unstable_x.toml"));
  const Said said = (*this)("list .");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out, ContainsRegex("mine.toml +0.2 s  Mine"));
  EXPECT_EQ((*this)("list nowhere").exit_code, 1);
}

TEST_F(Cli, CommandsNoTerminalByNamesAndTitles) {
  const fs::path folder = scratch / "hostile";
  fs::create_directory(folder);
  write_text(folder / "a\x1b]0;b.toml", "title = \"c\\u001b[2Jd\\u009be\"\n[[book]]\nangular_velocity = [1, 0, 0]\n");
  write_text(folder / "f\x1b[g.toml", "?");
  const Said said = (*this)("list hostile");
  EXPECT_THAT(said.out, ContainsRegex("^a\\?\\]0;b.toml +[0-9.]+ s  c\\?\\[2Jd\\?e\n$"));
  EXPECT_THAT(said.err, HasSubstr("f?[g.toml:1:"));
}

TEST_F(Cli, WarnsOnceOfWhatTheFontLacks) {
  write_text(
      scratch / "box.toml",
      "title = \"字 is a box, 字\"\n[clip]\nframes = 2\n[[book]]\nname = \"漢\"\nangular_velocity = [1, 0, 0]\n");
  for (const char* command : {"check box.toml", "render box.toml -o films --size 64x36"}) {
    const Said said = (*this)(command);
    EXPECT_EQ(said.exit_code, 0) << said.err;
    EXPECT_EQ(said.err,
              "bookspin: box.toml: title: '字': not in the font, drawn as a box\n"
              "bookspin: box.toml: book.0.name: '漢': not in the font, drawn as a box\n");
  }
}

TEST_F(Cli, ABadScriptDoesNotStopTheOthers) {
  write_text(scratch / "bad.toml", "title = 3\n");
  write_text(scratch / "other.toml", good_script);
  for (const char* command : {"list .", "check mine.toml bad.toml other.toml",
                              "render mine.toml bad.toml other.toml -o films --size 64x36"}) {
    const Said said = (*this)(command);
    EXPECT_EQ(said.exit_code, 1) << command;
    EXPECT_THAT(said.err, HasSubstr("bad.toml:1:9: title: found 3")) << command;
    EXPECT_THAT(said.out, HasSubstr("mine")) << command;
    EXPECT_THAT(said.out, HasSubstr("other")) << command;
  }
  EXPECT_THAT((*this)("check mine.toml bad.toml other.toml").out,
              HasSubstr("3 scripts: 2 as expected, 0 not\nnot checked: bad.toml\n"));
  // Even when nobody hears it.
  EXPECT_THAT(run(scratch, "(" + bookspin + "check bad.toml other.toml 2>/dev/full)").out,
              HasSubstr("other.toml: 1 of 1"));
  const Said said = (*this)("render mine.toml bad.toml other.toml -o films --size 64x36 --update");
  EXPECT_THAT(said.out, HasSubstr("2 films up to date in films\nnot made: bad.toml\n"));
  EXPECT_EQ(said.exit_code, 1);
}

// The program's files: named by an option or the environment, or found beside a program that has been moved.
TEST_F(Cli, FindsItsFilesOrSaysWhereItLooked) {
  fs::create_directories(scratch / "bin");
  fs::create_directories(scratch / "share/bookspin/videos");
  fs::copy_file(std::string(BOOKSPIN_BINARY_DIR) + "/bookspin", scratch / "bin/bookspin");
  fs::copy_file(scratch / "mine.toml", scratch / "share/bookspin/videos/moved.toml");
  const auto list = [this](const std::string& before, const std::string& after) {
    return run(scratch, before + " bin/bookspin list " + after);
  };
  EXPECT_THAT(list("", "").out,
              HasSubstr("fig05_unstable_x.toml"));  // those are no files of its own: parts are missing
  for (const char* part : {"shaders", "textures", "data"}) {
    fs::create_directory_symlink(fs::path(BOOKSPIN_SOURCE_DIR) / part,
                                 scratch / ("share/bookspin/" + std::string(part)));
  }
  EXPECT_THAT(list("", "").out, StartsWith("moved.toml"));
  EXPECT_THAT(list("BOOKSPIN_ASSETS=" BOOKSPIN_SOURCE_DIR, "").out, HasSubstr("fig05_unstable_x.toml"));
  EXPECT_THAT(list("BOOKSPIN_ASSETS=nowhere", "--assets " BOOKSPIN_SOURCE_DIR).out, HasSubstr("fig05_unstable_x.toml"));
  for (const Said& said : {list("BOOKSPIN_ASSETS=nowhere", ""), list("", "--assets nowhere")}) {
    EXPECT_EQ(said.exit_code, 1);
    EXPECT_THAT(said.err, HasSubstr("shaders, textures, videos, data) are not in\n  nowhere\n"));
  }
  fs::create_directory_symlink(fs::path(BOOKSPIN_SOURCE_DIR) / "videos/page", scratch / "share/bookspin/videos/page");
  EXPECT_EQ(run(scratch, "bin/bookspin render mine.toml --size 64x36").exit_code, 0);
  EXPECT_THAT(run(scratch, "bin/bookspin page").out, StartsWith("site/index.html: 1 film, "));
  EXPECT_TRUE(fs::exists(scratch / "site/mine.mp4"));  // in the folder that one is in, not in somebody's checkout
}

TEST_F(Cli, MakesThePageOfAStrangersFilms) {
  EXPECT_EQ((*this)("render mine.toml -o films --size 64x36").exit_code, 0);
  const Said said = (*this)("page films");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out, ContainsRegex("films/index.html: 1 film, [0-9]+ kB"));
  EXPECT_THAT(read_text(scratch / "films/index.html"), HasSubstr("<article class=\"film\" id=\"mine\""));
}

// As an older version leaves one.
TEST_F(Cli, TakesOverAFolderWithoutAList) {
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ((*this)("render mine.toml -o films --size 64x36").exit_code, 0);
    EXPECT_EQ((*this)("page films").exit_code, 0);
    EXPECT_EQ((*this)("verify films").exit_code, 0);
    fs::remove(scratch / "films/bookspin.sha256");
  }
  write_text(scratch / "films/mine.png", "a user's picture");
  write_text(scratch / "films/mine.json", "a user's list");
  const Said said = (*this)("render mine.toml -o films --size 64x36");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.err, HasSubstr("mine.png: cannot be replaced: is no file of bookspin's"));
  EXPECT_EQ(read_text(scratch / "films/mine.png"), "a user's picture");
}

TEST_F(Cli, ComparesPictures) {
  Image picture(32, 16);
  for (std::uint8_t& level : picture.rgba) level = 255;
  write_png(scratch / "a.png", picture);
  std::fill_n(picture.pixel(5, 7), 3, std::uint8_t{235});
  write_png(scratch / "b.png", picture);
  write_png(scratch / "small.png", Image(16, 16));

  EXPECT_EQ((*this)("compare a.png a.png").exit_code, 0);
  const Said said = (*this)("compare a.png b.png --delta delta.png --threshold 8");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.out, StartsWith("max delta 20, mean 0.03906, 0.1953 % of pixels off by more than 8 levels\n"));
  EXPECT_THAT(said.out, HasSubstr("     5     7     20  255 255 255 255   235 235 235 255\n"));
  EXPECT_EQ(read_png(scratch / "delta.png").width, 32);
  for (const char* within : {"--max-delta 20", "--mean-delta 0.04", "--share 0.002", "--share 0 --threshold 20"}) {
    EXPECT_EQ((*this)(std::string("compare a.png b.png ") + within).exit_code, 0) << within;
  }
  for (const char* beyond : {"--max-delta 19", "--mean-delta 0.03", "--share 0.001", "--share 0 --threshold 19"}) {
    EXPECT_EQ((*this)(std::string("compare a.png b.png ") + beyond).exit_code, 1) << beyond;
  }
  EXPECT_THAT((*this)("compare a.png small.png --max-delta 255").out, HasSubstr("a.png is 32x16, small.png is 16x16"));
  EXPECT_EQ((*this)("compare a.png small.png --max-delta 255").exit_code, 1);
}

TEST_F(Cli, AStillHasNoRate) {
  const Said said = (*this)("render mine.toml -o . --size 64x36 --set clip.frames=1");
  EXPECT_THAT(said.out, ContainsRegex("mine.png +still +[0-9]+ kB +1 of 1"));
  EXPECT_THAT(said.out, ContainsRegex("1 of 1 made in ., [01] frames? in [0-9.]+ s\n"));
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

TEST_F(Cli, RendersOtherFormatsAndPagesOfThem) {
  for (const auto& [format, codec, shown] :
       {std::array{"webm", "vp9", "src=\"mine.webm\""}, std::array{"gif", "gif", "<img src=\"mine.gif\""}}) {
    const std::string folder = format;
    EXPECT_EQ((*this)("render mine.toml --size 64x36 --format " + folder + " -o " + folder).exit_code, 0);
    EXPECT_EQ(read_mp4_info(scratch / folder / ("mine." + folder)).codec, codec);
    EXPECT_EQ((*this)("page " + folder).exit_code, 0);
    EXPECT_THAT(read_text(scratch / folder / "index.html"), HasSubstr(shown));
    EXPECT_EQ((*this)("verify " + folder).exit_code, 0);
  }
}

TEST_F(Cli, UpdateMakesOnlyWhatIsStale) {
  const std::string command = "render mine.toml -o . --size 64x36 --update";
  EXPECT_THAT((*this)(command).out, HasSubstr("1 of 1 made"));
  EXPECT_THAT((*this)(command).out, HasSubstr("1 film up to date"));
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
    const std::string first = csv.substr(csv.find("\n0,") + 1, csv.find("\n1,") - csv.find("\n0,"));
    std::size_t end = 0;
    for (int column = 0; column < 41; ++column) end = first.find(',', end) + 1;
    return first.substr(0, end);  // the motion; not every quantity after it is one of every method
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
        BadCall{"unknown_command", "film mine.toml", 2,
                "unknown command 'film'; allowed: list, render, frame, check, trajectory, json, page, verify, report, "
                "advise, "
                "compare, doctor, help, schema, completion\n"},
        BadCall{"error_too_small", "advise mine.toml --error 0", 2,
                "--error: found '0'; allowed: a number from 1e-14 to 1"},
        BadCall{"advice_of_no_scene", "advise", 2, "SCENE"},
        BadCall{"nearly_a_command", "rendr mine.toml", 2, "unknown command 'rendr'; did you mean render?\n"},
        BadCall{"nearly_a_topic", "help scenes", 2, "help: found 'scenes'; did you mean scene?\n"},
        BadCall{"unknown_option", "check mine.toml --fast", 2, "unknown option '--fast'; allowed: --help, --set\n"},
        BadCall{"nearly_an_option", "render --siz=64x36", 2, "unknown option '--siz'; did you mean --size?\n"},
        BadCall{"one_word_too_many", "list . there", 2, "found 'there', which is one word too many"},
        BadCall{"no_scene", "render", 2, "SCENE"}, BadCall{"empty_scene", "check ''", 2, "SCENE: is empty"},
        BadCall{"empty_output", "render mine.toml -o ''", 2, "--output: is empty"},
        BadCall{"empty_folder", "page ''", 2, "DIR: is empty"},
        BadCall{"empty_assets", "list --assets ''", 2, "--assets: is empty"},
        BadCall{"missing_file", "render nowhere.toml -o .", 1, "nowhere.toml: cannot be read"},
        BadCall{"bad_value", "render bad.toml -o .", 1,
                "bad.toml:3:13: book.0.stiffness: found -3; allowed: a number more than 0"},
        BadCall{"bad_override", "check mine.toml --set book.0.method=magic", 1,
                "--set book.0.method=magic: book.0.method: found 'magic'; allowed: one of \"springs\""},
        BadCall{"hours", "check mine.toml --set clip.substeps=1000000 --set clip.frames=10002", 1,
                "clip.substeps: found 10002 frames of 1000000 steps, 10001000000 steps for all books; allowed: up to "
                "10000000000 steps"},
        BadCall{"override_of_no_book", "check mine.toml --set book.4.jiggle=0", 1,
                "--set book.4.jiggle=0: there is no '4' in a list of 1"},
        BadCall{"override_without_value", "check mine.toml --set seed", 2, "--set: found 'seed'; allowed: KEY=VALUE"},
        BadCall{"odd_size", "render mine.toml -o . --size 161x90", 2,
                "--size: found '161x90'; allowed: WxH, both even"},
        BadCall{"size_in_words", "render mine.toml -o . --size big", 2, "--size: found 'big'"},
        BadCall{"size_of_one_number", "render mine.toml -o . --size 64x", 2, "--size: found '64x'"},
        BadCall{"size_too_large", "frame mine.toml --frame 0 -o a.png --size 9000x9000", 2, "from 16 to 4096"},
        BadCall{"format_unknown", "render mine.toml -o . --format avi", 2,
                "--format: found 'avi'; allowed: mp4, webm, gif"},
        BadCall{"frames_reversed", "render mine.toml -o . --frames 8:3", 2, "--frames: found '8:3'; allowed: A:B"},
        BadCall{"frames_beyond", "render mine.toml -o . --frames 0:13", 1,
                "mine.toml: found frames 0:13; allowed: A:B with 0 <= A < B <= 12"},
        BadCall{"frame_beyond", "frame mine.toml --frame 12 -o a.png", 1,
                "mine.toml: found frame 12; allowed: 0 to 11"},
        BadCall{"frame_in_words", "frame mine.toml --frame abc -o a.png", 2,
                "--frame: found 'abc'; allowed: a whole number from 0"},
        BadCall{"frame_as_jpeg", "frame mine.toml --frame 1 -o a.jpg", 2,
                "--output: found 'a.jpg'; allowed: a name that ends in .png"},
        BadCall{"no_jobs", "render mine.toml --jobs ''", 2, "--jobs: found ''; allowed: a whole number from 1 to 256"},
        BadCall{"unwritable", "render mine.toml -o /proc/nowhere --size 64x36", 1, "/proc/nowhere"},
        BadCall{"trajectory_nowhere", "trajectory mine.toml -o nowhere/a.csv", 1, "nowhere/a.csv: cannot be opened"},
        BadCall{"page_without_films", "page .", 1, ".: holds no films; `bookspin render SCENE.toml -o .`"},
        BadCall{"no_picture", "compare a.png b.png", 2, "a.png"},
        BadCall{"not_a_picture", "compare mine.toml mine.toml", 2, "mine.toml: read PNG: "},
        BadCall{"bound_out_of_range", "compare mine.toml mine.toml --max-delta 256", 2,
                "--max-delta: found '256'; allowed: a whole number from 0 to 255"},
        BadCall{"twice", "render mine.toml ./mine.toml -o .", 2, "would make the same film"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST_F(Cli, OutputThatNobodyCanReadIsAnError) {
  for (const char* command :
       {"--help", "--version", "list", "check mine.toml", "trajectory mine.toml",
        "render mine.toml -o films --size 64x36", "page films", "compare films/mine.png films/mine.png"}) {
    const Said full = run(scratch, "(" + bookspin + command + " >/dev/full)");
    EXPECT_EQ(full.exit_code, 1) << command;
    EXPECT_THAT(full.err, HasSubstr("standard output: cannot be written: No space left on device")) << command;
    const Said closed = run(scratch, "(" + bookspin + command + " >&-)");
    EXPECT_EQ(closed.exit_code, 1) << command;
    EXPECT_THAT(closed.err, HasSubstr("standard output: cannot be written: Bad file descriptor")) << command;
  }
  EXPECT_EQ(read_mp4_info(scratch / "films/mine.mp4").frames, 12);  // nothing was printed into a film
}

TEST_F(Cli, NeverWritesOverTheScript) {
  for (const char* name : {"mine.json", "mine.png", "mine.csv"}) fs::copy_file(scratch / "mine.toml", scratch / name);
  for (const char* command : {"trajectory mine.csv -o mine.csv", "frame mine.png --frame 0 -o ./mine.png",
                              "render mine.json -o . --size 64x36"}) {
    const Said said = (*this)(command);
    EXPECT_NE(said.exit_code, 0) << command;
    EXPECT_THAT(said.err, HasSubstr("script")) << command;
    for (const char* name : {"mine.json", "mine.png", "mine.csv"}) EXPECT_EQ(read_text(scratch / name), good_script);
  }
}

}  // namespace
}  // namespace bookspin
