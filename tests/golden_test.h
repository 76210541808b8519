// Golden frames: pictures that a person has looked at and accepted, in tests/golden/<room>/<name>.png.
//
// expect_golden fails when the golden is missing or the picture is further from it than software renderers are from one
// another. Then the actual picture and what differs lie in the build tree under golden/<room>/, and the message says
// how to accept. run_tests_with_goldens is such a test program's main: when all its tests have run it also fails on a
// golden that no test owns and on two goldens that match each other. With BOOKSPIN_ACCEPT_GOLDENS=1 in the environment
// the goldens are written (and those that no test owns removed) instead of compared.
#pragma once

#include <string>

#include "image/image.h"

namespace bookspin {

struct GoldenTolerance {
  int max_delta = 16;       // levels; llvmpipe held to SSE2: measured up to 3
  double mean_delta = 0.4;  // levels; held to SSE2: measured up to 0.19
  int threshold = 8;        // levels; a pixel further off counts as failing
  double share = 0.0005;    // of failing pixels that is still the same picture
};

void expect_golden(const Image& actual, const std::string& room, const std::string& name,
                   GoldenTolerance tolerance = {});
int run_tests_with_goldens(int argc, char** argv, const std::string& room);

}  // namespace bookspin
