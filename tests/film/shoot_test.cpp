// A film from script to files: what it leaves, what it keeps, when it is made anew.

#include "film/shoot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "files/checksums.h"
#include "film/film_data.h"
#include "film/tumbling.h"
#include "image/png.h"
#include "render/renderer.h"
#include "scene/scene_file.h"
#include "scratch.h"
#include "video/mp4_reader.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST_F(Shoot, LeavesFilmPosterAndData) {
  const FilmReceipt receipt = shoot_it();
  EXPECT_EQ(files_in(site),
            (std::vector<std::string>{"bookspin.sha256", "tumbling.json", "tumbling.mp4", "tumbling.png"}));
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
  shoot_it();
  const Scene scene = load_scene(script);
  for (const int frame : {0, 12, 23}) {
    const Image decoded = read_frame(site / "tumbling.mp4", frame);
    const double right = psnr(draw_frame(scene, frame, width, height, project), decoded);
    EXPECT_GT(right, 30.0) << frame;  // measured 31.9 to 33.7 dB: at this size half resolution in color costs most
    const double neighbor = psnr(draw_frame(scene, frame == 0 ? 1 : frame - 1, width, height, project), decoded);
    EXPECT_GT(right, neighbor + 6.0) << frame;  // measured 18.4 to 20.7 dB for the neighbor
  }
}

TEST_F(Shoot, ThePosterIsTheMiddleFrame) {
  shoot_it();
  const Image poster = read_png(site / "tumbling.png");
  EXPECT_EQ(poster.rgba, draw_frame(load_scene(script), 12, width, height, project).rgba);
}

TEST_F(Shoot, AStillLeavesNoFilm) {
  FilmSettings settings = small();
  settings.overrides = {"clip.frames=1"};
  const FilmReceipt receipt = shoot_it(load_film(script, settings));
  EXPECT_EQ(receipt.product, site / "tumbling.png");
  EXPECT_EQ(files_in(site), (std::vector<std::string>{"bookspin.sha256", "tumbling.json", "tumbling.png"}));
}

TEST_F(Shoot, PartOfTheFramesOfTheSameMotion) {
  FilmSettings settings = small();
  settings.first_frame = 10;
  settings.end_frame = 14;
  shoot_it(load_film(script, settings));
  EXPECT_EQ(read_mp4_info(site / "tumbling.mp4").frames, 4);
  const Image drawn = draw_frame(load_scene(script), 13, width, height, project);
  EXPECT_GT(psnr(drawn, read_frame(site / "tumbling.mp4", 3)), 30.0);  // measured 33 dB
}

TEST_F(Shoot, FramesThatTheSceneLacksAreAnError) {
  FilmSettings settings = small();
  settings.first_frame = 20;
  settings.end_frame = 25;
  EXPECT_THAT([&] { (void)load_film(script, settings); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("tumbling.toml: found frames 20:25; allowed: A:B with 0 <= A < B <= 24")));
}

TEST_F(Shoot, TwiceTheSameBytesWhateverTheNumberOfWorkers) {
  const fs::path other = scratch / "other.toml";
  write_text(other, tumbling);
  const std::vector<Film> films{load_film(script, small()), load_film(other, small())};
  for (const FilmOutcome& outcome : shoot_all(films, site, project, 2, progress)) EXPECT_EQ(outcome.error, "");
  const auto made = products_there();
  EXPECT_EQ(made.at("tumbling.mp4"), made.at("other.mp4"));
  for (const FilmOutcome& outcome : shoot_all(films, site, project, 1, progress)) EXPECT_EQ(outcome.error, "");
  EXPECT_EQ(products_there(), made);
  EXPECT_EQ(progress.films_done, 2);
  EXPECT_EQ(progress.frames_simulated, 2 * 24);
  EXPECT_EQ(progress.frames_drawn, 2 * 24);
}

FilmSettings of_eight_segments_and_a_bit() {  // of 30 frames
  FilmSettings settings = small();
  settings.overrides = {"clip.frames=250"};
  return settings;
}

