// A file in the making is private, and several take their names together or not at all.

#include "files/part.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <span>
#include <stdexcept>
#include <utility>

#include "files/checksums.h"
#include "files/files.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

void make(const fs::path& file, const std::string& text) {
  Part part(file);
  write_part(part, text);
  publish({&part});
}
using testing::HasSubstr;
using testing::ThrowsMessage;

std::ptrdiff_t files_in(const fs::path& folder) {
  return std::distance(fs::directory_iterator(folder), fs::directory_iterator());
}

TEST(Part, IsPrivateUntilItIsPublished) {
  const Scratch scratch;
  write_text(scratch / "a", "old");
  Part part(scratch / "a");
  write_part(part, "new");
  EXPECT_EQ(part.path().parent_path(), scratch.folder());
  EXPECT_EQ(read_text(scratch / "a"), "old");
  publish({&part});
  EXPECT_EQ(read_text(scratch / "a"), "new");
  EXPECT_EQ(files_in(scratch.folder()), 1);
}

TEST(Part, IsGoneUnlessItIsPublished) {
  const Scratch scratch;
  { write_part(Part(scratch / "a"), "new"); }
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

// In a child, which keeps the lock for good.
TEST(Part, IsGoneWhenItsProcessAbandonsIt) {
  const Scratch scratch;
  const Part of_the_parent(scratch / "a");
  const pid_t child = fork();
  if (child == 0) {
    const Part part(scratch / "b");
    abandon_parts();
    _exit(fs::exists(part.path()) ? 1 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_TRUE(fs::exists(of_the_parent.path()));
  EXPECT_EQ(files_in(scratch.folder()), 1);
}

TEST(Part, LeavesAUsersFilesAlone) {
  const Scratch scratch;
  fs::create_directories(scratch / "a.part");
  write_text(scratch / "b.part", "mine");
  write_text(scratch / "victim", "mine");
  fs::create_symlink("victim", scratch / "c.part");
  for (const char* name : {"a", "b", "c"}) make(scratch / name, "new");
  EXPECT_TRUE(fs::is_directory(scratch / "a.part"));
  EXPECT_EQ(read_text(scratch / "b.part"), "mine");
  EXPECT_EQ(read_text(scratch / "victim"), "mine");
  EXPECT_EQ(files_in(scratch.folder()), 7);
}

TEST(Part, TwoOfOneNameDoNotMeet) {
  const Scratch scratch;
  Part one(scratch / "a");
  Part two(scratch / "a");
  write_part(one, "one, and longer");
  write_part(two, "two");
  publish({&one});
  EXPECT_EQ(read_text(scratch / "a"), "one, and longer");
  publish({&two});
  EXPECT_EQ(read_text(scratch / "a"), "two");
}

TEST(Part, RefusesToReplaceWhatIsNoFile) {
  const Scratch scratch;
  fs::create_directories(scratch / "folder");
  write_text(scratch / "target", "mine");
  fs::create_symlink("target", scratch / "link");
  ASSERT_EQ(mkfifo((scratch / "fifo").c_str(), 0600), 0);
  const auto refused = [](const std::string& why) { return ThrowsMessage<std::runtime_error>(HasSubstr(why)); };
  EXPECT_THAT([&] { Part(scratch / "folder"); }, refused("folder: cannot be replaced: is a folder"));
  EXPECT_THAT([&] { Part(scratch / "link"); }, refused("link: cannot be replaced: is a symbolic link"));
  EXPECT_THAT([&] { Part(scratch / "fifo"); }, refused("fifo: cannot be replaced: is not a regular file"));
  EXPECT_THAT([&] { Part("/dev/null"); }, refused("/dev/null: cannot be replaced: is not a regular file"));
  EXPECT_THAT([&] { Part(scratch / "no/folder"); },
              refused("no/folder: cannot be opened for writing: No such file or directory"));
  EXPECT_EQ(files_in(scratch.folder()), 4);
}

TEST(Part, WorksForEveryNameThatAFileMayHave) {
  const Scratch scratch;
  const std::string longest(255, 'n');
  make(scratch / longest, "text");
  EXPECT_EQ(read_text(scratch / longest), "text");
  EXPECT_THAT([&] { Part(scratch / (longest + 'n')); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot be opened for writing: File name too long")));
}

// A folder comes into the way of the second or the third while the files are being made.
TEST(Part, SeveralTakeTheirNamesTogetherOrNotAtAll) {
  for (const char* blocked : {"b", "c"}) {
    const Scratch scratch;
    for (const char* name : {"a", "b", "c"}) write_text(scratch / name, "old");
    {
      Part a(scratch / "a");
      Part b(scratch / "b");
      Part c(scratch / "c");
      for (const Part* part : {&a, &b, &c}) write_part(*part, "new");
      fs::remove(scratch / blocked);
      fs::create_directories(scratch / blocked);
      EXPECT_THAT([&] { publish({&a, &b, &c}); }, ThrowsMessage<std::runtime_error>(HasSubstr("is a folder")));
    }
    for (const char* name : {"a", "b", "c"}) {
      if (name == std::string(blocked)) continue;
      EXPECT_EQ(read_text(scratch / name), "old") << name;
    }
    EXPECT_EQ(files_in(scratch.folder()), 3);
  }
}

TEST(Part, AnObsoleteFileGoesWhenThePartsComeIfItIsTheProgramsOwn) {
  const Scratch scratch;
  for (const char* name : {"ours", "users"}) write_text(scratch / name, "old");
  write_text(scratch / checksums_name, text_of({{"ours", std::string(64, '0')}}));
  for (const char* name : {"ours", "users"}) {
    Part part(scratch / "new");
    EXPECT_TRUE(fs::exists(scratch / name));
    publish({&part}, scratch / name);
    EXPECT_EQ(fs::exists(scratch / name), name == std::string("users"));
  }
  EXPECT_EQ(files_in(scratch.folder()), 3);  // users, new, and the list, which is empty
  EXPECT_TRUE(read_checksums(scratch.folder()).empty());
}

TEST(Part, UnderANameOfTheProgramsChoiceReplacesItsOwnFilesAlone) {
  const Scratch scratch;
  const auto make = [&scratch](const std::string& text) {
    Part part(scratch / "a", NamedBy::program);
    write_part(part, text);
    publish({&part});
  };
  write_text(scratch / "a", "mine");
  EXPECT_THAT([&] { make("new"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("a: cannot be replaced: is no file of bookspin's")));
  EXPECT_EQ(read_text(scratch / "a"), "mine");
  EXPECT_EQ(files_in(scratch.folder()), 1);
  write_text(scratch / "a", "");  // nothing is lost
  make("one");
  make("two");
  EXPECT_EQ(read_text(scratch / "a"), "two");
  EXPECT_EQ(read_checksums(scratch.folder()), (Checksums{{"a", sha256("two")}}));
}

// Both ways in which versions without lists wrote a film's data, and what they wrote beside.
TEST(Part, TakesOverWhatAVersionWithoutListsMade) {
  const std::string tail =
      " \"film\": \"a.mp4\",\n \"poster\": \"a.png\",\n \"made_with\": {\n },\n \"clip\": {\n },\n \"script\": "
      "\"\",\n \"books\": [\n ]\n}\n";
  for (const char* head : {"{\n \"title\": \"T\",\n", "{\n \"format\": \"bookspin film 1\",\n"}) {
    const Scratch scratch;
    write_text(scratch / "a.json", head + tail);
    write_text(scratch / "a.vtt", "WEBVTT\n");
    write_text(scratch / "index.html", "<title>The unstable rotation of a book</title>");
    for (const char* name : {"a.mp4", "a.png"}) write_text(scratch / name, "old");
    fs::create_directories(scratch / "report");
    write_text(scratch / "report/report.json",
               "{\n \"processor\": \"p\",\n \"compiler\": \"c\",\n \"flags\": \"f\",\n \"runs\": [\n ]\n}\n");
    write_text(scratch / "report/index.html", "<title>A tumbling book: speed against error</title><img src=\"a.svg\">");
    for (const char* name : {"report/runs.csv", "report/a.svg"}) write_text(scratch / name, "old");
    for (const char* name : {"a.json", "a.vtt", "index.html", "a.mp4", "a.png", "report/report.json",
                             "report/index.html", "report/runs.csv", "report/a.svg"}) {
      EXPECT_NO_THROW(Part(scratch / name, NamedBy::program)) << name;
    }
    Part still(scratch / "a.png", NamedBy::program);
    publish({&still}, scratch / "a.mp4");
    EXPECT_FALSE(fs::exists(scratch / "a.mp4"));
  }
}

TEST(Part, TakesOverNothingThatIsTheUsers) {
  const Scratch scratch;
  const std::string data =
      "{\n \"title\": \"T\",\n \"film\": \"other.mp4\",\n \"poster\": \"other.png\",\n \"made_with\": {\n },\n "
      "\"clip\": {\n },\n \"script\": \"\",\n \"books\": [\n ]\n}\n";
  const std::pair<const char*, std::string> files[] = {
      {"ours.json", data},
      {"ours.mp4", "of another film's name"},
      {"ours.png", "of another film's name"},
      {"ours.vtt", "the user's own captions"},
      {"alone.mp4", "no data beside it"},
      {"alone.json", "{\n \"title\": \"T\"\n}\n"},
      {"quoting.json", "{\n \"title\": \"T\",\n \"note\": \"\\n \\\"made_with\\\": {\\n \\\"clip\\\": {\"\n}\n"},
      {"compact.json", "{\"title\":\"T\",\"made_with\":{},\"clip\":{},\"script\":\"\",\"books\":[]}"},
      {"index.html", "<title>My films</title>"},
      {"runs.csv", "no report beside it"}};
  for (const auto& [name, text] : files) write_text(scratch / name, text);
  for (const auto& [name, text] : std::span(files).subspan(1)) {
    const fs::path file = scratch / name;
    EXPECT_THAT([&file] { const Part part(file, NamedBy::program); },
                ThrowsMessage<std::runtime_error>(HasSubstr("is no file of bookspin's")));
    EXPECT_EQ(read_text(file), text);
  }
}

TEST(Part, AListThatIsNoFileIsRefusedAtOnce) {
  const Scratch scratch;
  write_text(scratch / "elsewhere", "");
  fs::create_symlink("elsewhere", scratch / checksums_name);
  EXPECT_THAT([&] { Part(scratch / "a", NamedBy::program); },
              ThrowsMessage<std::runtime_error>(HasSubstr("bookspin.sha256: cannot be replaced: is a symbolic link")));
  EXPECT_NO_THROW(Part(scratch / "a"));
}

// As `flock FOLDER bookspin ...` has it.
TEST(Part, AFolderThatStaysLockedIsSaid) {
  const Scratch scratch;
  const int folder = open(scratch.folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(folder, LOCK_EX), 0);
  EXPECT_THAT([&] { const Part part(scratch / "a"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("cannot be changed: another program has locked it")));
  close(folder);
  EXPECT_NO_THROW(make(scratch / "a", "text"));
}

TEST(Part, AJournalReachesNothingOutsideItsFolder) {
  const Scratch scratch;
  fs::create_directories(scratch / "films");
  write_text(scratch / "victim", "mine");
  write_text(scratch / "films/.bookspin-1-1.undo", std::string("0\0../a\0../victim\0", 18));
  settle(scratch / "films");
  EXPECT_EQ(read_text(scratch / "victim"), "mine");
  EXPECT_TRUE(fs::is_empty(scratch / "films"));
}

TEST(Part, TheListForgetsFilesThatAreGone) {
  const Scratch scratch;
  for (const char* name : {"a", "b"}) {
    Part part(scratch / name, NamedBy::program);
    publish({&part});
    fs::remove(scratch / "a");
  }
  EXPECT_EQ(read_checksums(scratch.folder()), (Checksums{{"b", sha256("")}}));
}

TEST(Part, WhatAKilledProgramLeftIsRemovedByTheNext) {
  const Scratch scratch;
  const Part living(scratch / "a");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const Part killed(scratch / "b");
    kill(getpid(), SIGKILL);
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(files_in(scratch.folder()), 2);
  const Part next(scratch / "c");
  EXPECT_TRUE(fs::exists(living.path()));
  EXPECT_TRUE(fs::exists(next.path()));
  EXPECT_EQ(files_in(scratch.folder()), 2);
}

}  // namespace
}  // namespace bookspin
