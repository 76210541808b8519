// Advice: what it recommends keeps its promise in the film, and the step before does not.

#include "report/advise.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

constexpr const char* two_books = R"(title = "T"
clip = { frames = 60, time_per_frame = 2.0, substeps = 3 }
[[book]]
method = "matrix"
angular_velocity = [0.115, 1e-3, 0]
[[book]]
method = "springs"
angular_velocity = [0.115, 1e-3, 0]
)";

double error_of(Scene scene, const Candidate& c) {
  BookSetup book = scene.books[c.book];
  book.method = c.solver.method;
  book.options.integrator = c.solver.integrator;
  scene.books = {book};
  scene.clip.substeps = c.substeps;
  const Trajectory trajectory = simulate(scene);
  double largest = 0.0;
  for (const BookFrame& f : trajectory.books[0].frames) largest = std::max(largest, f[Q::angle_error]);
  return largest;
}

const Candidate& of(const Advice& advice, const Solver& solver) {
  const auto found = std::find_if(advice.candidates.begin(), advice.candidates.end(),
                                  [&](const Candidate& c) { return c.solver == solver; });
  EXPECT_NE(found, advice.candidates.end());
  return *found;
}

TEST(Advise, WhatIsWithinTheErrorIsSoInTheFilmAndTakesAsFewStepsAsItCan) {
  const Scene scene = parse_scene(two_books, "s.toml");
  int fewest = 0;
  for (const double error : {1e-3, 1e-9}) {
    const Advice advice = advise(scene, error).front();
    EXPECT_EQ(advice.candidates.front().solver, exact_solver);
    for (const Candidate& c : advice.candidates) {
      EXPECT_EQ(c.error, error_of(scene, c)) << name_of(c.solver);
      EXPECT_GT(c.ns, 0.0);
      if (c.error > error || c.substeps == 1) continue;
      Candidate coarser = c;
      coarser.substeps = c.substeps * 2 / 3;
      EXPECT_GT(error_of(scene, coarser), error) << name_of(c.solver);
    }
    const Candidate rk4 = of(advice, {Method::quaternion, Integrator::rk4});
    EXPECT_LE(rk4.error, error);
    EXPECT_GT(rk4.substeps, fewest);  // 1, then 4: a smaller error takes more
    fewest = rk4.substeps;
  }
}

TEST(Advise, BooksWithOneStartShareItAndSpringsReachNoSmallError) {
  const Scene scene = parse_scene(two_books, "s.toml");
  const std::vector<Advice> together = advise(scene, 1e-6);
  ASSERT_EQ(together.size(), 1U);
  for (std::size_t i = 1; i < together[0].candidates.size(); ++i) {  // by counts alone: always in this order
    const Candidate& c = together[0].candidates[i];
    const Candidate& before = together[0].candidates[i - 1];
    EXPECT_TRUE(c.error <= 1e-6 ? before.evaluations <= c.evaluations : before.error <= c.error);
  }
  EXPECT_EQ(together[0].books, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(together[0].errors[0], error_of(scene, {{Method::matrix}, 0, 3}));
  const Candidate springs = of(together[0], {Method::springs});
  EXPECT_EQ(springs.book, 1U);
  EXPECT_GT(springs.error, 1e-6);  // measured 2e-3: the model's
  Scene apart = scene;
  apart.books[1].options.omega_W.y() = 0.0;
  EXPECT_EQ(advise(apart, 1e-2).size(), 2U);
}

TEST(Advise, ABookThatExplodesIsNoAdvice) {
  const Scene scene = parse_scene(R"(title = "T"
clip = { frames = 2000, time_per_frame = 0.5, substeps = 1 }
[[book]]
method = "springs"
normalize = false
angular_velocity = [0.7, 0, 0]
)",
                                  "s.toml");
  const Advice advice = advise(scene, 0.1).front();
  EXPECT_EQ(advice.errors[0], none);
  EXPECT_EQ(advice.candidates.front().solver, exact_solver);
}

}  // namespace
}  // namespace bookspin
