#include "report/report.h"

#include <fmt/format.h>

#include <array>
#include <list>

#include "files/files.h"
#include "fill/fill.h"
#include "report/draft.h"
#include "report/machine.h"

namespace bookspin {
namespace {

struct Section {
  const char* title;
  void (*write)(Draft&);
};

constexpr std::array sections{Section{"speed against error", work_precision},
                              Section{"the springs' speed against error", spring_precision},
                              Section{"step limits of the springs", stability},
                              Section{"time to explosion", explosion},
                              Section{"the instability", instability},
                              Section{"cost of a film's frame", frame_costs},
                              Section{"the paper's claims", claims}};

// Numbers as they are read; whole ones stay what they are.
void make_readable(nlohmann::json& value) {
  if (value.is_structured()) {
    for (auto& part : value) make_readable(part);
  } else if (value.is_number_float()) {
    value = readable(value.get<double>());
  }
}

void publish_all(Draft& draft) {
  const Machine machine = this_machine(draft.order.project);
  const nlohmann::ordered_json made{{"processor", machine.processor},
                                    {"cores", machine.cores},
                                    {"compiler", machine.compiler},
                                    {"flags", machine.flags},
                                    {"commit", machine.commit}};
  draft.page["machine"] = made;
  draft.page["quick"] = draft.order.quick;
  draft.page["repeats"] = draft.effort.repeats;
  draft.page["most_evaluations"] = static_cast<double>(draft.effort.most_evaluations);
  nlohmann::ordered_json data = made;
  data.update(draft.tables);
  draft.files["report.json"] = data.dump(1) + "\n";
  make_readable(draft.page);
  const std::filesystem::path page = draft.order.project / "videos" / "report" / "page.html";
  const std::string index = fill(read_file(page), draft.page, page.string());
  std::list<Part> parts;
  std::vector<Part*> in_order;
  const auto write = [&](const std::string& name, const std::string& text) {
    in_order.push_back(&parts.emplace_back(draft.order.folder / name));
    write_part(parts.back(), [&](std::ostream& out) { out << text; });
  };
  for (const auto& [name, text] : draft.files) write(name, text);
  write("index.html", index);
  publish(in_order);
}

}  // namespace

void Draft::keep(const std::string& name, const Table& table) {
  const std::filesystem::path html = order.project / "videos" / "report" / "table.html";
  files[name + ".csv"] = as_csv(table);
  tables[name] = as_json(table);
  page["tables"][name] = fill(read_file(html), for_page(table), html.string());
}

void Draft::plot(const std::string& name, const Plot& plot) {
  files[name + ".svg"] = svg_of(name + ".svg", plot);
}

void make_report(const ReportOrder& order, const Tell& tell) {
  require_gnuplot();  // now, not after minutes of measuring
  std::filesystem::create_directories(order.folder);
  std::string at;
  Draft draft{order, order.quick ? Effort{100'000, 1, 0, 3.0, true} : Effort(),
              [&](std::string_view what) { tell(fmt::format("{}, {}", at, what)); }};
  for (std::size_t i = 0; i < sections.size(); ++i) {
    at = fmt::format("{} of {}: {}", i + 1, sections.size(), sections[i].title);
    tell(at);
    sections[i].write(draft);
  }
  publish_all(draft);
}

}  // namespace bookspin
