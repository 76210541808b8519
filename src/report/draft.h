// The report in the making: what its sections share while they run. For the .cpp files of this room.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/measure.h"
#include "report/plots.h"
#include "report/report.h"
#include "scene/judge.h"

namespace bookspin {

// Springs against the rigid body: what the step's size adds, and what the springs themselves do. In half diagonals of
// the book, the largest over the samples; infinite: exploded.
struct ModelError {
  double stiffness;
  bool damped;
  bool normalized;
  Integrator integrator;
  double integration;  // from the springs' own motion
  double model;        // of the springs' own motion from the rigid one
  double all;          // of the run from the rigid motion
};

struct Draft {
  const ReportOrder& order;
  Effort effort;
  Tell say;
  Runs runs{};                        // of all work-precision ladders
  double exact_evaluation_ns = none;  // of the exact motion at one time
  std::vector<ModelError> model_errors{};
  nlohmann::ordered_json tables{};  // for report.json
  nlohmann::json page{};            // what page.html shows
  std::map<std::vector<std::string>, Trajectory> motions{};
  std::map<std::string, std::string> files{};  // name -> text: all of the report but the page, until it is published

  // Keeps a table under this name: as CSV, in the JSON, and in the page's `tables`.
  void keep(const std::string& name, const Table& table);
  void plot(const std::string& name, const Plot& plot);  // as NAME.svg
  // What `bookspin check videos/SCRIPT.toml --set ... --set 'expect=[...]'` finds; trial: the script and what is set. A
  // motion that several trials share is simulated once.
  [[nodiscard]] std::vector<Verdict> judge(const std::vector<std::string>& trial);
};

// Each section computes, keeps its tables and plots, and says its numbers to the page; in this order.
void work_precision(Draft& draft);
void spring_precision(Draft& draft);
void stability(Draft& draft);
void explosion(Draft& draft);
void instability(Draft& draft);
void frame_costs(Draft& draft);
void claims(Draft& draft);

// The plot of error over cost of these problems' runs; of several problems the first one's solvers stand in the key.
[[nodiscard]] Plot work_precision_plot(const Runs& runs, const std::vector<Problem>& problems,
                                       const std::string& y_label, const std::string& lowest);

}  // namespace bookspin
