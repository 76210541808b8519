// What happens when, and its captions.

#include "page/events.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "page/a_film.h"

namespace bookspin {
namespace {

using nlohmann::json;

std::vector<std::string> told(const json& film) {
  std::vector<std::string> lines;
  for (const Event& event : events_of(as_read(film)))
    lines.push_back(std::to_string(event.seconds).substr(0, 3) + " " + event.what);
  return lines;
}

TEST(Events, FlipsBoundsAndExpectationsInOrder) {
  EXPECT_THAT(told(a_film()),
              testing::ElementsAre("1.0 The book has turned over (flip 1). The book has twice its energy.",
                                   "1.9 It turns over."));
}

TEST(Events, AnExplosionIsTheLastThingThatABookDoes) {
  json film = a_film();
  film["expectations"] = json::array();
  film["books"][0]["exploded_frame"] = 6;
  EXPECT_THAT(told(film), testing::ElementsAre("0.6 The book explodes; the film holds on the last picture before."));
}

TEST(Events, BooksAmongOthersGoByNameOrMethod) {
  json film = a_film();
  film["expectations"] = json::array();
  film["books"] = {a_book("about x", 20), a_book("", 20)};
  for (json& book : film["books"]) book["data"].erase("energy_ratio");
  EXPECT_THAT(told(film), testing::ElementsAre("1.0 about x, matrix: the book has turned over (flip 1)."));
}

TEST(Events, AnUnmetExpectationIsNotTold) {
  json film = a_film();
  film["expectations"][0]["met"] = false;
  film["expectations"][0]["found"] = nullptr;
  EXPECT_EQ(told(film).size(), 1U);
}

TEST(Events, TimesAreThoseOfTheDrawnFrames) {
  json film = a_film();
  film["clip"]["first_frame"] = 5;
  film["clip"]["drawn_frames"] = 10;
  EXPECT_THAT(told(film), testing::ElementsAre(testing::StartsWith("0.5 The book has turned over")));
}

TEST(Events, CuesFollowEachOtherWithoutOverlap) {
  const std::string vtt = web_vtt({{0.5, "One."}, {2.0, "Two < three & four -->"}, {70.25, "Last."}}, 71.0);
  EXPECT_EQ(vtt,
            "WEBVTT\n\n00:00:00.500 --> 00:00:02.000\nOne.\n"
            "\n00:00:02.000 --> 00:00:06.000\nTwo &lt; three &amp; four --&gt;\n"
            "\n00:01:10.250 --> 00:01:11.000\nLast.\n");
  EXPECT_EQ(web_vtt({}, 3.0), "WEBVTT\n");
}

// An empty line ends a cue, and what follows it is lost.
TEST(Events, ACueIsOneLineWhateverTheScriptSays) {
  json film = a_film();
  film["books"] = {a_book("Mat\n\nNOTE lost", 20), a_book("a --> b", 20)};
  film["expectations"][0]["says"] = "first\r\rsecond\n\nthird";
  const FilmRecord record = as_read(film);
  const std::string vtt = web_vtt(events_of(record), record.seconds());
  EXPECT_THAT(vtt, testing::HasSubstr("\nMat  NOTE lost, a --&gt; b: the book has turned over (flip 1)."));
  EXPECT_THAT(vtt, testing::EndsWith("\nFirst  second  third.\n"));
  EXPECT_THAT(vtt, testing::Not(testing::HasSubstr("\n\n\n")));
}

}  // namespace
}  // namespace bookspin
