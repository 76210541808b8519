#include "report/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "files/files.h"
#include "report/claims.h"
#include "report/draft.h"
#include "report/machine.h"
#include "report/plots.h"

namespace bookspin {
namespace {

void finish(Draft& draft) {
  draft.tell("writing the page", 1.0);
  const Machine machine = this_machine(draft.order.project);
  draft.values["processor"] = escape_text(machine.processor);
  draft.values["cores"] = std::to_string(machine.cores);
  draft.values["compiler"] = escape_text(machine.compiler);
  draft.values["flags"] = escape_text(machine.flags);
  draft.values["commit"] = escape_text(machine.commit);
  draft.values["repeats"] = std::to_string(draft.effort.repeats);
  draft.values["most_evaluations"] = readable(static_cast<double>(draft.effort.most_evaluations));
  draft.values["quick"] =
      draft.order.quick
          ? "<p class=\"note\"><strong>A quick run, for tests: too few and too short runs to be read.</strong></p>"
          : "";
  write_file(draft.order.folder / "report.json", as_json(draft.tables, {{"processor", machine.processor},
                                                                        {"cores", std::to_string(machine.cores)},
                                                                        {"compiler", machine.compiler},
                                                                        {"flags", machine.flags},
                                                                        {"commit", machine.commit}}));
  write_file(draft.order.folder / "index.html",
             fill_page(draft.order.project / "videos" / "report" / "page.html", draft.values));
}

}  // namespace

double number(const Cell& cell) {
  const auto* value = std::get_if<double>(&cell);
  return value == nullptr ? std::nan("") : *value;
}

void Draft::keep(const std::string& name, Table table, bool on_page) {
  table.name = name;
  write_file(order.folder / (name + ".csv"), as_csv(table));
  if (on_page) values[name] = as_html(table);
  tables.push_back(std::move(table));
}

void write_claims(Draft& draft) {
  const Facts facts{draft.runs, draft.cost.dynamics, draft.model_error};
  Table table = claims_table(draft.order.project, facts, draft.effort, [&draft](std::string_view what, double done) {
    draft.tell("the paper's claims: " + std::string(what).substr(0, 40), 0.91 + 0.09 * done);
  });
  write_file(draft.order.folder / "claims.csv", as_csv(table));
  std::string html;
  std::map<std::string, int> count;
  for (const auto& row : table.rows) {
    const auto text = [&row](std::size_t i) { return escape_text(std::get<std::string>(row[i])); };
    ++count[text(2)];
    std::string style = text(2);
    std::replace(style.begin(), style.end(), ' ', '-');
    html += fmt::format(
        "<li class=\"{}\"><p class=\"claim\"><span class=\"verdict\">{}</span> {} <span class=\"section\">section "
        "{}</span></p><p>{}</p>"
        "<details><summary>Show it again</summary><pre>{}</pre></details></li>\n",
        style, text(2), text(1), text(0), text(3), text(4));
  }
  draft.values["claims"] = html;
  draft.values["claims_count"] =
      fmt::format("{} supported, {} limited, {} refuted, {} not to be measured", count["supported"], count["limited"],
                  count["refuted"], count["not measured"]);
  table.name = "claims";
  draft.tables.push_back(std::move(table));
}

void make_report(const ReportOrder& order, const Tell& tell) {
  Draft draft{order, tell, {}, {}, {}, {}, {}, {}};
  if (order.quick) draft.effort = {100'000, 1, 3.0, true};
  require_gnuplot();  // now, not after minutes of measuring
  std::filesystem::create_directories(order.folder);
  write_precision(draft);
  write_stability(draft);
  write_instability(draft);
  write_cost(draft);
  write_claims(draft);
  finish(draft);
}

}  // namespace bookspin
