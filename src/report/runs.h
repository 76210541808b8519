// The runs of all work-precision ladders, and what is asked of them.
//
// A ladder holds the runs of one solver at one problem, the coarsest first. Only a finished run has an error: that of one
// that diverged or stalled is infinite, so that no query finds it. What no run answers is `no_run`, infinite in all: a
// dash on the page, an empty cell, a point left out.
#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/table.h"
#include "scene/scene.h"

namespace bookspin {

enum class Problem { case_a, case_b, case_c, case_d, springs };
enum class Odeint { rk4, dopri5, fehlberg78, bulirsch_stoer };

struct Solver {
  Method method;
  Integrator integrator = Integrator::explicit_euler;
  std::optional<Odeint> odeint{};  // Boost.Odeint's method in place of the program's
  bool as_in_the_paper = false;    // springs: damped and normalized; else they are neither
  bool operator==(const Solver&) const = default;
};

inline constexpr Solver exact_solver{Method::exact};
inline constexpr Solver papers_springs{Method::springs, Integrator::explicit_euler, {}, true};

[[nodiscard]] std::string name_of(const Solver& solver);
[[nodiscard]] std::vector<Solver> rigid_solvers();   // the exact one, and all that the table of integrators has
[[nodiscard]] std::vector<Solver> spring_solvers();  // undamped
[[nodiscard]] std::vector<Solver> odeint_solvers(Method method);
// All rigid ones, the paper's springs, and undamped springs by everything better, with names that tell them apart.
[[nodiscard]] std::vector<Solver> contenders();
[[nodiscard]] std::string title_of(const Solver& solver);
// The solver's integrator; springs undamped and not normalized, but the paper's.
[[nodiscard]] BookOptions options_for(const Solver& solver, BookOptions options);

[[nodiscard]] int evaluations_a_step(Integrator integrator);  // of the right-hand side, or of what stands for it

enum class Outcome { finished, diverged, stalled };

inline constexpr double none = std::numeric_limits<double>::infinity();

struct Run {
  double setting = none;      // the step h, or the tolerance of an adaptive method; 0: of a motion in closed form
  double error = none;        // largest over the samples
  double ns_per_time = none;  // CPU nanoseconds for one unit of simulated time, of what was done before a bad end, too
  long evaluations = 0;       // of the right-hand side
  Outcome outcome = Outcome::finished;
};
inline constexpr Run no_run{};

struct Ladder {
  Solver solver;
  std::vector<Run> runs;

  // The finished run of which key(run) is least.
  template <class Key>
  [[nodiscard]] Run least(Key&& key) const {
    const Run* best = &no_run;
    for (const Run& run : runs) {
      if (run.error < none && (best == &no_run || std::invoke(key, run) < std::invoke(key, *best))) best = &run;
    }
    return *best;
  }
  [[nodiscard]] Run nearest() const { return least(&Run::error); }
  [[nodiscard]] Run finest() const { return least(&Run::setting); }
  [[nodiscard]] Run closest(double setting) const {  // by ratio
    return least([setting](const Run& run) { return std::abs(std::log(run.setting / setting)); });
  }
  [[nodiscard]] Run cheapest(double error) const {  // that is no farther off
    const Run run = least([error](const Run& r) { return r.error <= error ? r.ns_per_time : none; });
    return run.error <= error ? run : no_run;
  }
};
using Ladders = std::vector<Ladder>;  // of one problem
using Runs = std::map<Problem, Ladders>;

[[nodiscard]] const Ladder& ladder(const Ladders& ladders, const Solver& solver);  // an empty one when there is none

struct Best {
  Solver solver = exact_solver;
  Run run = no_run;
};
[[nodiscard]] Best nearest_stepper(const Ladders& ladders);  // of all solvers but the exact one

// The cheapest run of all for each error asked for: {error, name, ns}; `stepping`: without the exact solver.
[[nodiscard]] nlohmann::json winners(const Ladders& ladders, bool stepping);

// For each solver the cost of each error asked for, "never" when no run reaches it.
[[nodiscard]] Table cheapest_table(const Ladders& ladders);
[[nodiscard]] Table runs_table(const Runs& runs);

}  // namespace bookspin
