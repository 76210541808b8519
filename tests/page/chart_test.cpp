// The charts under the films.

#include "page/chart.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "page/a_film.h"

namespace bookspin {
namespace {

using nlohmann::json;

std::vector<std::string> labels(const json& ticks) {
  std::vector<std::string> texts;
  for (const json& tick : ticks) texts.push_back(tick["label"]);
  return texts;
}

TEST(Chart, DrawsEveryFrameOfAShortFilm) {
  const json chart = chart_of(as_read(a_film()), "tilt");
  EXPECT_EQ(chart["seconds"], 2.0);
  ASSERT_EQ(chart["panels"].size(), 1U);
  const json& panel = chart["panels"][0];
  EXPECT_EQ(panel["low"], 0.0);
  EXPECT_EQ(panel["high"], 180.0);
  EXPECT_EQ(panel["unit"], "°");
  EXPECT_THAT(labels(panel["ticks"]), testing::ElementsAre("0", "90", "180"));
  EXPECT_EQ(panel["curves"][0]["path"],
            "M0,1000 50,1000 100,1000 150,1000 200,1000 250,1000 300,1000 350,1000 400,1000 450,1000 500,27.8 550,27.8 "
            "600,27.8 "
            "650,27.8 700,27.8 750,27.8 800,27.8 850,27.8 900,27.8 950,27.8");
}

TEST(Chart, PanelsAndTheirCurvesAreThoseAskedFor) {
  json film = a_film();
  film["books"][0]["data"]["angular_momentum_ratio"] = film["books"][0]["data"]["energy_ratio"];
  const json chart = chart_of(as_read(film), " tilt , energy_ratio+angular_momentum_ratio");
  ASSERT_EQ(chart["panels"].size(), 2U);
  ASSERT_EQ(chart["panels"][1]["curves"].size(), 2U);
  EXPECT_EQ(chart["panels"][1]["curves"][0]["color"], 0);
  EXPECT_EQ(chart["panels"][1]["curves"][1]["color"], 1);
  EXPECT_THROW(static_cast<void>(chart_of(as_read(film), "temperature")), std::invalid_argument);
}

TEST(Chart, BooksSideBySideKeepTheirColorAndName) {
  json film = a_film();
  film["books"] = {a_book("springs", 20), a_book("exact", 20)};
  film["books"][0]["data"]["angle_error"] = film["books"][0]["data"]["tilt"];
  film["books"][1]["data"]["angle_error"] = film["books"][1]["data"]["tilt"];
  film["books"][1]["method"] = "exact";
  const json tilt = chart_of(as_read(film), "tilt")["panels"][0];
  EXPECT_EQ(tilt["heading"], "Tilt of the spin axis");
  EXPECT_EQ(tilt["curves"][1]["label"], "exact");
  EXPECT_EQ(tilt["curves"][1]["color"], 1);
  EXPECT_EQ(chart_of(as_read(film), "angle_error")["panels"][0]["curves"].size(), 1U);  // the exact book has none
}

TEST(Chart, AVibrationKeepsItsHeightAndTheChartStaysSmall) {
  json film = a_film(100000);
  json& tilt = film["books"][0]["data"]["tilt"];
  for (std::size_t n = 0; n < tilt.size(); ++n) tilt[n] = n % 2 == 0 ? 0.0 : 90.0;
  const std::string path = chart_of(as_read(film), "tilt")["panels"][0]["curves"][0]["path"];
  EXPECT_THAT(path, testing::HasSubstr(",1000 "));
  EXPECT_THAT(path, testing::HasSubstr(",100 "));  // 90 of 100
  EXPECT_LE(std::count(path.begin(), path.end(), ','), 360);
}

TEST(Chart, AnExplosionEndsTheCurveAndIsMarked) {
  json film = a_film();
  film["books"][0]["exploded_frame"] = 15;
  for (std::size_t n = 15; n < 20; ++n) film["books"][0]["data"]["energy_ratio"][n] = 1e30;
  const json chart = chart_of(as_read(film), "energy_ratio");
  EXPECT_LT(chart["panels"][0]["high"], 3.0);
  const std::string path = chart["panels"][0]["curves"][0]["path"];
  EXPECT_THAT(path, testing::ContainsRegex("700,[0-9.]+$"));
  ASSERT_EQ(chart["marks"].size(), 1U);
  EXPECT_EQ(chart["marks"][0]["at"], "75");
}

TEST(Chart, GrowthByOrdersOfMagnitudeHasALogarithmicAxis) {
  json film = a_film();
  for (std::size_t n = 0; n < 20; ++n)
    film["books"][0]["data"]["energy_ratio"][n] = std::pow(10.0, 0.1 * static_cast<double>(n));
  const json panel = chart_of(as_read(film), "energy_ratio")["panels"][0];
  EXPECT_EQ(panel["log"], true);
  EXPECT_THAT(labels(panel["ticks"]), testing::ElementsAre("1", "10", "100"));
  EXPECT_THAT(panel["curves"][0]["path"].get<std::string>(),
              testing::HasSubstr(" 500,500 "));  // 10 after half the time
}

TEST(Chart, WhatStaysPutIsSeenToAndGapsAreGaps) {
  json film = a_film();
  json& energy = film["books"][0]["data"]["energy_ratio"];
  for (json& value : energy) value = 1.0 + 1e-9;
  energy[7] = nullptr;
  const json panel = chart_of(as_read(film), "energy_ratio")["panels"][0];
  EXPECT_LT(panel["low"], 0.951);
  EXPECT_GT(panel["high"], 1.049);
  EXPECT_THAT(panel["curves"][0]["path"].get<std::string>(), testing::HasSubstr("300,500M400,500"));
}

TEST(Chart, OnlyTheDrawnFramesAreShown) {
  json film = a_film();
  film["clip"]["first_frame"] = 8;
  film["clip"]["drawn_frames"] = 5;
  const json chart = chart_of(as_read(film), "tilt");
  EXPECT_EQ(chart["seconds"], 0.5);
  EXPECT_EQ(chart["panels"][0]["curves"][0]["path"], "M0,1000 200,1000 400,27.8 600,27.8 800,27.8");
}

// In the scene's time, 0.5 a frame.
TEST(Chart, ItsTimeIsTheScenes) {
  json film = a_film();
  EXPECT_THAT(labels(chart_of(as_read(film), "tilt")["times"]), testing::ElementsAre("0", "2", "4", "6", "8", "10"));
  film["clip"]["first_frame"] = 9;
  film["clip"]["drawn_frames"] = 4;
  const json chart = chart_of(as_read(film), "tilt");  // t = 4.5 to 6.5
  EXPECT_EQ(chart["from"], 4.5);
  EXPECT_EQ(chart["span"], 2.0);
  EXPECT_THAT(labels(chart["times"]), testing::ElementsAre("4.5", "5", "5.5", "6", "6.5"));
  EXPECT_EQ(chart["times"][1]["at"], "25");
}

}  // namespace
}  // namespace bookspin
