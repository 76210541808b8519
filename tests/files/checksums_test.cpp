#include "files/checksums.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "files/files.h"
#include "scratch.h"

namespace bookspin {
namespace {

// FIPS 180-4's examples, and every length around the end of a block against the system's own.
TEST(Checksums, AreSha256) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Checksums, AreReadBackWhateverTheName) {
  const Scratch scratch;
  Checksums checksums;
  for (const char* name : {"a.mp4", "with space", " leading", "*star", "new\nline", "back\\slash", "\\n", "return\r"}) {
    write_text(scratch / name, name);
    checksums[name] = sha256(name);
  }
  write_text(scratch / checksums_name, text_of(checksums));
  EXPECT_EQ(read_checksums(scratch.folder()), checksums);
  const std::string in_folder = "cd " + scratch.folder().string() + " && ";
  const bool reads_escapes = std::system("sha256sum --version | grep -q GNU") == 0;  // that of uutils 0.8 does not
  const std::string lines = reads_escapes ? "." : "'^[^\\\\]'";
  EXPECT_EQ(std::system(
                (in_folder + "grep " + lines + " " + checksums_name + " | sha256sum --check --strict --quiet").c_str()),
            0);
}

TEST(Checksums, WhatIsNoLineOfTheListIsPassedOver) {
  const std::string digest(64, 'a');
  EXPECT_EQ(parse_checksums(digest + "  a\nhello\n\n" + digest + "\n" + digest + "  \n" + digest + " *b\nx" + digest +
                            "  c\n\\" + digest + "  d\\"),
            (Checksums{{"a", digest}, {"d\\", digest}}));
  const Scratch scratch;
  EXPECT_TRUE(read_checksums(scratch.folder()).empty());
}

}  // namespace
}  // namespace bookspin
