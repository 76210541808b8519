// The runs of all work-precision ladders, and what is asked of them.
//
// A run is known by its problem, its solver and its setting. Only a finished run has an error: the error of one that
// diverged or stalled is NaN, which no comparison with an error asked for meets, so that all queries see finished runs
// alone. A query that no run answers gives a null pointer or NaN.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "report/table.h"
#include "scene/scene.h"

namespace bookspin {

enum class Problem { case_a, case_b, case_c, case_d, springs, soft_springs, stiff_springs };
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
// The solver's integrator; springs undamped and not normalized, but the paper's.
[[nodiscard]] BookOptions options_for(const Solver& solver, BookOptions options);
[[nodiscard]] int evaluations_a_step(Integrator integrator);  // of the right-hand side, or of what stands for it

enum class Outcome { finished, diverged, stalled };

struct Run {
  Problem problem{};
  Solver solver{};
  double setting = 0.0;      // the step h, or the tolerance of an adaptive method; 0: none
  double error = 0.0;        // largest over the samples; NaN unless finished
  double ns_per_time = 0.0;  // CPU nanoseconds for one unit of simulated time, of what was done before a bad end, too
  long evaluations = 0;      // of the right-hand side
  Outcome outcome = Outcome::finished;
};
using Runs = std::vector<Run>;

inline constexpr std::array asked_errors{1e-2, 1e-4, 1e-6, 1e-9};

[[nodiscard]] std::vector<Solver> solvers_of(const Runs& runs, Problem problem);  // in the order of the runs
[[nodiscard]] const Run* nearest_run(const Runs& runs, Problem problem, const Solver& solver);   // the least error
[[nodiscard]] const Run* finest_run(const Runs& runs, Problem problem, const Solver& solver);    // the last finished
[[nodiscard]] const Run* coarsest_run(const Runs& runs, Problem problem, const Solver& solver);  // the first finished
[[nodiscard]] const Run* cheapest_run(const Runs& runs, Problem problem, const Solver& solver, double error);
[[nodiscard]] const Run* run_near(const Runs& runs, Problem problem, const Solver& solver, double setting);
[[nodiscard]] double best_error(const Runs& runs, Problem problem, const Solver& solver);
[[nodiscard]] double least_cost(const Runs& runs, Problem problem, const Solver& solver, double error);
// Of all solvers but the exact one.
[[nodiscard]] const Run* nearest_stepper(const Runs& runs, Problem problem);

// The cheapest run of all for each asked error: {error, name, ns}; `stepping`: without the exact solver.
[[nodiscard]] nlohmann::json winners(const Runs& runs, Problem problem, bool stepping);

// For each solver of a problem the cost of each asked error, "never" when no run reaches it.
[[nodiscard]] Table cheapest_table(const Runs& runs, Problem problem);
[[nodiscard]] Table runs_table(const Runs& runs);

}  // namespace bookspin
