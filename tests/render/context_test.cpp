#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "poses.h"
#include "render/renderer.h"

namespace bookspin {
namespace {

TEST(Context, OsmesaAndEglDrawTheSameBytes) {
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
  EXPECT_EQ(from_osmesa.rgba, egl->draw(shot).rgba);
}

}  // namespace
}  // namespace bookspin
