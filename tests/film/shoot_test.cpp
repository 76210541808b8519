// A film from script to files: what it leaves, what it keeps, when it is made anew.

#include "film/shoot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "image/png.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "scratch.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path project = BOOKSPIN_SOURCE_DIR;
constexpr int width = 160;
constexpr int height = 90;

constexpr const char* tumbling = R"(
title = "Tumbling"
[clip]
frames = 24
fps = 30
time_per_frame = 2.0
substeps = 40
[[book]]
method = "matrix"
angular_velocity = [0.2, 0.05, 0]
[[expect]]
quantity = "orthogonality_defect"
at_most = 1e-12
)";

FilmOrder order_for(const fs::path& script, const fs::path& folder) {
  FilmOrder order{script, folder, {}};
  order.made_with.width = width;
  order.made_with.height = height;
  return order;
}

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct Shoot : testing::Test {
  Shoot() { write_text(script, tumbling); }

  FilmReceipt shoot_it(const FilmOrder& order) {
    Renderer renderer(order.made_with.width, order.made_with.height, project);
    return shoot(order, renderer, progress);
  }

  Scratch scratch;
  fs::path script = scratch / "tumbling.toml";
  fs::path site = scratch / "site";
  Progress progress;
};

TEST_F(Shoot, LeavesFilmPosterAndData) {
  const FilmReceipt receipt = shoot_it(order_for(script, site));
  EXPECT_EQ(files_in(site), (std::vector<std::string>{"tumbling.json", "tumbling.mp4", "tumbling.png"}));
  EXPECT_EQ(receipt.product, site / "tumbling.mp4");
  EXPECT_EQ(receipt.bytes, fs::file_size(site / "tumbling.mp4"));
  const auto data = nlohmann::json::parse(read_text(site / "tumbling.json"));
  EXPECT_EQ(data["script"], tumbling);
  EXPECT_EQ(data["film"], "tumbling.mp4");
  EXPECT_EQ(data["format"], "bookspin film 1");
  EXPECT_EQ(data["made_with"]["width"], 160);
  EXPECT_EQ(data["made_with"]["height"], 90);
  EXPECT_EQ(data["expectations"].size(), 1U);
  EXPECT_EQ(data["books"][0]["data"].size(), quantities.size());
  ASSERT_EQ(data["quantities"].size(), quantities.size());
  for (const Quantity& q : quantities) {
    EXPECT_EQ(data["books"][0]["data"][q.name].size(), 24U);
    const nlohmann::json row{{"name", q.name},
                             {"unit", q.unit},
                             {"meaning", q.meaning},
                             {"title", q.title},
                             {"shown_unit", q.shown_unit},
                             {"shown_scale", q.shown_scale},
                             {"axis", {{"low", q.axis.low}, {"high", q.axis.high}, {"most", q.axis.most}}}};
    EXPECT_EQ(data["quantities"][static_cast<std::size_t>(q.id)], row);
  }
}

TEST_F(Shoot, TheFilmShowsWhatWasDrawn) {
  shoot_it(order_for(script, site));
  const Scene scene = load_scene(script);
  for (const int frame : {0, 12, 23}) {
    const Image decoded = read_frame(site / "tumbling.mp4", frame);
    const double right = psnr(draw_frame(scene, frame, width, height, project), decoded);
    EXPECT_GT(right, 30.0) << frame;  // measured 31.9 to 33.7 dB: at this size half resolution in colour costs most
    const double neighbour = psnr(draw_frame(scene, frame == 0 ? 1 : frame - 1, width, height, project), decoded);
    EXPECT_GT(right, neighbour + 6.0) << frame;  // measured 18.4 to 20.7 dB for the neighbour
  }
}

TEST_F(Shoot, ThePosterIsTheMiddleFrame) {
  shoot_it(order_for(script, site));
  const Image poster = read_png(site / "tumbling.png");
  EXPECT_EQ(poster.rgba, draw_frame(load_scene(script), 12, width, height, project).rgba);
}

TEST_F(Shoot, AStillLeavesNoFilm) {
  FilmOrder order = order_for(script, site);
  order.made_with.overrides = {"clip.frames=1"};
  const FilmReceipt receipt = shoot_it(order);
  EXPECT_EQ(receipt.product, site / "tumbling.png");
  EXPECT_EQ(files_in(site), (std::vector<std::string>{"tumbling.json", "tumbling.png"}));
}

TEST_F(Shoot, PartOfTheFramesOfTheSameMotion) {
  FilmOrder order = order_for(script, site);
  order.made_with.first_frame = 10;
  order.made_with.end_frame = 14;
  shoot_it(order);
  EXPECT_EQ(read_mp4_info(site / "tumbling.mp4").frames, 4);
  const Image drawn = draw_frame(load_scene(script), 13, width, height, project);
  EXPECT_GT(psnr(drawn, read_frame(site / "tumbling.mp4", 3)), 30.0);  // measured 33 dB
}

