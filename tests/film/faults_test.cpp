// A film that is made onto an older one of its name, with a fault at every call that touches a file: what is there in
// the end is whole and of one making, the old or the new; a message says what failed; nothing else stays.

#include "faults.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <map>

#include "film/film_data.h"
#include "film/shoot.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;  // name -> content

constexpr const char* script_text = R"(
title = "Four frames"
[clip]
frames = 4
substeps = 2
[[book]]
method = "matrix"
angular_velocity = [1, 2, 0]
)";

Files files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    files[entry.path().filename().string()] = read_text(entry.path());
  }
  return files;
}

// Without what a killed program leaves for the next.
Files named_files_in(const fs::path& folder) {
  Files files = files_in(folder);
  std::erase_if(files, [](const auto& file) { return file.first.starts_with(".bookspin-"); });
  return files;
}

struct Faults : testing::Test {
  Faults() {
    write_text(scratch / "film.toml", script_text);
    FilmSettings settings;
    settings.width = 64;
    settings.height = 36;
    old_film = load_film(scratch / "film.toml", settings);
    settings.overrides = {"clip.frames=3"};
    new_film = load_film(scratch / "film.toml", settings);
    shoot(new_film);
    new_set = files_in(site);
    shoot(old_film);
    old_set = files_in(site);
  }

  void SetUp() override {
    ASSERT_NE(old_set, new_set);
    ASSERT_EQ(old_set.size(), 4U);
    if (!can_inject_faults()) GTEST_SKIP() << "no system calls can be made to fail here";
  }

  void shoot(const Film& film) {
    (void)bookspin::shoot(
        film, site, [this]() -> Renderer& { return renderer; }, progress);
  }

  void restore() const {
    fs::remove_all(site);
    fs::create_directories(site);
    for (const auto& [name, text] : old_set) write_text(site / name, text);
  }

  // What happened, whatever the fault: whole, of one making, with a message unless it is done, and without leftovers.
  Outcome attempt_film(const Experiment& experiment) {
    restore();
    const Outcome outcome = attempt(experiment, [this] { shoot(new_film); });
    SCOPED_TRACE(testing::Message() << "fault " << static_cast<int>(experiment.fault) << ", errno " << experiment.error
                                    << ", at call " << experiment.number << ": " << outcome.message);
    EXPECT_TRUE(outcome.killed || outcome.exit_code >= 0) << "crashed";
    const bool lasting = experiment.fault == Fault::keeps_failing;
    const bool done = outcome.exit_code == 0;
    EXPECT_EQ(outcome.message.empty(), done || outcome.killed);
    if (!outcome.killed && !lasting) {
      EXPECT_EQ(named_files_in(site), done ? new_set : old_set);
    }
    settle(site);
    const Files left = files_in(site);
    EXPECT_TRUE(left == (done ? new_set : old_set) || (outcome.killed && left == new_set));
    return outcome;
  }

  // At every call until one more than there are; how many.
  int attempt_everywhere(Fault fault, int error) {
    for (int number = 1;; ++number) {
      const Outcome outcome = attempt_film({fault, number, error});
      if (outcome.calls < number || HasFailure()) return number - 1;
    }
  }

  Scratch scratch{folder_in_memory()};
  fs::path site = scratch / "site";
  Renderer renderer{64, 36, BOOKSPIN_SOURCE_DIR};
  Progress progress;
  Film old_film, new_film;
  Files old_set, new_set;
};

TEST_F(Faults, EveryCallThatFails) {
  int faults = 0;
  for (const int error : {EIO, ENOSPC, EINTR}) faults += attempt_everywhere(Fault::fails, error);
  EXPECT_GE(faults, 300);  // 3 x 140 or so
}

TEST_F(Faults, EveryCallFromWhichAllFail) {
  EXPECT_GE(attempt_everywhere(Fault::keeps_failing, EIO), 100);
}

TEST_F(Faults, EveryWriteThatIsCutShort) {
  EXPECT_GE(attempt_everywhere(Fault::cut_short, 0), 100);
}

TEST_F(Faults, KilledAtEveryCall) {
  EXPECT_GE(attempt_everywhere(Fault::kills, 0), 100);
}

}  // namespace
}  // namespace bookspin