FilmSettings for_minutes() {
  FilmSettings settings = small();
  settings.overrides = {"clip.frames=100000", "clip.substeps=1"};
  return settings;
}

TEST_F(Shoot, WorkersWhoShareAFilmMakeTheSameBytes) {
  const std::vector<Film> films{load_film(script, of_eight_segments_and_a_bit())};
  ASSERT_EQ(shoot_all(films, site, project, 1, progress)[0].error, "");
  const auto made = products_there();
  EXPECT_EQ(read_mp4_info(site / "tumbling.mp4").frames, 250);
  for (const int workers : {2, 3, 16}) {
    fs::remove_all(site);
    ASSERT_EQ(shoot_all(films, site, project, workers, progress)[0].error, "");
    EXPECT_EQ(products_there(), made) << workers;
    EXPECT_EQ(progress.frames_drawn, 250);
    EXPECT_EQ(progress.frames_simulated, 250);
  }
}

// The script is saved anew, or gone, while its film is in the making.
TEST_F(Shoot, TheDataShowTheScriptThatMadeTheFilm) {
  const Film film = load_film(script, small());
  const std::string edited = std::string(tumbling) + "# edited\n";
  write_text(script, edited);
  shoot_it(film);
  EXPECT_EQ(nlohmann::json::parse(read_text(site / "tumbling.json"))["script"], tumbling);
  EXPECT_FALSE(up_to_date());
  shoot_it();
  EXPECT_EQ(nlohmann::json::parse(read_text(site / "tumbling.json"))["script"], edited);
  EXPECT_TRUE(up_to_date());

  fs::remove(script);
  shoot_it(film);
  write_text(script, tumbling);
  EXPECT_TRUE(up_to_date());
}

// What a FIFO, or bash's <(...), says it says once.
TEST_F(Shoot, AScriptMayBeAFifo) {
  fs::remove(script);
  ASSERT_EQ(mkfifo(script.c_str(), 0600), 0);
  std::jthread writer([this] { write_text(script, tumbling); });
  const Film film = load_film(script, small());
  writer.join();
  shoot_it(film);
  EXPECT_EQ(nlohmann::json::parse(read_text(site / "tumbling.json"))["script"], tumbling);
}

TEST_F(Shoot, AStoppedFilmLeavesTheLastGoodOne) {
  shoot_it();
  const auto made = products_there();
  std::stop_source source;
  source.request_stop();
  EXPECT_THROW(shoot_it(load_film(script, small()), source.get_token()), Stopped);
  EXPECT_EQ(products_there(), made);

  const std::vector<Film> films{load_film(script, small())};
  const std::vector<FilmOutcome> outcomes = shoot_all(films, site, project, 1, progress, [] { return false; });
  EXPECT_FALSE(outcomes[0].receipt.has_value());
  EXPECT_EQ(outcomes[0].error, "");
  EXPECT_EQ(products_there(), made);
}

// A name that cannot be taken is found out before anything is drawn, whichever of the three it is.
TEST_F(Shoot, AProductThatCannotTakeItsNameLeavesTheWholeOldSet) {
  shoot_it();
  for (const char* product : {"tumbling.mp4", "tumbling.png", "tumbling.json"}) {
    fs::rename(site / product, scratch / "kept");
    fs::create_directories(site / product);
    auto made = products_there();
    progress.frames_drawn = 0;
    FilmSettings other = small();
    other.overrides = {"seed=2", "clip.frames=12"};
    EXPECT_THAT([&] { shoot_it(load_film(script, other)); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(product), HasSubstr("is a folder"))));
    EXPECT_EQ(progress.frames_drawn, 0);
    EXPECT_EQ(products_there(), made);
    fs::remove(site / product);
    fs::rename(scratch / "kept", site / product);
  }
  EXPECT_TRUE(up_to_date());
}

TEST_F(Shoot, AFilmNeverReplacesItsScript) {
  fs::create_directories(site);
  for (const char* name : {"scene.mp4", "scene.png", "scene.json"}) {
    write_text(site / name, tumbling);
    EXPECT_THAT([&] { shoot_it(load_film(site / name, small())); },
                ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(name), HasSubstr("call that scene.toml"))));
    EXPECT_EQ(read_text(site / name), tumbling);
    fs::remove(site / name);
  }
}

