#include "report/report.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <list>
#include <regex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "files/files.h"
#include "fill/fill.h"
#include "report/draft.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

struct Section {
  const char* title;
  void (*write)(Draft&);
};

constexpr std::array sections{
    Section{"speed against error", work_precision},   Section{"the springs' speed against error", spring_precision},
    Section{"step limits of the springs", stability}, Section{"time to explosion", explosion},
    Section{"the instability", instability},          Section{"hard cases", hard_cases},
    Section{"cost of a film's frame", frame_costs},   Section{"the paper's claims", claims}};

// Where and from what the report was made: so that its times mean something elsewhere.
nlohmann::ordered_json this_machine(const std::string& commit) {
  std::string processor = "unknown processor";
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) processor = line.substr(line.find(':') + 2);
  }
  return {{"processor", processor},
          {"cores", std::thread::hardware_concurrency()},
          {"compiler", BOOKSPIN_COMPILER},
          {"flags", BOOKSPIN_FLAGS},
          {"commit", commit.empty() ? "unknown" : commit}};
}

void publish_all(Draft& draft) {
  nlohmann::ordered_json data = this_machine(draft.order.commit);
  draft.page["machine"] = data;
  draft.page["quick"] = data["quick"] = draft.order.quick;
  draft.page["beside_films"] = std::filesystem::exists(draft.order.folder / ".." / "index.html");
  draft.page["repeats"] = draft.effort.repeats;
  draft.page["most_evaluations"] = static_cast<double>(draft.effort.most_evaluations);
  data.update(draft.tables);
  draft.files["report.json"] = data.dump(1) + "\n";
  make_readable(draft.page);
  const std::filesystem::path page = draft.order.project / "videos" / "report" / "page.html";
  const std::string index = fill(read_file(page), draft.page, page.string());
  std::list<Part> parts;
  std::vector<Part*> in_order;
  const auto write = [&](const std::string& name, const std::string& text) {
    in_order.push_back(&parts.emplace_back(draft.order.folder / name, NamedBy::program));
    write_part(parts.back(), text);
  };
  for (const auto& [name, text] : draft.files) write(name, text);
  write("index.html", index);
  publish(in_order);
}

// Those that the page refers to, and two more.
std::vector<std::string> names_of_files(const ReportOrder& order) {
  static const std::regex reference(R"-("([a-z0-9_]+\.(csv|svg))")-");
  const std::string page = read_file(order.project / "videos" / "report" / "page.html");
  std::vector<std::string> names{"report.json", "index.html"};
  for (std::sregex_iterator at(page.begin(), page.end(), reference), end; at != end; ++at) names.push_back((*at)[1]);
  return names;
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

Draft::Judged Draft::judge(const std::vector<std::string>& trial) {
  const Scene scene = load_scene(order.project / "videos" / (trial.front() + ".toml"), std::span(trial).subspan(1));
  std::vector<std::string> motion = trial;
  std::erase_if(motion, [](const std::string& text) { return text.starts_with("expect="); });
  const auto [place, is_new] = motions.try_emplace(motion);
  if (is_new) place->second = simulate(scene);
  return {scene.clip, bookspin::judge(scene, place->second)};
}

void make_report(const ReportOrder& order, const Tell& tell) {
  require_gnuplot();  // now, not after minutes of measuring
  make_folder(order.folder);
  for (const std::string& name : names_of_files(order))
    const Part can_be_written(order.folder / name, NamedBy::program);
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
