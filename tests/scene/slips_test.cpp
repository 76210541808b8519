// What most likely went wrong in a script, said; and what it says, and hardly means.

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "scene/message_of.h"

namespace bookspin {
namespace {

// The rest of these messages is the TOML library's.
TEST(ScriptFile, WhatMostLikelyWentWrongIsSaid) {
  const std::pair<const char*, const char*> slips[] = {
      {"title = “T”\n", "; a text stands in straight quotes, \" or '"},
      {"title = ‘T’\n", "; a text stands in straight quotes, \" or '"},
      {"title = 'T'\n[clip]\ntime_per_frame = 0,5\n", "; decimals follow a point, not a comma"},
      {"title = Bad\n", "; a text stands in quotes"},
      {"title: \"T\"\n", "; a key has its value behind ="},
      {"\xff\xfet", "; the text is UTF-16: save it as UTF-8"},
      {"title = \"caf\xe9\"\n", "; save it as UTF-8"}};
  for (const auto& [text, said] : slips) {
    const std::string message = message_of(text, {});
    EXPECT_TRUE(message.ends_with(said)) << message;
  }
}

TEST(ScriptFile, WhateverItHoldsTheMessageIsShort) {
  const std::string much(1000000, 'k');
  for (const std::string& text : {much + " = 1\n", "title = '" + much + "'\nframes = 1\n", "title = " + much, much}) {
    EXPECT_LT(message_of(text, {}).size(), 300U);
  }
  std::string expects = "title = 'T'\n[[book]]\n";
  for (int i = 0; i < 1001; ++i) expects += "[[expect]]\nquantity = 'tilt'\nat_most = 1\n";
  EXPECT_EQ(message_of(expects, {}),
            "s.toml:3:1: expect: found a list of tables; allowed: up to 1000 tables [[expect]], not 1001");
}

TEST(Remarks, AreMadeOnWhatIsHardlyMeant) {
  const auto remarks = [](const std::string& keys) {
    return remarks_on(parse_scene("title = 'T'\n[clip]\ntime_per_frame = 0.5\nsubsteps = 10\n[[book]]\n" + keys, "s"));
  };
  using Remarks = std::vector<std::string>;
  EXPECT_EQ(remarks(""), Remarks{"book.0: does not turn: its angular_velocity is [0, 0, 0]"});
  EXPECT_EQ(remarks("angular_velocity = [0, 20, 0]"), Remarks{});
  EXPECT_EQ(remarks("method = 'exact'\nangular_velocity = [6, 0, 0]"), Remarks{});
  EXPECT_EQ(remarks("angular_velocity = [0, 30, 0]"),
            Remarks{"book.0.angular_velocity: turns the book by 1.5 radians from one step to the next: are these "
                    "degrees? radians are meant"});
  EXPECT_EQ(remarks("method = 'exact'\nangular_velocity = [30, 0, 0]"),
            Remarks{"book.0.angular_velocity: turns the book by 15 radians from one frame to the next: are these "
                    "degrees? radians are meant"});
  EXPECT_TRUE(remarks_on(parse_scene("title = 'T'\nclip = {frames = 1}\n[[book]]", "s")).empty());
}

TEST(ScriptFile, ThatCannotBeReadIsNamed) {
  for (const char* file : {"no/such/script.toml", BOOKSPIN_SOURCE_DIR}) {
    try {
      (void)load_scene(file);
      FAIL() << "accepted " << file;
    } catch (const std::runtime_error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(std::string(file) + ": cannot be read: "));
    }
  }
}

}  // namespace
}  // namespace bookspin
