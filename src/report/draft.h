// The report in the making: what its parts share while they run. For the .cpp files of this room.
#pragma once

#include <string>
#include <vector>

#include "report/cost.h"
#include "report/measure.h"
#include "report/page.h"
#include "report/report.h"
#include "report/table.h"

namespace bookspin {

struct Draft {
  ReportOrder order;
  Tell tell;  // `done` is the part of a full run that lies behind
  Effort effort;
  std::vector<Run> runs;  // of all work-precision ladders
  Table model_error;      // spring_model_error
  FrameCost cost;
  std::vector<Table> tables;  // for report.json
  PageValues values;          // for the page

  // Keeps a table under this name: as CSV now, in the JSON, and (on_page) as a value of the page.
  void keep(const std::string& name, Table table, bool on_page = true);
};

[[nodiscard]] double number(const Cell& cell);  // NaN for a text

// The parts, in this order.
void write_precision(Draft& draft);
void write_stability(Draft& draft);
void write_instability(Draft& draft);
void write_cost(Draft& draft);
void write_claims(Draft& draft);

}  // namespace bookspin
