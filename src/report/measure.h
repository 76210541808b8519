// The measuring of one run: its error at the samples, its work, and the least CPU time that it was seen to take.
//
// A run starts by start() and is carried from sample to sample by to(sample); the first pass takes the errors, further
// passes the time. What is measured, and where a ladder of runs ends, is decided by evaluations of the right-hand side,
// never by a clock: a slow or busy machine finds the same runs and the same errors. A run that ends in non-finite
// numbers diverged; one whose step-size control gives up stalled.
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
  double T;  // the last sample's time
  [[nodiscard]] double interval() const { return T / samples; }
};

inline double cpu_ns() {  // of the process so far
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return 1e9 * static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec);
}

// CPU nanoseconds of work(), the least of `passes`.
template <class Work>
double least_ns(int passes, Work&& work) {
  double least = 1e300;
  for (int pass = 0; pass < passes; ++pass) {
    const double start = cpu_ns();
    work();
    least = std::min(least, cpu_ns() - start);
  }
  return least;
}

// start() -> runner; runner.to(i) -> bool, carries it to sample i (0 ... samples - 1), false when it stalls;
// runner.state(); runner.evaluations(); error(state, i), of which the largest counts: one that is not below 1000 is that
// of a run that diverged.
template <class Start, class Error>
[[nodiscard]] Run measure(Run run, const Course& course, const Effort& effort, Start&& start, Error&& error) {
  const double begin = cpu_ns();
  auto runner = start();
  for (int i = 0; i < course.samples && run.outcome == Outcome::finished; ++i) {
    if (!runner.to(i)) {
      run.outcome = Outcome::stalled;
    } else if (const double e = error(runner.state(), i); e < 1e3) {
      run.error = std::max(run.error, e);
    } else {
      run.outcome = Outcome::diverged;
    }
    if (run.outcome != Outcome::finished) run.ns_per_time = (cpu_ns() - begin) / ((i + 1) * course.interval());
  }
  run.evaluations = runner.evaluations();
  if (run.outcome != Outcome::finished) {
    run.error = std::nan("");
    return run;
  }
  // A short run is timed several times in one go, so that reading the clock does not count.
  const long evaluations = std::max(run.evaluations, 1L);
  const long together = std::max(1L, std::min(effort.timed, 2000L) / evaluations);
  const int repeats = std::max(effort.repeats, static_cast<int>(std::min(20L, effort.timed / evaluations)));
  run.ns_per_time = least_ns(repeats,
                             [&] {
                               for (long n = 0; n < together; ++n) {
                                 auto timed = start();
                                 for (int i = 0; i < course.samples; ++i) (void)timed.to(i);
                                 asm volatile("" : : "g"(&timed.state()) : "memory");  // else it is left out as unused
                               }
                             }) /
                    (course.T * static_cast<double>(together));
  return run;
}

// A book carried from sample to sample by equal steps.
template <class Book>
class Stepped {
 public:
  Stepped(Book book, Integrator integrator, double interval, long steps)
      : book_(std::move(book)), integrator_(integrator), h_(interval / static_cast<double>(steps)), steps_(steps) {}
  bool to(int /*sample*/) {
    for (long i = 0; i < steps_; ++i) book_.step(h_);
    taken_ += steps_;
    return true;
  }
  [[nodiscard]] const Book& state() const { return book_; }
  [[nodiscard]] long evaluations() const { return taken_ * evaluations_a_step(integrator_); }

 private:
  Book book_;
  Integrator integrator_;
  double h_;
  long steps_;
  long taken_ = 0;
};

// Runs at ever finer settings: until the next run would pass the limit of work, or until rounding has long taken over.
template <class Settings, class RunAt>
void climb(const Effort& effort, const Settings& settings, Runs& runs, RunAt&& run_at) {
  double best = 1e300;
  int worse = 0;
  int stalled = 0;  // in a row: the loosest tolerances of an adaptive method may do so
  double spent = 0.0;
  for (const auto setting : settings) {
    Run run = run_at(setting);
    const auto last = static_cast<double>(run.evaluations);
    spent += last;
    if (run.outcome == Outcome::finished) {
      worse = run.error < 0.9 * best ? 0 : worse + 1;
      best = std::min(best, run.error);
    }
    stalled = run.outcome == Outcome::stalled ? stalled + 1 : 0;
    runs.push_back(std::move(run));
    if (stalled == 3 || (stalled > 0 && best < 1e-2) || (best < 1e-7 && worse >= 4) ||
        spent + last * std::pow(1.42, effort.ladder) > static_cast<double>(effort.most_evaluations))
      break;
  }
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

// Tolerances of adaptive methods: 0.1, 0.03, 0.01, ... 1e-16.
inline std::vector<double> tolerance_ladder(double ladder) {
  std::vector<double> tolerances;
  for (double decades = 1.0; decades <= 16.0; decades += 0.5 * ladder) tolerances.push_back(std::pow(10.0, -decades));
  return tolerances;
}

// The ladder of a solver that is a book of the program, stepped through the course by `fewest` steps a sample and more.
template <class Error>
void climb_steps(Problem problem, const Solver& solver, const BookOptions& options, const Course& course, double fewest,
                 const Effort& effort, Runs& runs, Error&& error) {
  const BookOptions with = options_for(solver, options);
  std::visit(
      [&](const auto& book) {
        if constexpr (requires(std::decay_t<decltype(book)> b) { b.step(1.0); }) {
          climb(effort, step_ladder(fewest, effort.ladder), runs, [&](long steps) {
            return measure(
                {problem, solver, course.interval() / static_cast<double>(steps)}, course, effort,
                [&] { return Stepped(book, with.integrator, course.interval(), steps); }, error);
          });
        }
      },
      make_book(solver.method, with));
}

}  // namespace bookspin
