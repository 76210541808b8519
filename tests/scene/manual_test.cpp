// videos/README.md names every key of a script, every quantity, overlay and integrator.

#include <gtest/gtest.h>

#include "dynamics/integrators.h"
#include "scene/scene_file.h"
#include "scratch.h"

namespace bookspin {
namespace {

bool names(char before, std::string_view word, char after) {
  static const std::string manual = read_text(std::string(BOOKSPIN_SOURCE_DIR) + "/videos/README.md");
  std::string quoted(1, before);
  quoted.append(word).push_back(after);
  return manual.find(quoted) != std::string::npos;
}

TEST(Manual, NamesEveryQuantityAndOverlay) {
  for (const Quantity& q : quantities) EXPECT_TRUE(names('`', q.name, '`')) << q.name;
  for (const std::string_view name : overlay_names) EXPECT_TRUE(names('`', name, '`')) << name;
}

TEST(Manual, NamesEveryIntegrator) {
  for (const IntegratorInfo& integrator : integrators) {
    EXPECT_TRUE(names('`', integrator.name, '`')) << integrator.name;
  }
}

// The reader's own list of what is allowed, as its error for an unknown key gives it.
TEST(Manual, NamesEveryKey) {
  for (const char* script : {"title = 'T'\nnot_there = 1\n[[book]]\n", "title = 'T'\n[clip]\nnot_there = 1\n[[book]]\n",
                             "title = 'T'\n[view]\nnot_there = 1\n[[book]]\n", "title = 'T'\n[[book]]\nnot_there = 1\n",
                             "title = 'T'\n[[book]]\n[[expect]]\nquantity = 'tilt'\nat_most = 1\nnot_there = 1\n",
                             "title = 'T'\n[[book]]\n[[cue]]\nsays = 'S'\nframes = [0, 1]\nnot_there = 1\n"}) {
    std::string message;
    try {
      (void)parse_scene(script, "s.toml");
    } catch (const std::invalid_argument& error) {
      message = error.what();
    }
    const std::string before = "allowed here: ";
    ASSERT_NE(message.find(before), std::string::npos) << message;
    std::istringstream keys(message.substr(message.find(before) + before.size()));
    for (std::string key; std::getline(keys >> std::ws, key, ',');) {
      EXPECT_TRUE(names('`', key, '`') || names('[', key, ']')) << key;
    }
  }
}

}  // namespace
}  // namespace bookspin
