// `bookspin doctor`, and what works on a machine that lacks nearly everything.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"

namespace bookspin {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::Not;

const std::string bookspin = BOOKSPIN_BINARY_DIR "/bookspin ";
const std::string hide = "LD_PRELOAD=" BOOKSPIN_BINARY_DIR "/tests/cli_hide.so HIDE=";

TEST(Doctor, SaysWhatIsThere) {
  const Said said = run(Scratch(), bookspin + "doctor");
  EXPECT_EQ(said.exit_code, 0) << said.out;
  EXPECT_THAT(said.out, ContainsRegex("^bookspin [0-9.]+"));
  EXPECT_THAT(said.out, ContainsRegex("\nhave +(OSMesa|EGL) +(OSMesa|EGL), .*, OpenGL [3-9]"));
  EXPECT_THAT(said.out, ContainsRegex("\nhave +encoder +libx264 by libavcodec [0-9]+"));
  EXPECT_THAT(said.out, ContainsRegex("\nhave +fonts +/.*Inter-Regular.otf /.*Inter-SemiBold.otf"));
  EXPECT_THAT(said.out, ContainsRegex("\nhave +own files +/"));
  EXPECT_THAT(said.out, HasSubstr("\nFilms can be made.\n"));
}

struct Lacking {
  const char* name;
  std::string environment;
  int exit_code;
  const char* says;
};

class Lacks : public testing::TestWithParam<Lacking> {};

TEST_P(Lacks, SaysWhatItMeansAndWhatToInstall) {
  const Said said = run(Scratch(), GetParam().environment + " " + bookspin + "doctor");
  EXPECT_EQ(said.exit_code, GetParam().exit_code) << said.out << said.err;
  EXPECT_THAT(said.out, ContainsRegex(GetParam().says));
  EXPECT_THAT(said.out, HasSubstr(said.exit_code == 0 ? "Films can be made" : "Films cannot be made"));
}

INSTANTIATE_TEST_SUITE_P(
    Doctor, Lacks,
    testing::Values(
        Lacking{
            "opengl", hide + "gl", 1,
            "MISSING +OSMesa +no off-screen.*\n.*hidden.so.*\n.*libosmesa6\nMISSING +EGL .*\n.*\n.*libgl1-mesa-dri\n"},
        Lacking{"encoder", hide + "x264", 1, "MISSING +encoder .*without libx264\n +no films, only frames"},
        Lacking{"font", hide + "font", 1, "MISSING +fonts .*Inter-Regular.otf: open font: .*\n.*fonts-inter\n"},
        Lacking{"files", "BOOKSPIN_ASSETS=/nowhere", 1, "MISSING +own files .*\n  /nowhere\n"},
        Lacking{"gnuplot", "PATH=/nowhere", 0, "MISSING +gnuplot .*\n.*gnuplot-nox\n"}),
    [](const auto& param_info) { return param_info.param.name; });

TEST(Doctor, WithoutGlEncoderFontAndGnuplotTheRestWorks) {
  const Scratch scratch;
  write_text(scratch / "mine.toml", "title = \"Mine\"\n[clip]\nframes = 3\n[[book]]\n");
  const std::string bare = "PATH=/nowhere " + hide + "'gl x264 font' " + bookspin;
  for (const char* call : {"--help", "--version", "help scene", "help man", "schema", "completion bash", "list",
                           "list .", "check mine.toml", "trajectory mine.toml"}) {
    const Said said = run(scratch, bare + call);
    EXPECT_EQ(said.exit_code, 0) << call << said.err;
    EXPECT_THAT(said.out, Not(testing::IsEmpty())) << call;
  }
  const Said said = run(scratch, bare + "frame mine.toml --frame 0 -o a.png");
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.err, HasSubstr("Inter-Regular.otf: open font"));
}

}  // namespace
}  // namespace bookspin
