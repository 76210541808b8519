#include "report/runs.h"

#include <algorithm>
#include <cmath>

#include "scene/any_book.h"

namespace bookspin {
namespace {

constexpr std::array<std::string_view, 7> problem_names{"case a",
                                                        "case b",
                                                        "case c",
                                                        "case d",
                                                        "springs",
                                                        "springs against rigid, k = 10",
                                                        "springs against rigid, k = 1000"};
constexpr std::array<std::string_view, 4> odeint_names{"rk4", "dopri5", "fehlberg78", "bulirsch_stoer"};
constexpr std::array<std::string_view, 3> outcome_names{"finished", "diverged", "stalled"};

template <class Names, class Id>
std::string text_of(const Names& names, Id id) {
  return std::string(names.at(static_cast<std::size_t>(id)));
}

// Of the finished runs of a problem and solver the one that `better(run, best)` prefers to all before it.
template <class Better>
const Run* choose(const Runs& runs, Problem problem, const Solver& solver, Better&& better) {
  const Run* best = nullptr;
  for (const Run& run : runs) {
    if (run.problem == problem && run.solver == solver && run.outcome == Outcome::finished &&
        (best == nullptr || better(run, *best)))
      best = &run;
  }
  return best;
}

}  // namespace

std::string name_of(const Solver& solver) {
  if (solver.method == Method::exact) return "exact";
  if (solver.odeint) return "odeint " + text_of(odeint_names, *solver.odeint);
  const std::string name(info_of(solver.integrator).name);
  if (solver.as_in_the_paper) return "the paper's springs";
  if (solver.method == Method::springs || info_of(solver.integrator).rigid_step != nullptr) return name;
  return name + (solver.method == Method::matrix ? ", matrix" : ", quaternion");
}

std::vector<Solver> rigid_solvers() {
  std::vector<Solver> solvers{exact_solver};
  for (const IntegratorInfo& row : integrators) {
    for (const Method method : {Method::matrix, Method::quaternion}) {
      if (takes(method, false, row)) solvers.push_back({method, row.id});
    }
  }
  return solvers;
}

std::vector<Solver> spring_solvers() {
  std::vector<Solver> solvers;
  for (const IntegratorInfo& row : integrators) {
    if (takes(Method::springs, false, row)) solvers.push_back({Method::springs, row.id});
  }
  return solvers;
}

std::vector<Solver> odeint_solvers(Method method) {
  std::vector<Solver> solvers;
  for (std::size_t i = 0; i < odeint_names.size(); ++i)
    solvers.push_back({method, Integrator::explicit_euler, static_cast<Odeint>(i)});
  return solvers;
}

BookOptions options_for(const Solver& solver, BookOptions options) {
  options.integrator = solver.integrator;
  if (solver.method == Method::springs && !solver.as_in_the_paper) {
    options.normalize_every = 0;
    options.damping = 0.0;
  }
  return options;
}

int evaluations_a_step(Integrator integrator) {
  switch (integrator) {
    case Integrator::rk4:
      return 4;
    case Integrator::splitting4:
      return 5;
    case Integrator::composition8:
      return 17;
    default:
      return 1;
  }
}

std::vector<Solver> solvers_of(const Runs& runs, Problem problem) {
  std::vector<Solver> solvers;
  for (const Run& run : runs) {
    if (run.problem == problem && std::find(solvers.begin(), solvers.end(), run.solver) == solvers.end())
      solvers.push_back(run.solver);
  }
  return solvers;
}

const Run* nearest_run(const Runs& runs, Problem problem, const Solver& solver) {
  return choose(runs, problem, solver, [](const Run& run, const Run& best) { return run.error < best.error; });
}

const Run* finest_run(const Runs& runs, Problem problem, const Solver& solver) {
  return choose(runs, problem, solver, [](const Run&, const Run&) { return true; });
}

const Run* coarsest_run(const Runs& runs, Problem problem, const Solver& solver) {
  return choose(runs, problem, solver, [](const Run&, const Run&) { return false; });
}

const Run* cheapest_run(const Runs& runs, Problem problem, const Solver& solver, double error) {
  const Run* best = choose(runs, problem, solver, [error](const Run& run, const Run& before) {
    if ((run.error <= error) != (before.error <= error)) return run.error <= error;
    return run.ns_per_time < before.ns_per_time;
  });
  return best != nullptr && best->error <= error ? best : nullptr;
}

const Run* run_near(const Runs& runs, Problem problem, const Solver& solver, double setting) {
  const auto distance = [setting](const Run& run) { return std::abs(std::log(run.setting / setting)); };
  return choose(runs, problem, solver, [&](const Run& run, const Run& best) { return distance(run) < distance(best); });
}

double best_error(const Runs& runs, Problem problem, const Solver& solver) {
  const Run* run = nearest_run(runs, problem, solver);
  return run == nullptr ? std::nan("") : run->error;
}

double least_cost(const Runs& runs, Problem problem, const Solver& solver, double error) {
  const Run* run = cheapest_run(runs, problem, solver, error);
  return run == nullptr ? std::nan("") : run->ns_per_time;
}

const Run* nearest_stepper(const Runs& runs, Problem problem) {
  const Run* best = nullptr;
  for (const Solver& solver : solvers_of(runs, problem)) {
    if (solver == exact_solver) continue;
    const Run* run = nearest_run(runs, problem, solver);
    if (run != nullptr && (best == nullptr || run->error < best->error)) best = run;
  }
  return best;
}

nlohmann::json winners(const Runs& runs, Problem problem, bool stepping) {
  nlohmann::json list = nlohmann::json::array();
  for (const double error : asked_errors) {
    const Run* best = nullptr;
    for (const Solver& solver : solvers_of(runs, problem)) {
      if (stepping && solver == exact_solver) continue;
      const Run* run = cheapest_run(runs, problem, solver, error);
      if (run != nullptr && (best == nullptr || run->ns_per_time < best->ns_per_time)) best = run;
    }
    if (best != nullptr) {
      list.push_back({{"error", error}, {"name", name_of(best->solver)}, {"ns", best->ns_per_time}});
    }
  }
  return list;
}

Table cheapest_table(const Runs& runs, Problem problem) {
  Table table{{"method"}, {}};
  for (const double error : asked_errors) table.columns.push_back("ns at " + plain(error));
  table.columns.insert(table.columns.end(), {"best error", "ns at best"});
  for (const Solver& solver : solvers_of(runs, problem)) {
    std::vector<Cell> row{name_of(solver)};
    for (const double error : asked_errors) {
      const Run* run = cheapest_run(runs, problem, solver, error);
      row.push_back(run == nullptr ? Cell("never") : Cell(run->ns_per_time));
    }
    const Run* best = nearest_run(runs, problem, solver);
    row.push_back(best == nullptr ? Cell("none finished") : Cell(best->error));
    row.push_back(best == nullptr ? std::nan("") : best->ns_per_time);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table runs_table(const Runs& runs) {
  Table table{{"problem", "method", "setting", "error", "ns per unit of time", "evaluations", "outcome"}, {}};
  for (const Run& run : runs) {
    table.rows.push_back({text_of(problem_names, run.problem), name_of(run.solver), run.setting, run.error,
                          run.ns_per_time, static_cast<double>(run.evaluations), text_of(outcome_names, run.outcome)});
  }
  return table;
}

}  // namespace bookspin
