// Damage is found wherever it is; what is whole says how it was made.

#include "page/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/checksums.h"
#include "page/a_film.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::ThrowsMessage;

struct Verify : testing::Test {
  Verify() { write({}); }

  // The film's three, as made; `changes` are merged into the data.
  void write(const json& changes) const {
    write_text(scratch / "a.mp4", "film");
    write_text(scratch / "a.png", "poster");
    json data = a_film();
    data["sha256"] = {{"film", sha256("film")}, {"poster", sha256("poster")}};
    if (!changes.is_null()) data.merge_patch(changes);
    write_text(scratch / "a.json", data.dump());
    write_text(scratch / "index.html", "page");
    list();
  }
  void list() const {
    Checksums listed;
    for (const char* name : {"a.mp4", "a.png", "a.json", "index.html"}) listed[name] = sha256_of(scratch / name);
    write_text(scratch / checksums_name, text_of(listed));
  }
  [[nodiscard]] Finding film() const { return verify(scratch.folder()).at(0); }

  Scratch scratch;
};

TEST_F(Verify, WhatIsWholeSaysHowItWasMade) {
  const std::vector<Finding> findings = verify(scratch.folder());
  ASSERT_EQ(findings.size(), 2U);
  EXPECT_EQ(findings[0].file, "a.json");
  EXPECT_TRUE(findings[0].whole && findings[0].met);
  EXPECT_EQ(findings[0].says, "64x36, 20 frames, 1 of 1 expectations met; by bookspin 1.1.0");
  EXPECT_EQ(findings[1].file, "index.html");
  EXPECT_TRUE(findings[1].whole);
}

TEST_F(Verify, EveryDamageIsFound) {
  for (const char* name : {"a.mp4", "a.png", "a.json"}) {
    write({});
    std::string text = read_text(scratch / name);
    text[text.size() / 2] ^= 1;
    write_text(scratch / name, text);
    EXPECT_FALSE(film().whole) << name;
    write_text(scratch / name, "");
    const std::vector<Finding> findings = verify(scratch.folder());
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return !f.whole; })) << name;
    fs::remove(scratch / name);
    EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) { return !f.whole; })) << name;
  }
}

// Each of the three is as listed, but they do not belong together.
TEST_F(Verify, AMixtureIsFound) {
  write_text(scratch / "a.mp4", "another film");
  list();
  EXPECT_FALSE(film().whole);
  EXPECT_EQ(film().says, "a.mp4 is of another making than its data");
}

TEST_F(Verify, AnUnmetClaimIsSaid) {
  json data = a_film();
  data["expectations"][0]["met"] = false;
  write({{"expectations", data["expectations"]}});
  EXPECT_TRUE(film().whole);
  EXPECT_FALSE(film().met);
}

TEST_F(Verify, AFolderWithoutAListIsRefused) {
  const auto is_refused = ThrowsMessage<std::runtime_error>(HasSubstr("bookspin.sha256 is missing or empty"));
  fs::remove(scratch / checksums_name);
  EXPECT_THAT([&] { (void)verify(scratch.folder()); }, is_refused);
  fs::create_symlink(checksums_name, scratch / checksums_name);  // to itself
  EXPECT_THAT([&] { (void)verify(scratch.folder()); }, is_refused);
}

}  // namespace
}  // namespace bookspin
