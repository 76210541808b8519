// What happens when, in words: each is true of the motion for as long as it is said.

#include "page/cues.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "files/files.h"
#include "film/film_data.h"
#include "film/storyboard.h"
#include "page/a_film.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;

// 10 frames a second; the book of a_film turns over at frame 10.
std::vector<std::string> told(const json& film) {
  const FilmRecord record = as_read(film);
  std::vector<std::string> lines;
  for (const auto& cue : cues_of(record)) lines.push_back(fmt::format("{}-{} {}", cue.first, cue.end, cue.text));
  return lines;
}

json still_film(int frames) {
  json film = a_film(frames);
  film["books"][0]["data"] = {{"tilt", std::vector<double>(static_cast<std::size_t>(frames), 0.0)}};
  return film;
}

TEST(Cues, EndWhereTheirSentenceDoes) {
  json film = still_film(100);
  for (int n = 20; n < 45; ++n) film["books"][0]["data"]["tilt"][n] = 175.0;
  EXPECT_THAT(told(film), ElementsAre("0-20 The book spins steadily about its axis.", "20-45 The book has turned over.",
                                      "45-95 The book has turned back."));
}

TEST(Cues, StandForFiveSecondsAtMost) {
  EXPECT_THAT(told(still_film(100)), ElementsAre("0-50 The book spins steadily about its axis."));
}

TEST(Cues, WhatCannotBeReadIsNotTold) {
  json film = still_film(40);
  for (int n = 20; n < 29; ++n) film["books"][0]["data"]["tilt"][n] = 175.0;
  EXPECT_THAT(told(film),
              ElementsAre("0-20 The book spins steadily about its axis.", "29-40 The book has turned back."));
}

TEST(Cues, TwoAtOnceFollowEachOther) {
  json film = still_film(60);
  std::vector<double> energy(60, 1.0);
  for (std::size_t n = 20; n < 60; ++n) {
    film["books"][0]["data"]["tilt"][n] = 175.0;
    energy[n] = 3.0;
  }
  film["books"][0]["data"]["energy_ratio"] = energy;
  EXPECT_THAT(told(film), ElementsAre("0-20 The book spins steadily about its axis.", "20-30 The book has turned over.",
                                      "30-60 The book has twice its energy and more."));
}

TEST(Cues, AnExplosionIsTheLastThingThatABookDoes) {
  json film = still_film(40);
  for (int n = 30; n < 40; ++n) film["books"][0]["data"]["tilt"][n] = 175.0;
  film["books"][0]["exploded_frame"] = 35;
  EXPECT_THAT(told(film), ElementsAre("0-30 The book spins steadily about its axis.",
                                      "35-40 The book has exploded: a corner is twice as far out as at rest."));
}

TEST(Cues, BooksAmongOthersGoByNameOrMethod) {
  json film = a_film(60);
  film["books"] = {a_book("about x", 60), a_book("", 60)};
  for (json& book : film["books"]) book["data"].erase("energy_ratio");
  film["books"][1]["data"]["tilt"][10] = 0.0;
  EXPECT_THAT(told(film), ElementsAre("0-10 about x, matrix: each book spins steadily about its axis.",
                                      "11-60 about x, matrix: each book has turned over."));
}

TEST(Cues, OneAmongOthersIsTheBook) {
  json film = still_film(20);
  film["books"] = {film["books"][0], film["books"][0]};
  film["books"][1]["name"] = "tipped";
  film["books"][1]["data"]["tilt"][0] = 20.0;
  EXPECT_THAT(told(film), ElementsAre("0-20 matrix: the book spins steadily about its axis."));
}

TEST(Cues, DataBeyondAllSenseEndInWords) {
  json film = still_film(100);
  film["books"][0]["data"]["pulsations"] = std::vector<double>(100, 1e300);
  film["quantities"].push_back(a_quantity("pulsations", "Pulsations so far", "", 1.0, 0.0, 1.0, 0.0));
  EXPECT_EQ(told(film).size(), 1U);
}

TEST(Cues, AScriptsOwnReplaceThem) {
  json film = a_film(40);
  film["cues"] = {{{"says", "Look."}, {"first_frame", 3}, {"end_frame", 9}}};
  EXPECT_THAT(told(film), ElementsAre("3-9 Look."));
}

TEST(Cues, AreThoseOfTheDrawnFrames) {
  json film = still_film(100);
  for (int n = 20; n < 100; ++n) film["books"][0]["data"]["tilt"][n] = 175.0;
  film["clip"]["first_frame"] = 30;
  film["clip"]["drawn_frames"] = 20;
  EXPECT_THAT(told(film), ElementsAre("30-50 The book has turned over."));
}