TEST_F(Shoot, FramesThatTheSceneLacksAreAnError) {
  FilmOrder order = order_for(script, site);
  order.made_with.first_frame = 20;
  order.made_with.end_frame = 25;
  try {
    shoot_it(order);
    FAIL() << "no error";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("found frames 20:25; allowed: A:B with 0 <= A < B <= 24"));
  }
  EXPECT_FALSE(fs::exists(site));
}

TEST_F(Shoot, TwiceTheSameBytesWhateverTheNumberOfWorkers) {
  const fs::path other = scratch / "other.toml";
  write_text(other, tumbling);
  std::vector<FilmOrder> orders{order_for(script, site), order_for(other, site)};
  for (const FilmOutcome& outcome : shoot_all(orders, project, 2, progress)) EXPECT_EQ(outcome.error, "");
  const std::string film = read_text(site / "tumbling.mp4");
  const std::string data = read_text(site / "tumbling.json");
  EXPECT_EQ(film, read_text(site / "other.mp4"));
  for (const FilmOutcome& outcome : shoot_all(orders, project, 1, progress)) EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(film, read_text(site / "tumbling.mp4"));
  EXPECT_EQ(data, read_text(site / "tumbling.json"));
  EXPECT_EQ(progress.films_done, 4);
}

TEST_F(Shoot, AStoppedFilmLeavesTheLastGoodOne) {
  shoot_it(order_for(script, site));
  const std::string film = read_text(site / "tumbling.mp4");
  const std::string data = read_text(site / "tumbling.json");
  progress.stop = true;
  EXPECT_THROW(shoot_it(order_for(script, site)), Stopped);
  EXPECT_EQ(film, read_text(site / "tumbling.mp4"));
  EXPECT_EQ(data, read_text(site / "tumbling.json"));
  EXPECT_EQ(files_in(site).size(), 3U);  // no .part
}

TEST_F(Shoot, OneBadFilmDoesNotStopTheOthers) {
  fs::create_directories(site / "tumbling.mp4" / "in the way");  // cannot be replaced by a file
  const fs::path other = scratch / "other.toml";
  write_text(other, tumbling);
  const std::vector<FilmOrder> orders{order_for(script, site), order_for(other, site)};
  const std::vector<FilmOutcome> outcomes = shoot_all(orders, project, 1, progress);
  EXPECT_THAT(outcomes[0].error, HasSubstr("tumbling.mp4"));
  EXPECT_FALSE(outcomes[0].receipt.has_value());
  EXPECT_EQ(outcomes[1].error, "");
  EXPECT_FALSE(fs::exists(site / "tumbling.json"));  // the data says that a film is complete
  EXPECT_TRUE(fs::exists(site / "other.mp4"));
}

TEST_F(Shoot, AnUnmetExpectationIsFilmedAndReported) {
  FilmOrder order = order_for(script, site);
  order.made_with.overrides = {"expect.0.at_most=-1"};
  const FilmReceipt receipt = shoot_it(order);
  ASSERT_EQ(receipt.verdicts.size(), 1U);
  EXPECT_FALSE(receipt.verdicts[0].met);
  EXPECT_FALSE(nlohmann::json::parse(read_text(site / "tumbling.json"))["met"].get<bool>());
  EXPECT_FALSE(is_up_to_date(order, {}));  // it is told again until it is mended
}

// Touching one of a film's inputs, or asking for another film under its name, makes it anew; else it is left alone.
TEST_F(Shoot, UpToDateUntilAnInputChanges) {
  const fs::path shader = scratch / "shaders" / "deep.frag";
  fs::create_directories(shader.parent_path());
  write_text(shader, "");
  const std::vector<fs::path> inputs{shader.parent_path()};
  const FilmOrder order = order_for(script, site);
  EXPECT_FALSE(is_up_to_date(order, inputs));
  shoot_it(order);
  EXPECT_TRUE(is_up_to_date(order, inputs));

  FilmOrder other_size = order;
  other_size.made_with.width = 320;
  EXPECT_FALSE(is_up_to_date(other_size, inputs));
  FilmOrder changed = order;
  changed.made_with.overrides = {"seed=2"};
  EXPECT_FALSE(is_up_to_date(changed, inputs));

  const auto later = fs::last_write_time(site / "tumbling.json") + std::chrono::seconds(1);
  const auto before = fs::last_write_time(script);
  fs::last_write_time(script, later);
  EXPECT_FALSE(is_up_to_date(order, inputs));
  fs::last_write_time(script, before);
  EXPECT_TRUE(is_up_to_date(order, inputs));
  fs::last_write_time(shader, later);
  EXPECT_FALSE(is_up_to_date(order, inputs));
  fs::last_write_time(shader, before);
  fs::remove(site / "tumbling.mp4");
  EXPECT_FALSE(is_up_to_date(order, inputs));
}

}  // namespace
}  // namespace bookspin
