// A name never stands for half a file.

#include "files/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::string failure(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Files, WhatIsWrittenIsReadBackAndNothingElseStays) {
  const Scratch scratch;
  const std::string text("two\nlines\0and a zero", 20);
  write_file(scratch / "a", text);
  EXPECT_EQ(read_file(scratch / "a"), text);
  EXPECT_FALSE(fs::exists(scratch / "a.part"));
}

TEST(Files, AnErrorWhileWritingLeavesTheOldFile) {
  const Scratch scratch;
  write_file(scratch / "a", "old");
  EXPECT_EQ(failure([&] {
              write_file(scratch / "a", [](std::ostream& out) {
                out << "half of the new";
                throw std::runtime_error("broken off");
              });
            }),
            "broken off");
  EXPECT_EQ(read_file(scratch / "a"), "old");
  EXPECT_FALSE(fs::exists(scratch / "a.part"));
}

TEST(Files, FailuresNameFileOperationAndReason) {
  const Scratch scratch;
  EXPECT_EQ(failure([&] { (void)read_file(scratch / "none"); }),
            (scratch / "none").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(failure([&] { (void)read_file(scratch.folder()); }),
            scratch.folder().string() + ": cannot be read: is a folder");
  EXPECT_EQ(failure([&] { write_file(scratch / "no/folder", "text"); }),
            (scratch / "no/folder").string() + ": cannot be opened for writing: No such file or directory");
  fs::create_directories(scratch / "in the way" / "of it");
  EXPECT_THAT(failure([&] { write_file(scratch / "in the way", "text"); }),
              HasSubstr("in the way: cannot be renamed: "));
  EXPECT_FALSE(fs::exists(scratch / "in the way.part"));
}

TEST(Files, SizesAreReadable) {
  EXPECT_EQ(readable_size(0), "0 kB");
  EXPECT_EQ(readable_size(411600), "412 kB");
  EXPECT_EQ(readable_size(999600), "1.0 MB");
  EXPECT_EQ(readable_size(3140000), "3.1 MB");
}

}  // namespace
}  // namespace bookspin
