// Three files take their names together, with a fault at every call: all of them do, or none.

#include "faults.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <map>

#include "files/checksums.h"
#include "files/files.h"
#include "scratch.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

struct Publishing : testing::Test {
  void SetUp() override {
    if (!can_inject_faults()) GTEST_SKIP() << "no system calls can be made to fail here";
    replace_by("old");
  }

  // Of "a" to "c" the first does not exist before the new ones come, and the last goes.
  void replace_by(const std::string& text) const {
    const bool is_new = text == "new";
    Part a(scratch / (is_new ? "a" : "b"), NamedBy::program);
    Part b(scratch / (is_new ? "b" : "c"), NamedBy::program);
    for (const Part* part : {&a, &b}) write_part(*part, text);
    publish({&a, &b}, is_new ? scratch / "c" : fs::path());
  }

  void restore() const {
    for (const auto& entry : fs::directory_iterator(scratch.folder())) fs::remove(entry);
    replace_by("old");
  }

  // "old", "new", or what is wrong.
  [[nodiscard]] std::string state(bool leftovers_allowed = false) const {
    std::map<std::string, std::string> found;
    for (const auto& entry : fs::directory_iterator(scratch.folder())) {
      const std::string name = entry.path().filename().string();
      if (leftovers_allowed && name.starts_with(".bookspin-")) continue;
      found[name] = name == checksums_name ? "" : read_text(entry.path());
    }
    const Checksums listed = read_checksums(scratch.folder());
    using Found = std::map<std::string, std::string>;
    if (found == Found{{"b", "old"}, {"c", "old"}, {checksums_name, ""}} &&
        listed == Checksums{{"b", sha256("old")}, {"c", sha256("old")}}) {
      return "old";
    }
    if (found == Found{{"a", "new"}, {"b", "new"}, {checksums_name, ""}} &&
        listed == Checksums{{"a", sha256("new")}, {"b", sha256("new")}}) {
      return "new";
    }
    std::string wrong;
    for (const auto& [name, text] : found) wrong += name + " " + text + ", ";
    return wrong;
  }

  Outcome attempt_it(const Experiment& experiment) const {
    restore();
    return attempt(experiment, [this] { replace_by("new"); });
  }

  Scratch scratch{folder_in_memory()};
};

TEST_F(Publishing, AtEveryCallThatFails) {
  for (const int error : {EIO, ENOSPC, EINTR, EACCES, EPERM}) {
    for (int number = 1;; ++number) {
      const Outcome outcome = attempt_it({Fault::fails, number, error});
      if (outcome.calls < number) break;
      ASSERT_EQ(state(true), outcome.exit_code == 0 ? "new" : "old") << number << ' ' << outcome.message;
      ASSERT_EQ(outcome.exit_code == 0, outcome.message.empty());
      settle(scratch.folder());
      ASSERT_EQ(state(), outcome.exit_code == 0 ? "new" : "old") << number << ' ' << outcome.message;
    }
  }
}

TEST_F(Publishing, WhenAllFailFromSomeCallOn) {
  for (int number = 1;; ++number) {
    const Outcome outcome = attempt_it({Fault::keeps_failing, number, EIO});
    if (outcome.calls < number) break;
    settle(scratch.folder());
    ASSERT_EQ(state(), outcome.exit_code == 0 ? "new" : "old") << number << ' ' << outcome.message;
  }
}

// And whoever takes back what a killed program did may be killed as well.
TEST_F(Publishing, KilledAtEveryCallAndAgainWhileItIsTakenBack) {
  std::string last = "old";
  int taken_back = 0;
  for (int number = 1; attempt_it({Fault::kills, number}).killed; ++number) {
    const std::string before = state(true);
    settle(scratch.folder());
    const std::string settled = state();
    ASSERT_TRUE(settled == "old" || settled == "new") << number << ' ' << settled;
    EXPECT_FALSE(last == "new" && settled == "old") << number;  // there is one call at which it is done
    last = settled;
    if (before == settled) continue;
    ++taken_back;
    for (int call = 1;; ++call) {
      ASSERT_TRUE(attempt_it({Fault::kills, number}).killed);
      if (!attempt({Fault::kills, call}, [this] { settle(scratch.folder()); }).killed) break;
      settle(scratch.folder());
      ASSERT_EQ(state(), "old") << number << ' ' << call;
    }
  }
  EXPECT_EQ(last, "new");
  EXPECT_GE(taken_back, 5);
}

}  // namespace
}  // namespace bookspin
