// The measuring of one run: its error at the samples, and the least time that it was seen to take.
//
// A run starts by start() and is carried from sample to sample by to(sample); it is repeated, and of every stretch
// between two samples (of the whole when that is short) the least time counts: what else the machine does in between
// does not. The clock is the steady one. A run that ends in non-finite numbers diverged; one whose step-size control
// gives up stalled.
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <string_view>
#include <vector>

namespace bookspin {

// Says what is being done, and what part of the whole is done.
using Tell = std::function<void(std::string_view what, double done)>;

// How much a report may spend.
struct Effort {
  double longest_run_ms = 100.0;  // of a work-precision ladder: it ends before the first run that would take longer
  int repeats = 3;                // of a run, at least; short ones are repeated more often
  double ladder = 1.0;            // 1: two rungs an octave; 2: every second one, and so on
  bool quick = false;             // the other parts: fewer and shorter
};

enum class Outcome { finished, diverged, stalled };

struct Run {
  std::string problem;
  std::string method;
  double setting = 0.0;  // the step h, or the tolerance of an adaptive method; 0: none
  double error = 0.0;    // largest over the samples; NaN unless finished
  double ns_per_time =
      0.0;  // nanoseconds for one unit of simulated time; of what was done before it diverged or stalled, too
  Outcome outcome = Outcome::finished;
};

inline double now_ns() {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// start() -> runner; runner.to(i) -> bool, carries it to sample i (0 ... samples - 1), false when it stalls;
// look(runner, i) -> bool, takes the errors into `run`, false when a number is not finite.
template <class Start, class Look>
void measure(Run& run, int samples, double T, const Effort& effort, Start&& start, Look&& look) {
  std::vector<double> least(static_cast<std::size_t>(samples), 1e300);
  double least_whole = 1e300;
  double spent = 0.0;
  for (int repeat = 0; repeat < effort.repeats || (spent < 0.05e6 * effort.longest_run_ms && repeat < 50); ++repeat) {
    const bool looks = repeat == 0;
    const bool stretches = looks || spent > 1e6 * repeat;  // else the reading of the clock would count
    const double begin = now_ns();
    double before = begin;
    auto runner = start();
    for (int i = 0; i < samples; ++i) {
      const bool carried = runner.to(i);
      if (stretches) {
        const double after = now_ns();
        auto& best = least[static_cast<std::size_t>(i)];
        best = std::min(best, after - before);
      }
      if (!carried || (looks && !look(runner, i))) {
        run.outcome = carried ? Outcome::diverged : Outcome::stalled;
        run.error = std::nan("");
        run.ns_per_time = std::accumulate(least.begin(), least.begin() + i + 1, 0.0) / (T * (i + 1) / samples);
        return;
      }
      if (stretches) before = now_ns();
    }
    const double whole = now_ns() - begin;
    spent += whole;
    if (!looks) least_whole = std::min(least_whole, whole);
  }
  run.ns_per_time = std::min(least_whole, std::accumulate(least.begin(), least.end(), 0.0)) / T;
}

// Runs at ever finer settings, rung 0, 1, 2, ...: until a run would take too long, or until rounding has long taken
// over.
template <class RunAt>
void climb(const Effort& effort, double T, std::vector<Run>& runs, RunAt&& run_at) {
  double best = 1e300;
  int worse = 0;
  int stalled = 0;  // in a row: the loosest tolerances of an adaptive method may do so
  double last_ms = 0.0;
  for (int rung = 0; rung < 80; ++rung) {
    Run run = run_at(rung);
    if (run.outcome != Outcome::stalled) last_ms = run.ns_per_time * T * 1e-6;
    if (run.outcome == Outcome::finished) {
      worse = run.error < 0.9 * best ? 0 : worse + 1;
      best = std::min(best, run.error);
    }
    stalled = run.outcome == Outcome::stalled ? stalled + 1 : 0;
    runs.push_back(std::move(run));
    if (stalled == 3 || (stalled > 0 && best < 1e-2) || (best < 1e-7 && worse >= 4) ||
        last_ms * std::pow(1.42, effort.ladder) > effort.longest_run_ms)
      break;
  }
}

// 1, 1.5, 2, 3, 4, 6, 8, ... : the rungs of a ladder of steps.
inline double rung_factor(int rung, double ladder) {
  const int r = static_cast<int>(std::lround(rung * ladder));
  return std::ldexp(r % 2 == 0 ? 1.0 : 1.5, r / 2);
}

}  // namespace bookspin
