#include "report/runs.h"

#include <algorithm>
#include <cmath>

#include "scene/any_book.h"

namespace bookspin {
namespace {

constexpr std::array odeint_names{"rk4", "dopri5", "fehlberg78", "bulirsch_stoer"};

constexpr std::array asked{std::pair{"1e-2", 1e-2}, std::pair{"1e-4", 1e-4}, std::pair{"1e-6", 1e-6},
                           std::pair{"1e-9", 1e-9}};

// The ladder whose run, `of(ladder)`, has the least `number`.
template <class Of>
Best least(const Ladders& ladders, bool stepping, double Run::*number, Of&& of) {
  Best best;
  for (const Ladder& ladder : ladders) {
    if (stepping && ladder.solver == exact_solver) continue;
    if (const Run run = of(ladder); run.*number < best.run.*number) best = {ladder.solver, run};
  }
  return best;
}

std::vector<Solver> stepped_by(std::initializer_list<Method> methods) {
  std::vector<Solver> solvers;
  for (const IntegratorInfo& row : integrators) {
    for (const Method method : methods) {
      if (takes(method, false, row)) solvers.push_back({method, row.id});
    }
  }
  return solvers;
}

}  // namespace

std::string name_of(const Solver& solver) {
  if (solver.method == Method::exact) return "exact";
  if (solver.as_in_the_paper) return "the paper's springs";
  if (solver.odeint) return std::string("odeint ") + odeint_names.at(static_cast<std::size_t>(*solver.odeint));
  const IntegratorInfo& row = info_of(solver.integrator);
  const bool either = row.matrix && row.quaternion && solver.method != Method::springs;
  return std::string(row.name) + (!either ? "" : solver.method == Method::matrix ? ", matrix" : ", quaternion");
}

std::vector<Solver> rigid_solvers() {
  std::vector<Solver> solvers = stepped_by({Method::matrix, Method::quaternion});
  solvers.insert(solvers.begin(), exact_solver);
  return solvers;
}

std::vector<Solver> spring_solvers() {
  return stepped_by({Method::springs});
}

std::vector<Solver> odeint_solvers(Method method) {
  using enum Odeint;
  std::vector<Solver> solvers;
  for (const Odeint which : {rk4, dopri5, fehlberg78, bulirsch_stoer}) solvers.push_back({method, {}, which});
  return solvers;
}

std::vector<Solver> contenders() {
  std::vector<Solver> all = rigid_solvers();
  all.push_back(papers_springs);
  for (const Solver& solver : spring_solvers()) {
    if (solver.integrator != Integrator::explicit_euler) all.push_back(solver);
  }
  return all;
}

std::string title_of(const Solver& solver) {
  return (solver.method == Method::springs && !solver.as_in_the_paper ? "springs, " : "") + name_of(solver);
}

int evaluations_a_step(Integrator integrator) {
  switch (integrator) {
    case Integrator::rk4:
      return 4;
    case Integrator::rkn6:
      return 11;
    default:
      return 1;
  }
}

BookOptions options_for(const Solver& solver, BookOptions options) {
  options.integrator = solver.integrator;
  if (solver.method == Method::springs && !solver.as_in_the_paper) {
    options.normalize_every = 0;
    options.damping = 0.0;
  }
  return options;
}

const Ladder& ladder(const Ladders& ladders, const Solver& solver) {
  static const Ladder empty{};
  const auto found = std::find_if(ladders.begin(), ladders.end(), [&](const Ladder& l) { return l.solver == solver; });
  return found == ladders.end() ? empty : *found;
}

Best nearest_stepper(const Ladders& ladders) {
  return least(ladders, true, &Run::error, [](const Ladder& ladder) { return ladder.nearest(); });
}

nlohmann::json winners(const Ladders& ladders, bool stepping) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [text, error] : asked) {
    const auto [solver, run] = least(ladders, stepping, &Run::ns_per_time,
                                     [within = error](const Ladder& ladder) { return ladder.cheapest(within); });
    if (run.error <= error) list.push_back({{"error", error}, {"name", name_of(solver)}, {"ns", run.ns_per_time}});
  }
  return list;
}

Table cheapest_table(const Ladders& ladders) {
  Table table{{"method"}, {}};
  for (const auto& [text, error] : asked) table.columns.push_back(std::string("ns at ") + text);
  table.columns.insert(table.columns.end(), {"best error", "ns at best"});
  for (const Ladder& ladder : ladders) {
    std::vector<Cell> row{name_of(ladder.solver)};
    for (const auto& [text, error] : asked) row.push_back(number_or("never", ladder.cheapest(error).ns_per_time));
    const Run best = ladder.nearest();
    row.insert(row.end(), {number_or("none finished", best.error), best.ns_per_time});
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table runs_table(const Runs& runs) {
  constexpr std::array problems{"case a", "case b", "case c", "case d", "springs"};
  constexpr std::array outcomes{"finished", "diverged", "stalled"};
  Table table{{"problem", "method", "setting", "error", "ns per unit of time", "evaluations", "outcome"}, {}};
  for (const auto& [problem, ladders] : runs) {
    for (const Ladder& ladder : ladders) {
      for (const Run& run : ladder.runs)
        table.rows.push_back({problems.at(static_cast<std::size_t>(problem)), name_of(ladder.solver), run.setting,
                              run.error, run.ns_per_time, run.evaluations,
                              outcomes.at(static_cast<std::size_t>(run.outcome))});
    }
  }
  return table;
}

}  // namespace bookspin