TEST_F(Shoot, NamesAsLongAsAFileMayHave) {
  const std::string longest(250, 'n');
  write_text(scratch / (longest + ".toml"), tumbling);
  FilmSettings settings = small();
  settings.end_frame = 1;
  shoot_it(load_film(scratch / (longest + ".toml"), settings));
  EXPECT_EQ(files_in(site),
            (std::vector<std::string>{"bookspin.sha256", longest + ".json", longest + ".mp4", longest + ".png"}));

  const std::string too_long(251, 'n');  // "NAME.json" would have 256 bytes
  write_text(scratch / (too_long + ".tml"), tumbling);
  progress.frames_drawn = 0;
  EXPECT_THAT([&] { shoot_it(load_film(scratch / (too_long + ".tml"), settings)); },
              ThrowsMessage<std::runtime_error>(HasSubstr("File name too long")));
  EXPECT_EQ(progress.frames_drawn, 0);
  EXPECT_EQ(files_in(site).size(), 4U);
}

TEST_F(Shoot, WhatTheDataCannotHoldIsRefusedBeforeTheWork) {
  write_text(scratch / "bad\xff.toml", tumbling);
  const auto refused = [](const std::string& where) {
    return ThrowsMessage<std::invalid_argument>(AllOf(HasSubstr(where), HasSubstr("UTF-8")));
  };
  EXPECT_THAT([&] { (void)load_film(scratch / "bad\xff.toml", small()); }, refused("file name"));
  FilmSettings settings = small();
  settings.overrides = {"caption=\xff"};
  EXPECT_THAT([&] { (void)load_film(script, settings); }, refused("--set"));
}

// Two programs, or here two threads, make films of one name: what stands there in the end is one of them.
TEST_F(Shoot, TwoWhoFilmOneNameDoNotMixTheirFilms) {
  FilmSettings shorter = small();
  shorter.overrides = {"clip.frames=12"};
  for (int i = 0; i < 4; ++i) {
    const auto film = [this](const FilmSettings& settings) { shoot_it(load_film(script, settings)); };
    std::jthread one(film, small());
    std::jthread other(film, shorter);
    one.join();
    other.join();
    EXPECT_NE(up_to_date(small()), up_to_date(shorter));
    const auto data = nlohmann::json::parse(read_text(site / "tumbling.json"));
    EXPECT_EQ(read_mp4_info(site / "tumbling.mp4").frames, data["clip"]["frames"].get<int>());
    EXPECT_EQ(files_in(site).size(), 4U);
  }
}

TEST_F(Shoot, AStillTakesAwayTheFilmThatItWas) {
  FilmSettings still = small();
  still.overrides = {"clip.frames=1"};
  shoot_it();
  shoot_it(load_film(script, still));
  EXPECT_EQ(files_in(site), (std::vector<std::string>{"bookspin.sha256", "tumbling.json", "tumbling.png"}));

  write_text(site / "tumbling.mp4", "another's");
  shoot_it(load_film(script, still));
  EXPECT_EQ(read_text(site / "tumbling.mp4"), "another's");
}

TEST_F(Shoot, OneBadFilmDoesNotStopTheOthers) {
  fs::create_directories(site / "tumbling.mp4");  // cannot be replaced by a file
  const fs::path other = scratch / "other.toml";
  write_text(other, tumbling);
  const std::vector<Film> films{load_film(script, small()), load_film(other, small())};
  const std::vector<FilmOutcome> outcomes = shoot_all(films, site, project, 1, progress);
  EXPECT_THAT(outcomes[0].error, HasSubstr("tumbling.mp4"));
  EXPECT_FALSE(outcomes[0].receipt.has_value());
  EXPECT_EQ(outcomes[1].error, "");
  EXPECT_FALSE(fs::exists(site / "tumbling.json"));  // the data says that a film is complete
  EXPECT_TRUE(fs::exists(site / "other.mp4"));
}

