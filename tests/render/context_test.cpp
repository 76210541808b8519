#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

#include "golden_test.h"
#include "image/compare.h"
#include "poses.h"
#include "render/renderer.h"
#include "tolerance.h"

namespace bookspin {
namespace {

// What draws, without the library through which it was reached: renderer and version.
std::string driver_of(const Renderer& renderer) {
  return renderer.description().substr(renderer.description().find(", "));
}

// A system may hold OSMesa of an older Mesa than EGL's (Ubuntu 26.04, 25.1 and 26.0: measured 1 level, mean 0.0012):
// then they are as near as goldens must be.
TEST(Context, OsmesaAndEglDrawTheSamePicture) {
  Shot shot = shot_of(book_at(28, 50, 8));
  shot.books.push_back({book_at(32, 60, 18), BookStyle::ghost});
  std::unique_ptr<Renderer> osmesa, egl;
  try {
    osmesa = std::make_unique<Renderer>(320, 180, assets(), ContextKind::osmesa);
    egl = std::make_unique<Renderer>(320, 180, assets(), ContextKind::egl);
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << "only one of the two is installed: " << error.what();
  }
  EXPECT_THAT(osmesa->description(), testing::StartsWith("OSMesa, llvmpipe"));
  EXPECT_THAT(egl->description(), testing::StartsWith("EGL, llvmpipe"));
  const Image from_osmesa = osmesa->draw(shot);
  const Image& from_egl = egl->draw(shot);
  if (driver_of(*osmesa) == driver_of(*egl)) {
    EXPECT_EQ(from_osmesa.rgba, from_egl.rgba);
    return;
  }
  const GoldenTolerance bound;
  const ImageDelta delta = compare(from_osmesa, from_egl, bound.threshold);
  EXPECT_TRUE(delta.same_size);
  EXPECT_LE(delta.max_delta, tolerance(bound.max_delta)) << osmesa->description() << ", " << egl->description();
  EXPECT_LE(delta.mean_delta, tolerance(bound.mean_delta));
  EXPECT_LE(delta.share_above, tolerance(bound.share));
}

}  // namespace
}  // namespace bookspin
