// The front door's first step, install-packages, on machines that we are not on: stand-ins for Debian's programs come
// first on PATH, and say what they were asked to do.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

struct Packages : testing::Test {
  Packages() {
    fs::create_directory(scratch / "bin");
    for (const char* tool : {"sh", "grep", "sed", "cat", "dirname", "mktemp", "rm", "tail", "env", "touch", "true"}) {
      fs::create_symlink(
          fs::exists(std::string("/usr/bin/") + tool) ? std::string("/usr/bin/") + tool : std::string("/bin/") + tool,
          scratch / ("bin/" + std::string(tool)));
    }
    fs::copy_file(std::string(BOOKSPIN_SOURCE_DIR) + "/install-packages", scratch / "install-packages");
    write_text(scratch / "apt-packages.txt", "here\nmissing-one\ngone | missing-two | also-there\nhere | other\n");
  }

  void stand_in(const std::string& name, const std::string& script) {
    write_text(scratch / ("bin/" + name), "#!/bin/sh\n" + script + "\n");
    fs::permissions(scratch / ("bin/" + name), fs::perms::owner_all);
  }
  void debian() {
    stand_in("dpkg-query", "[ \"$4\" = here ] && echo installed");
    stand_in("apt-cache", "case $2 in gone*) ;; *) echo \"  Candidate: 1.0\" ;; esac");
    stand_in("apt-get", R"(case "$*" in
*--assume-no*)
  echo "0 upgraded, 340 newly installed, 0 to remove and 3 not upgraded."
  echo "Need to get 96.5 MB of archives."
  echo "After this operation, 417 MB of additional disk space will be used."
  exit 1 ;;
esac
echo apt-get "$@" >>asked
[ "$1" = install ] || exit 0
echo "dlstatus:1:4.5:Retrieving" >&3
echo "dlstatus:2:7.5:Retrieving" >&3
echo "pmstatus:missing-one:100.0:Installed" >&3
echo "E: words of apt-get"
exit ${APT_FAILS:-0})");
  }
  void user(int id) { stand_in("id", "echo " + std::to_string(id)); }
  Said install(const std::string& environment = "") {
    return run(scratch, environment + " PATH=" + (scratch / "bin").string() + " ./install-packages");
  }

  Scratch scratch;
};

TEST_F(Packages, RootInstallsWhatIsMissingAndNothingElse) {
  debian();
  user(0);
  const Said said = install();
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_EQ(read_text(scratch / "asked"),
            "apt-get update\napt-get install -y --no-install-recommends -o APT::Status-Fd=3 missing-one missing-two\n");
  EXPECT_EQ(said.out,
            "Installing missing-one missing-two and what they need: 340 packages, 96.5 MB to download, 417 MB on disk\n"
            "  downloaded 0 %\n  installed 100 %\n");
  EXPECT_THAT(said.err, IsEmpty());
}

TEST_F(Packages, NothingMissingNothingAsked) {
  debian();
  stand_in("dpkg-query", "echo installed");
  user(1000);
  const Said said = install();
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.out + said.err, IsEmpty());
  EXPECT_FALSE(fs::exists(scratch / "asked"));
}

// A desktop has Mesa's drivers; OSMesa, which is the first that would do, comes none the less.
TEST_F(Packages, OfTwoTheFirstIsInstalledThoughTheOtherIsThere) {
  write_text(scratch / "apt-packages.txt", "first | here\ngone | here\n");
  debian();
  user(0);
  EXPECT_EQ(install().exit_code, 0);
  EXPECT_THAT(read_text(scratch / "asked"), HasSubstr("APT::Status-Fd=3 first\n"));
}

TEST_F(Packages, WhereTheFirstCannotBeInstalledTheOtherDoes) {
  write_text(scratch / "apt-packages.txt", "first | here\n");
  debian();
  user(0);
  const Said said = install("APT_FAILS=1");
  EXPECT_EQ(said.exit_code, 0);
  EXPECT_THAT(said.err, HasSubstr("could not be installed, and what is here does without: first\n"));
}

TEST_F(Packages, AUserWhoCannotInstallDoesWithTheOther) {
  write_text(scratch / "apt-packages.txt", "first | here\n");
  debian();
  user(1000);
  EXPECT_EQ(install().exit_code, 0);
  EXPECT_FALSE(fs::exists(scratch / "asked"));
}

TEST_F(Packages, AUserInstallsBySudo) {
  debian();
  user(1000);
  stand_in("sudo", "echo sudo >>asked; exec \"$@\"");
  EXPECT_EQ(install().exit_code, 0);
  EXPECT_THAT(read_text(scratch / "asked"), HasSubstr("sudo\napt-get install"));
}

TEST_F(Packages, AUserWithoutSudoIsToldExactlyWhatIsMissing) {
  debian();
  user(1000);
  const Said said = install();
  EXPECT_NE(said.exit_code, 0);
  EXPECT_THAT(said.err, HasSubstr("apt-get install --no-install-recommends missing-one missing-two\n"));
  EXPECT_FALSE(fs::exists(scratch / "asked"));
}

TEST_F(Packages, WithoutTheArchivesListsTheFirstNamesAreOffered) {
  debian();
  stand_in("apt-cache", "true");
  user(1000);
  EXPECT_THAT(install().err, HasSubstr("apt-get install --no-install-recommends missing-one gone\n"));
}

TEST_F(Packages, WhatTheArchiveDoesNotHaveIsNamedAndTheRestInstalled) {
  write_text(scratch / "apt-packages.txt", "missing-one\ngone\ngone-too | gone-three\n");
  debian();
  user(0);
  const Said said = install();
  EXPECT_EQ(said.exit_code, 1);
  EXPECT_THAT(said.err, HasSubstr("do not have gone, gone-too | gone-three (has Ubuntu's universe been enabled?)\n"));
  EXPECT_THAT(read_text(scratch / "asked"), HasSubstr("APT::Status-Fd=3 missing-one\n"));
}

TEST_F(Packages, AFailedInstallationIsToldToo) {
  debian();
  user(0);
  const Said said = install("APT_FAILS=1");
  EXPECT_NE(said.exit_code, 0);
  EXPECT_THAT(said.err, HasSubstr("E: words of apt-get\n"));
  EXPECT_THAT(said.err, HasSubstr("apt-get install --no-install-recommends missing-one missing-two\n"));
}

TEST_F(Packages, OtherSystemsAreToldEverything) {
  user(0);
  const Said said = install();
  EXPECT_NE(said.exit_code, 0);
  EXPECT_THAT(said.err, HasSubstr("not Debian or Ubuntu"));
  EXPECT_THAT(said.err, HasSubstr("  here\n  missing-one\n  gone | missing-two | also-there\n"));
}

}  // namespace
}  // namespace bookspin
