// The paper's claims, each with the number that supports, limits or refutes it and the command that shows it again.
//
// A trial is a scene script of videos/ with overrides, judged by one expectation written into it: exactly what
// `bookspin check SCRIPT --set ... --set 'expect=[...]'` prints as "found". The verdict is computed from what was
// found.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "report/measure.h"
#include "report/table.h"

namespace bookspin {

// What other parts of the report found and the claims need.
struct Facts {
  std::vector<Run> runs;     // of case a, and of the springs
  double ms_dynamics = 0.0;  // of a frame of the springs' film
  Table model_error;         // spring_model_error
};

struct StepCost {  // nanoseconds a step, least of several
  double matrix = 0.0;
  double matrix_plain = 0.0;  // without normalization
  double quaternion = 0.0;
  double quaternion_plain = 0.0;
};

[[nodiscard]] StepCost step_cost();

// Columns: section, claim, verdict, what was measured, command.
[[nodiscard]] Table claims_table(const std::filesystem::path& project, const Facts& facts, const Effort& effort,
                                 const Tell& tell);

}  // namespace bookspin
