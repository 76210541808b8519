#include "image/rect.h"

#include <gtest/gtest.h>

namespace bookspin {
namespace {

TEST(Rect, IntersectionAndUnion) {
  const Rect a{0, 0, 10, 10}, b{5, 8, 10, 10}, apart{20, 20, 2, 2};
  EXPECT_EQ(intersection(a, b), (Rect{5, 8, 5, 2}));
  EXPECT_TRUE(intersection(a, apart).empty());
  EXPECT_EQ(union_of(a, b), (Rect{0, 0, 15, 18}));
  EXPECT_EQ(union_of(a, Rect{}), a);
  EXPECT_EQ(union_of(Rect{}, a), a);
}

}  // namespace
}  // namespace bookspin
