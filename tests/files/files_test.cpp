// A name never stands for half a file.

#include "files/files.h"

#include <gtest/gtest.h>

#include <functional>
#include <iterator>
#include <stdexcept>

#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

void make(const fs::path& file, const std::string& text) {
  Part part(file);
  write_part(part, text);
  publish({&part});
}

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
  make(scratch / "a", text);
  EXPECT_EQ(read_file(scratch / "a"), text);
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder()), fs::directory_iterator()), 1);
}

TEST(Files, AnErrorWhileWritingLeavesTheOldFile) {
  const Scratch scratch;
  make(scratch / "a", "old");
  EXPECT_EQ(failure([&] {
              const Part part(scratch / "a");
              write_part(part, [](std::ostream& out) {
                out << "half of the new";
                throw std::runtime_error("broken off");
              });
            }),
            "broken off");
  EXPECT_EQ(read_file(scratch / "a"), "old");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch.folder()), fs::directory_iterator()), 1);
}

TEST(Files, FailuresNameFileOperationAndReason) {
  const Scratch scratch;
  EXPECT_EQ(failure([&] { (void)read_file(scratch / "none"); }),
            (scratch / "none").string() + ": cannot be read: No such file or directory");
  EXPECT_EQ(failure([&] { (void)read_file(scratch.folder()); }),
            scratch.folder().string() + ": cannot be read: is a folder");
  EXPECT_EQ(failure([&] { const Part part(scratch / "no/folder"); }),
            (scratch / "no/folder").string() + ": cannot be opened for writing: No such file or directory");
  write_text(scratch / "file", "");
  EXPECT_EQ(failure([&] { make_folder(scratch / "file/folder"); }),
            (scratch / "file/folder").string() + ": cannot be made: Not a directory");
  EXPECT_EQ(failure([&] { const Part part(scratch.folder()); }),
            scratch.folder().string() + ": cannot be replaced: is a folder");
}

TEST(Files, SizesAreReadable) {
  EXPECT_EQ(readable_size(0), "0 kB");
  EXPECT_EQ(readable_size(411600), "412 kB");
  EXPECT_EQ(readable_size(999600), "1.0 MB");
  EXPECT_EQ(readable_size(3140000), "3.1 MB");
}

}  // namespace
}  // namespace bookspin
