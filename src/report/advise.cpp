#include "report/advise.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "report/measure.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

constexpr long most_evaluations = 1'000'000;  // of a ladder, or of its first two rungs
constexpr int most_substeps = 1'000'000;      // that a script may ask for

double largest_error(const Scene& scene, const BookSetup& book, const std::stop_token& stop) {
  Scene alone = scene;
  alone.books = {book};
  const Trajectory trajectory = simulate(alone, stop);
  double largest = 0.0;
  for (const BookFrame& f : trajectory.books.front().frames) {
    if (!(f[Q::angle_error] <= largest)) largest = f[Q::angle_error];  // NaN, too, which is all that follows it
  }
  return std::isnan(largest) ? none : largest;
}

double ns_a_frame(const BookSetup& book, const Clip& clip) {
  const int frames = std::clamp(100'000 / clip.substeps, 1, clip.frames);
  const double h = clip.time_per_frame / clip.substeps;
  return std::visit(
      [&](const auto& start) {
        return least_ns(3,
                        [&] {
                          auto moved = start;
                          for (int n = 1; n <= frames; ++n) {
                            if constexpr (requires { moved.step(h); }) {
                              moved.step(h, clip.substeps);
                            } else {
                              moved.move_to(n * clip.time_per_frame);
                            }
                          }
                          asm volatile("" : : "g"(&moved) : "memory");  // else it is left out as unused
                        }) /
               frames;
      },
      make_book(book.method, book.options));
}

Candidate candidate(Scene scene, std::size_t i, const Solver& solver, double error, const std::stop_token& stop) {
  BookSetup book = scene.books[i];
  book.method = solver.method;
  book.options.integrator = solver.integrator;
  const bool stepped = solver.method != Method::exact;
  const int each = stepped ? evaluations_a_step(solver.integrator) : 1;
  Candidate best{solver, i};
  long spent = 0;
  for (const long steps : step_ladder(1.0, 1.0)) {
    const long work = steps * each * scene.clip.frames;
    if (steps > most_substeps || (steps > 2 && spent + work > most_evaluations)) break;
    spent += work;
    scene.clip.substeps = static_cast<int>(steps);
    const double found = largest_error(scene, book, stop);
    if (steps == 1 || found < best.error) best = {solver, i, scene.clip.substeps, found, steps * each, none};
    if (best.error <= error || !stepped) break;
  }
  scene.clip.substeps = best.substeps;
  best.ns = ns_a_frame(book, scene.clip);
  return best;
}

// That the same rigid motion is the exact one of both, and the same lines to be pasted.
bool share_a_start(const BookSetup& a, const BookSetup& b) {
  BookOptions options = a.options;
  options.integrator = b.options.integrator;
  options.damping = b.options.damping;
  options.stiffness = b.options.stiffness;
  options.particle_mass = b.options.particle_mass;
  return a.jiggle == b.jiggle && options == b.options;
}

}  // namespace

std::vector<Advice> advise(const Scene& scene, double error, const std::stop_token& stop) {
  std::vector<Advice> all;
  for (std::size_t i = 0; i < scene.books.size(); ++i) {
    const BookSetup& book = scene.books[i];
    const auto place = std::find_if(all.begin(), all.end(),
                                    [&](const Advice& a) { return share_a_start(scene.books[a.books.front()], book); });
    Advice& advice = place == all.end() ? all.emplace_back() : *place;
    const bool is_new = advice.books.empty();
    advice.books.push_back(i);
    advice.errors.push_back(largest_error(scene, book, stop));
    std::vector<Solver> solvers = is_new ? rigid_solvers() : std::vector<Solver>();
    if (const Solver own{book.method, book.options.integrator}; book.method == Method::springs) solvers.push_back(own);
    for (const Solver& solver : solvers) advice.candidates.push_back(candidate(scene, i, solver, error, stop));
  }
  for (Advice& advice : all) {
    std::stable_sort(advice.candidates.begin(), advice.candidates.end(), [&](const Candidate& a, const Candidate& b) {
      const auto rank = [&](const Candidate& c) {
        const bool within = c.error <= error;
        return std::tuple(!within, within ? c.evaluations : 0, c.error);
      };
      return rank(a) < rank(b);
    });
  }
  return all;
}

}  // namespace bookspin
