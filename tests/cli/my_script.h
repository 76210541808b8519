// A folder with a script of one's own, and the program run in it.
#pragma once

#include <gtest/gtest.h>

#include "cli/command.h"

namespace bookspin {

inline const std::string bookspin = std::string(BOOKSPIN_BINARY_DIR) + "/bookspin ";
inline const std::string videos = std::string(BOOKSPIN_SOURCE_DIR) + "/videos/";

inline constexpr const char* good_script = R"(title = "Mine"
[clip]
frames = 12
[[book]]
method = "springs"
angular_velocity = [0.115, 0, 0]
jiggle = 0.01
[[expect]]
says = "it keeps its shape"
quantity = "stretch"
at_most = 0.01
)";

struct Cli : testing::Test {
  Cli() { write_text(scratch / "mine.toml", good_script); }
  Said operator()(const std::string& arguments) { return run(scratch, bookspin + arguments); }
  Scratch scratch;
};

}  // namespace bookspin