// An empty line ends a cue, and what follows it is lost.
TEST(Cues, AreOneLineEachInWebVtt) {
  json film = a_film(20);
  film["clip"]["first_frame"] = 5;
  film["clip"]["drawn_frames"] = 10;
  film["cues"] = {{{"says", "first\r\rsecond\n\nNOTE third"}, {"first_frame", 0}, {"end_frame", 7}},
                  {{"says", "2 < 3 & a --> b"}, {"first_frame", 7}, {"end_frame", 20}}};
  const FilmRecord record = as_read(film);
  EXPECT_EQ(web_vtt(record, cues_of(record)),
            "WEBVTT\n\n00:00:00.000 --> 00:00:00.200\nfirst  second  NOTE third\n"
            "\n00:00:00.200 --> 00:00:01.000\n2 &lt; 3 &amp; a --&gt; b\n");
  EXPECT_EQ(web_vtt(record, {}), "WEBVTT\n");
}

// What a sentence says of one book in one frame, measured anew.
bool is_true(const std::string& text, const BookTrack& track, int frame) {
  const auto at = [&](Q q) { return track.frames[static_cast<std::size_t>(frame)][q]; };
  const auto says = [&text](const char* words) { return text.find(words) != std::string::npos; };
  if (says("exploded")) return at(Q::exploded) == 1.0;
  if (at(Q::exploded) == 1.0) return false;
  if (says("stead")) return at(Q::tilt) <= 10.0;
  if (says("turning over") || says("turning back")) return at(Q::tilt) > 15.0 && at(Q::tilt) < 165.0;
  if (says("turned over")) return at(Q::tilt) > 120.0;
  if (says("turned back")) return at(Q::tilt) < 60.0;
  if (says("twice ")) return at(Q::energy_ratio) >= 2.0;
  if (says("ten times ")) return at(Q::energy_ratio) >= 10.0;
  if (says("hundred times ")) return at(Q::energy_ratio) >= 100.0;
  if (says("alf of ")) return at(Q::angular_momentum_ratio) <= 0.5;
  if (says("ine tenths of")) return at(Q::angular_momentum_ratio) <= 0.1;
  if (says("right angle")) return at(Q::angle_error) >= 1.5707;
  if (says("shrunk once")) return at(Q::pulsations) == 1.0;
  if (says("shrunk twice")) return at(Q::pulsations) == 2.0;
  if (says("swollen")) return says(fmt::format(" {} times", at(Q::pulsations)).c_str());
  if (says("out of shape")) {  // or was, within half a second: a vibration
    for (int n = std::max(frame - 30, 0); n <= frame; ++n) {
      if (track.frames[static_cast<std::size_t>(n)][Q::stretch] >= 0.1) return true;
    }
    return false;
  }
  ADD_FAILURE() << "nobody knows what this means: " << text;
  return false;
}

class CuesOf : public testing::TestWithParam<std::string> {};

TEST_P(CuesOf, AreTrueAtBothEnds) {
  const Film film = load_film(fs::path(BOOKSPIN_SOURCE_DIR) / "videos" / (GetParam() + ".toml"), {});
  if (film.is_still()) return;
  const Trajectory trajectory = simulate(film.scene);
  const Scratch scratch;
  Part mp4(scratch / "a.mp4");
  Part poster(scratch / "a.png");
  Part data(scratch / "a.json");
  const int drawn = std::min(Storyboard(film.scene, trajectory, film.width, film.height).frames(), film.frames());
  write_film_data(data, {film, trajectory, judge(film.scene, trajectory), drawn, &mp4, poster, "none"});
  publish({&data});
  const FilmRecord record = read_film_record(scratch / "a.json").value();
  const auto cues = cues_of(record);
  ASSERT_FALSE(cues.empty());
  int end = 0;
  for (const FilmRecord::Cue& cue : cues) {
    SCOPED_TRACE(fmt::format("frames {} to {}: {}", cue.first, cue.end - 1, cue.text));
    EXPECT_GE(cue.first, end);
    end = cue.end;
    EXPECT_EQ(std::count(cue.text.begin(), cue.text.end(), '.'), 1) << "one sentence";
    if (!record.cues.empty()) continue;  // the script's own words
    EXPECT_GE(cue.end - cue.first, cue.text.find("exploded") == std::string::npos ? record.fps : 1);
    for (std::size_t b = 0; b < record.books.size(); ++b) {
      const std::string names = ", " + cue.text.substr(0, cue.text.find(": "));
      if (record.books.size() > 1 && names.find(", " + record.books[b].name) == std::string::npos) continue;
      EXPECT_TRUE(is_true(cue.text, trajectory.books[b], cue.first));
      EXPECT_TRUE(is_true(cue.text, trajectory.books[b], cue.end - 1));
    }
  }
}

std::vector<std::string> scripts() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(fs::path(BOOKSPIN_SOURCE_DIR) / "videos")) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

INSTANTIATE_TEST_SUITE_P(Films, CuesOf, testing::ValuesIn(scripts()),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace bookspin
