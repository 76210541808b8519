#include "golden_test.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <vector>

#include "image/compare.h"
#include "image/png.h"
#include "tolerance.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

fs::path golden_folder(const std::string& room) {
  return fs::path(BOOKSPIN_SOURCE_DIR) / "tests" / "golden" / room;
}
fs::path failure_folder(const std::string& room) {
  return fs::path(BOOKSPIN_BINARY_DIR) / "golden" / room;
}

bool accepting() {
  const char* value = std::getenv("BOOKSPIN_ACCEPT_GOLDENS");
  return value != nullptr && std::string(value) == "1";
}

std::string how_to_accept() {
  return std::string("  To accept the new picture, after looking at it:  make -C ") + BOOKSPIN_SOURCE_DIR + " golden";
}

// The goldens that this program's tests asked for, each with its test: filled by expect_golden, read when the program
// ends.
std::map<std::string, std::string>& owners() {
  static std::map<std::string, std::string> owners_by_name;
  return owners_by_name;
}

std::string current_test() {
  const testing::TestInfo* const info = testing::UnitTest::GetInstance()->current_test_info();
  return info == nullptr ? "" : std::string(info->test_suite_name()) + "." + info->name();
}

bool matches(const ImageDelta& delta, const GoldenTolerance& allowed) {
  return delta.same_size && delta.max_delta <= tolerance(allowed.max_delta) &&
         delta.mean_delta <= tolerance(allowed.mean_delta) && delta.share_above <= tolerance(allowed.share);
}

class GoldenFolderCheck : public testing::Environment {
 public:
  explicit GoldenFolderCheck(std::string room) : room_(std::move(room)) {}

  void TearDown() override {
    const bool whole_program = testing::GTEST_FLAG(filter) == "*" && std::getenv("GTEST_TOTAL_SHARDS") == nullptr;
    if (!whole_program || !fs::exists(golden_folder(room_))) return;
    std::vector<fs::path> goldens;
    for (const auto& entry : fs::directory_iterator(golden_folder(room_))) {
      if (owners().contains(entry.path().stem().string())) {
        goldens.push_back(entry.path());
      } else if (accepting()) {
        fs::remove(entry.path());
      } else {
        ADD_FAILURE() << entry.path().string() << ": no test owns this golden; 'make golden' removes it";
      }
    }
    expect_all_different(goldens);
  }

 private:
  static void expect_all_different(const std::vector<fs::path>& goldens) {
    std::vector<Image> images;
    images.reserve(goldens.size());
    for (const auto& golden : goldens) images.push_back(read_png(golden));
    const GoldenTolerance tolerance;
    for (std::size_t i = 0; i < images.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(matches(compare(images[i], images[j], tolerance.threshold), tolerance))
            << goldens[i].string() << " and " << goldens[j].string()
            << " show the same picture: one of them tests nothing";
      }
    }
  }

  std::string room_;
};

}  // namespace

void expect_golden(const Image& actual, const std::string& room, const std::string& name, GoldenTolerance tolerance) {
  EXPECT_EQ(owners().emplace(name, current_test()).first->second, current_test())
      << "two tests own the golden " << name;
  const fs::path golden = golden_folder(room) / (name + ".png");
  if (accepting()) {
    if (!fs::exists(golden) || !matches(compare(read_png(golden), actual, tolerance.threshold), tolerance)) {
      fs::create_directories(golden.parent_path());
      write_png(golden, actual);
    }
    return;
  }

  const fs::path actual_path = failure_folder(room) / (name + ".png");
  const fs::path delta_path = failure_folder(room) / (name + ".delta.png");
  const auto keep_actual = [&] {
    fs::create_directories(actual_path.parent_path());
    write_png(actual_path, actual);
  };
  if (!fs::exists(golden)) {
    keep_actual();
    ADD_FAILURE() << golden.string() << ": golden missing\n  actual: " << actual_path.string() << '\n'
                  << how_to_accept();
    return;
  }
  const Image expected = read_png(golden);
  const ImageDelta delta = compare(expected, actual, tolerance.threshold);
  if (matches(delta, tolerance)) {
    fs::remove(actual_path);
    fs::remove(delta_path);
    return;
  }
  keep_actual();
  if (!delta.same_size) {
    ADD_FAILURE() << golden.string() << ": golden is " << expected.width << "x" << expected.height << ", the picture "
                  << actual.width << "x" << actual.height << "\n  actual: " << actual_path.string() << '\n'
                  << how_to_accept();
    return;
  }
  write_png(delta_path, delta_picture(expected, actual));
  ADD_FAILURE() << golden.string() << ": picture differs: max delta " << delta.max_delta << " (allowed "
                << tolerance.max_delta << "), mean " << delta.mean_delta << " (allowed " << tolerance.mean_delta
                << "), share of pixels beyond " << tolerance.threshold << " levels " << delta.share_above
                << " (allowed " << tolerance.share << "); worst, golden and picture:\n"
                << worst_pixels(expected, actual, 10) << "  actual: " << actual_path.string()
                << "\n  delta:  " << delta_path.string() << '\n'
                << how_to_accept();
}

int run_tests_with_goldens(int argc, char** argv, const std::string& room) {
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new GoldenFolderCheck(room));  // GoogleTest deletes it
  return RUN_ALL_TESTS();
}

}  // namespace bookspin
