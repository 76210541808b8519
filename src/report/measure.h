// The measuring of one run: its error at the samples, its work, and the least CPU time that it was seen to take.
//
// A runner is carried from sample to sample by to(sample), 0 ... samples - 1, which is false when it stalls; `state` is
// where it is, `evaluations` counts those of the right-hand side. The first pass takes the errors, further passes the
// time. What is measured, and where a ladder of runs ends, is decided by evaluations, never by a clock: a slow or busy
// machine finds the same runs and the same errors.
#pragma once

#include <algorithm>
#include <cmath>
#include <ctime>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "report/runs.h"
#include "scene/any_book.h"

namespace bookspin {

// How much a report may spend.
struct Effort {
  long most_evaluations = 3'000'000;  // of a ladder, all runs together
  int repeats = 3;                    // of a run for its time, at least,
  long timed = 50'000;                // and so many more that a short one is timed over as many evaluations
  double ladder = 1.0;                // 1: two rungs an octave; 2: every second one, and so on
  bool quick = false;                 // the other parts: fewer and shorter
};

struct Course {
  int samples;
  double T;             // the last sample's time
  double fewest = 1.0;  // steps a sample, of the coarsest run
  [[nodiscard]] double interval() const { return T / samples; }
};

// A book about its middle axis, kicked: L_B = L (1, kick, kick / 2).
inline BookOptions kicked(double L, double kick, BookOptions options = {}) {
  options.omega_W = (L * Eigen::Vector3d(1.0, kick, 0.5 * kick)).cwiseQuotient(body_of(options).I_B);
  return options;
}

inline double cpu_ns() {  // of the process so far
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

// Where between `low` and `high` holds(x) ceases to be true.
template <class Holds>
[[nodiscard]] double bisect(double low, double high, int halvings, Holds&& holds) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(middle) ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// CPU nanoseconds of work(), the least of `passes`.
template <class Work>
double least_ns(int passes, Work&& work) {
  double least = none;
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_ns();
    work();
    least = std::min(least, cpu_ns() - start);
  }
  return least;
}

// start() -> runner; error(state, sample), of which the largest counts: one that is not below 1000 is that of a run
// which diverged.
template <class Start, class Error>
[[nodiscard]] Run measure(double setting, const Course& course, const Effort& effort, Start&& start, Error&& error) {
  Run run{setting, 0.0};
  const double begin = cpu_ns();
  auto runner = start();
  for (int i = 0; i < course.samples && run.outcome == Outcome::finished; ++i) {
    if (!runner.to(i)) {
      run.outcome = Outcome::stalled;
    } else if (const double e = error(runner.state, i); e < 1e3) {
      run.error = std::max(run.error, e);
    } else {
      run.outcome = Outcome::diverged;
    }
    if (run.outcome != Outcome::finished) {
      run.error = none;
      run.ns_per_time = (cpu_ns() - begin) / ((i + 1) * course.interval());
    }
  }
  run.evaluations = runner.evaluations;
  if (run.outcome != Outcome::finished) return run;
  // A short run is timed several times in one go, so that reading the clock does not count.
  const long evaluations = std::max(run.evaluations, 1L);
  const long together = std::max(1L, std::min(effort.timed, 2000L) / evaluations);
  const int repeats = std::max(effort.repeats, static_cast<int>(std::min(20L, effort.timed / evaluations)));
  const auto pass = [&] {
    for (long n = 0; n < together; ++n) {
      auto timed = start();
      for (int i = 0; i < course.samples; ++i) (void)timed.to(i);
      asm volatile("" : : "g"(&timed.state) : "memory");  // else it is left out as unused
    }
  };
  run.ns_per_time = least_ns(repeats, pass) / (course.T * static_cast<double>(together));
  return run;
}

// A book carried from sample to sample by equal steps.
template <class Book>
struct Stepped {
  Book state;
  double h;
  long steps;  // from one sample to the next
  int evaluations_a_step;
  long evaluations = 0;

  bool to(int /*sample*/) {
    state.step(h, steps);
    evaluations += steps * evaluations_a_step;
    return true;
  }
};

// Runs at ever finer settings: until the next run would pass the limit of work, or until rounding has long taken over.
template <class Settings, class RunAt>
[[nodiscard]] std::vector<Run> climb(const Effort& effort, const Settings& settings, RunAt&& run_at) {
  std::vector<Run> runs;
  double best = none;
  int worse = 0;
  int stalled = 0;  // in a row: the loosest tolerances of an adaptive method may do so
  double spent = 0.0;
  for (const auto setting : settings) {
    const Run& run = runs.emplace_back(run_at(setting));
    const auto last = static_cast<double>(run.evaluations);
    spent += last;
    if (run.outcome == Outcome::finished) {
      worse = run.error < 0.9 * best ? 0 : worse + 1;
      best = std::min(best, run.error);
    }
    stalled = run.outcome == Outcome::stalled ? stalled + 1 : 0;
    if (stalled == 3 || (stalled > 0 && best < 1e-2) || (best < 1e-7 && worse >= 4) ||
        spent + last * std::pow(1.42, effort.ladder) > static_cast<double>(effort.most_evaluations))
      break;
  }
  return runs;
}

// Numbers of steps: fewest times 1, 1.5, 2, 3, 4, 6, 8, ..., each once.
inline std::vector<long> step_ladder(double fewest, double ladder) {
  std::vector<long> steps;
  for (int rung = 0; rung < 80; ++rung) {
    const int r = static_cast<int>(std::lround(rung * ladder));
    const long n = std::lround(fewest * std::ldexp(r % 2 == 0 ? 1.0 : 1.5, std::min(r, 80) / 2));
    if (steps.empty() || n > steps.back()) steps.push_back(n);
  }
  return steps;
}

// The ladder of what is stepped: `book` is copied for each run.
template <class Book, class Error>
[[nodiscard]] std::vector<Run> climb_steps(const Book& book, int evaluations_a_step, const Course& course,
                                           const Effort& effort, Error&& error) {
  return climb(effort, step_ladder(course.fewest, effort.ladder), [&](long steps) {
    const double h = course.interval() / static_cast<double>(steps);
    const auto start = [&] { return Stepped<Book>{book, h, steps, evaluations_a_step}; };
    return measure(h, course, effort, start, error);
  });
}

// visit(book) for the solver's book of these options, when it is one that is stepped.
template <class Visit>
void visit_stepped(const Solver& solver, const BookOptions& options, Visit&& visit) {
  std::visit(
      [&](const auto& book) {
        if constexpr (requires(std::decay_t<decltype(book)> b) { b.step(1.0); }) visit(book);
      },
      make_book(solver.method, options_for(solver, options)));
}

// The ladders of these solvers, each a book of the program.
template <class Error>
void climb_all(const std::vector<Solver>& solvers, const BookOptions& options, const Course& course,
               const Effort& effort, Ladders& ladders, Error&& error) {
  for (const Solver& solver : solvers) {
    visit_stepped(solver, options, [&](const auto& book) {
      ladders.push_back({solver, climb_steps(book, evaluations_a_step(solver.integrator), course, effort, error)});
    });
  }
}

}  // namespace bookspin