// As by the system when memory runs out. The name of a part says which process writes it.
TEST_F(Shoot, AWorkerThatIsKilledCostsItsFilmOnly) {
  std::vector<Film> films{load_film(script, for_minutes())};
  write_text(scratch / "other.toml", tumbling);
  films.push_back(load_film(scratch / "other.toml", small()));
  bool killed = false;
  const auto kill_the_first = [&] {
    if (killed || progress.films_done < 1) return true;  // the other is made
    for (const std::string& name : files_in(site)) {
      if (!name.ends_with(".part")) continue;
      killed = kill(std::stoi(name.substr(std::string(".bookspin-").size())), SIGKILL) == 0;
    }
    return true;
  };
  const std::vector<FilmOutcome> outcomes = shoot_all(films, site, project, 2, progress, kill_the_first);
  for (const std::string& name : files_in(site)) EXPECT_FALSE(name.starts_with(".bookspin-")) << name;
  EXPECT_FALSE(outcomes[0].receipt.has_value());
  EXPECT_THAT(outcomes[0].error, testing::HasSubstr("ended by signal 9"));
  ASSERT_TRUE(outcomes[1].receipt.has_value()) << outcomes[1].error;
  EXPECT_EQ(outcomes[1].receipt->frames, 24);
  ASSERT_EQ(outcomes[1].receipt->verdicts.size(), 1U);
  EXPECT_EQ(outcomes[1].receipt->verdicts[0].text, shoot_it().verdicts[0].text);
}

// The processes that share a film end with the one that has it, and it with any of them.
TEST_F(Shoot, WhoeverIsKilledOfThoseWhoShareAFilmNothingIsLeft) {
  shoot_it();
  const auto before = products_there();
  const std::vector<Film> films{load_film(script, for_minutes())};
  const auto kills = [&](bool the_owner, int number) {
    bool killed = false;
    const auto kill_one = [&] {
      if (killed || progress.frames_drawn < 10) return true;
      const std::string part = files_in(site).front();
      const pid_t owner = std::stoi(part.substr(std::string(".bookspin-").size()));
      const std::string id = std::to_string(owner);
      std::istringstream children(read_text("/proc/" + id + "/task/" + id + "/children"));
      pid_t helper = 0;
      if (children >> helper) killed = kill(the_owner ? owner : helper, number) == 0;
      return true;
    };
    const std::vector<FilmOutcome> outcomes = shoot_all(films, site, project, 3, progress, kill_one);
    EXPECT_TRUE(killed);
    EXPECT_FALSE(outcomes[0].receipt.has_value());
    EXPECT_THAT(outcomes[0].error, HasSubstr("ended by signal " + std::to_string(number)));
    EXPECT_EQ(products_there(), before);
  };
  for (const int number : {SIGKILL, SIGTERM}) {
    for (const bool the_owner : {true, false}) kills(the_owner, number);
  }
}

TEST_F(Shoot, AFilmThatSeveralShareStopsWhenAsked) {
  shoot_it();
  const auto before = products_there();
  const std::vector<Film> films{load_film(script, for_minutes())};
  const std::vector<FilmOutcome> outcomes =
      shoot_all(films, site, project, 3, progress, [&] { return progress.frames_drawn < 10; });
  EXPECT_FALSE(outcomes[0].receipt.has_value());
  EXPECT_EQ(outcomes[0].error, "");
  EXPECT_LT(progress.frames_drawn, 100000);
  EXPECT_EQ(products_there(), before);
}

TEST_F(Shoot, AnUnmetExpectationIsFilmedAndReported) {
  FilmSettings settings = small();
  settings.overrides = {"expect.0.at_most=-1"};
  const FilmReceipt receipt = shoot_it(load_film(script, settings));
  ASSERT_EQ(receipt.verdicts.size(), 1U);
  EXPECT_FALSE(receipt.verdicts[0].met);
  EXPECT_FALSE(nlohmann::json::parse(read_text(site / "tumbling.json"))["met"].get<bool>());
  EXPECT_FALSE(up_to_date(settings));  // it is told again until it is mended
}

}  // namespace
}  // namespace bookspin
