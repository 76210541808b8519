// When a film is made anew; and the process that makes it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "files/checksums.h"
#include "film/process.h"
#include "film/tumbling.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

TEST(Process, SaysWhatItsWorkSaysOrWhyNot) {
  EXPECT_EQ(Process([](const auto&) { return std::string(100000, 'x'); }).result(), std::string(100000, 'x'));
  const auto error_of = [](const auto& work) -> std::string {
    try {
      return "returned " + Process(work).result();
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  };
  EXPECT_EQ(error_of([](const auto&) -> std::string { throw std::invalid_argument("no such book"); }), "no such book");
  EXPECT_THAT(error_of([](const auto&) -> std::string {
                std::raise(SIGSEGV);
                return "";
              }),
              testing::StartsWith("its process "));  // a sanitizer ends it in its own way
}

// Also one that does not look at its token, and has something in the making.
TEST(Process, EndsBySigtermWhenItIsAskedToStop) {
  const Scratch scratch;
  const auto wait_for_the_token = [](const std::stop_token& stop) -> std::string {
    while (!stop.stop_requested()) std::this_thread::yield();
    throw std::runtime_error("stopped");
  };
  const auto never_look = [&](const std::stop_token&) -> std::string {
    const Part part(scratch / "film");
    for (;;) pause();
  };
  using Work = std::function<std::string(const std::stop_token&)>;
  for (const Work& work : {Work(wait_for_the_token), Work(never_look)}) {
    Process process(work);
    process.ask_to_stop();
    EXPECT_THAT([&] { (void)process.result(); },
                testing::ThrowsMessage<std::runtime_error>("its process was ended by signal 15 (Terminated)"));
  }
  EXPECT_TRUE(fs::is_empty(scratch.folder()));
}

TEST_F(Shoot, UpToDateMeansMadeOfThisScriptInThisWayAndWhole) {
  EXPECT_FALSE(up_to_date());
  shoot_it();
  EXPECT_TRUE(up_to_date());
  fs::last_write_time(script, fs::last_write_time(script) + std::chrono::hours(1));  // content counts, not time
  EXPECT_TRUE(up_to_date());

  FilmSettings other = small();
  other.width = 320;
  EXPECT_FALSE(up_to_date(other));
  other = small();
  other.overrides = {"seed=2"};
  EXPECT_FALSE(up_to_date(other));
  other = small();
  other.end_frame = 23;
  EXPECT_FALSE(up_to_date(other));
  other = small();
  other.drawn_by = "another shader";
  EXPECT_FALSE(up_to_date(other));

  for (const auto& [name, text] : products_there()) {
    for (const std::string& damage : {std::string(), text.substr(0, text.size() / 2), "{\"met\": \"yes\"}" + text}) {
      write_text(site / name, damage);
      EXPECT_FALSE(up_to_date()) << name;
    }
    fs::remove(site / name);
    EXPECT_FALSE(up_to_date()) << name;
    write_text(site / name, text);
    EXPECT_TRUE(up_to_date()) << name;
  }
}

TEST_F(Shoot, AFilmByAnotherOpenGlIsNotUpToDate) {
  shoot_it();
  std::string data = read_text(site / "tumbling.json");
  std::string list = read_text(site / checksums_name);
  const std::string digest = sha256(data);
  data.replace(data.find("\"OpenGL\": \"") + 11, 0, "Older ");
  list.replace(list.find(digest), digest.size(), sha256(data));
  write_text(site / "tumbling.json", data);
  write_text(site / checksums_name, list);
  EXPECT_FALSE(up_to_date());
}

// A scratch copy of what is drawn from: shaders and textures count, their sources do not.
TEST(FingerprintOfDrawing, ChangesWithWhatIsDrawnFrom) {
  const Scratch scratch;
  for (const char* folder : {"shaders", "textures"}) fs::copy(project / folder, scratch / folder);
  const std::string before = fingerprint_of_drawing(scratch.folder());
  EXPECT_EQ(before, fingerprint_of_drawing(project));
  write_text(scratch / "textures/front.svg", "");
  EXPECT_EQ(before, fingerprint_of_drawing(scratch.folder()));
  for (const char* file : {"shaders/line.frag", "textures/front.png"}) {
    const std::string text = read_text(scratch / file);
    write_text(scratch / file, text + " ");
    EXPECT_NE(before, fingerprint_of_drawing(scratch.folder())) << file;
    write_text(scratch / file, text);
  }
  EXPECT_EQ(before, fingerprint_of_drawing(scratch.folder()));
}

}  // namespace
}  // namespace bookspin
