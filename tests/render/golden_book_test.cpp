#include <gtest/gtest.h>

#include "golden_test.h"
#include "poses.h"
#include "render/renderer.h"

namespace bookspin {
namespace {

void expect_shot(const Shot& shot, const std::string& name) {
  Renderer renderer(480, 270, assets());
  expect_golden(renderer.draw(shot), "render", name);
}

TEST(GoldenBook, Front) {
  expect_shot(shot_of(book_at(0, 0, 0)), "book_front");
}
TEST(GoldenBook, Back) {
  expect_shot(shot_of(book_at(0, 180, 0)), "book_back");
}
TEST(GoldenBook, SpineAndTop) {
  expect_shot(shot_of(book_at(28, 50, 8)), "book_spine_and_top");
}
TEST(GoldenBook, PageEdges) {
  expect_shot(shot_of(book_at(40, -55, -15)), "book_page_edges");
}
TEST(GoldenBook, FromBelow) {
  expect_shot(shot_of(book_at(-55, 150, 20)), "book_bottom_and_back");
}

TEST(GoldenBook, Sheared) {
  Corners corners_W = book_at(20, 35, 0);
  Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
  shear(0, 1) = 0.35;
  shear(1, 2) = -0.5;
  corners_W = 0.85 * shear * corners_W;
  expect_shot(shot_of(corners_W), "book_sheared");
}

TEST(GoldenBook, Twisted) {  // the top turned against the bottom: no affine image of a book, its faces bend
  const Corners bottom_W = book_at(0, -30, 0), top_W = book_at(0, 55, 0);
  Corners corners_W = bottom_W;
  for (const int i : {2, 3, 6, 7}) corners_W.col(i) = top_W.col(i);
  expect_shot(shot_of(corners_W), "book_twisted");
}

TEST(GoldenBook, TurnedInsideOut) {
  Corners corners_W = book_at(28, 50, 8);
  corners_W.row(0) *= -1;
  expect_shot(shot_of(corners_W), "book_inside_out");
}

TEST(GoldenBook, GhostOverSolid) {
  Shot shot = shot_of(book_at(20, 30, 5));
  shot.books.push_back({book_at(32, 50, 18), BookStyle::ghost});
  expect_shot(shot, "ghost_over_solid");
}

TEST(GoldenBook, GhostBehindAndAlone) {
  Shot shot = shot_of(book_at(20, 30, 5, {-0.8, 0, 0.5}));
  shot.books.push_back({book_at(10, -30, -12, {0.6, 0, -1}), BookStyle::ghost});
  expect_shot(shot, "ghost_behind");
}

// What of a ghost is behind a book is hidden, but for its edges, which shine through.
TEST(GoldenBook, GhostHalfHidden) {
  Shot shot = shot_of(book_at(20, 30, 5));
  shot.books.push_back({book_at(30, -20, 20, {0.5, 0.3, -0.6}), BookStyle::ghost});
  expect_shot(shot, "ghost_half_hidden");
}

// Ghosts of the orientation alone show that a book has grown.
TEST(GoldenBook, GhostInAGrownBook) {
  Shot shot = shot_of(1.2 * book_at(20, 30, 5));
  shot.books.push_back({book_at(20, 30, 5), BookStyle::ghost});
  expect_shot(shot, "ghost_in_a_grown_book");
}

TEST(GoldenBook, OneHidesAnotherByDepth) {
  Shot shot = shot_of(book_at(20, 30, 5, {-0.6, 0, 0}));
  shot.books.push_back({book_at(10, 200, 25, {0.9, 0, 0.3}), BookStyle::solid});
  expect_shot(shot, "books_through_each_other");
}

}  // namespace
}  // namespace bookspin
