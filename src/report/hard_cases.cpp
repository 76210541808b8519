#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "files/files.h"
#include "report/draft.h"
#include "scene/doubts.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "scene/toml.h"

// Every method on every hard case (videos/report/hard_cases.toml): right to the eye; wrong, as its own energy, angular
// momentum or shape shows; or wrong in silence.

namespace bookspin {
namespace {

constexpr double kept = 0.01;  // what may be lost of energy, angular momentum and shape without being noticed

bool shows(const BookFrame& f) {
  return f.exploded() || !(std::abs(f[Q::energy_ratio] - 1.0) <= kept) ||
         !(std::abs(f[Q::angular_momentum_ratio] - 1.0) <= kept) || !(f[Q::stretch] <= kept);
}

const char* outcome_of(const Scene& scene) {
  const Trajectory trajectory = simulate(scene);
  const std::vector<BookFrame>& frames = trajectory.books.front().frames;
  if (std::all_of(frames.begin(), frames.end(), [](const BookFrame& f) { return f[Q::angle_error] <= visible_error; }))
    return "right";
  return std::any_of(frames.begin(), frames.end(), shows) ? "wrong, shows it" : "wrong in silence";
}

}  // namespace

void hard_cases(Draft& draft) {
  const std::string file = (draft.order.project / "videos" / "report" / "hard_cases.toml").string();
  const toml::table list = toml::parse(read_file(file), file);
  const std::vector<Solver> solvers = contenders();
  Table table{{"case"}, {}};
  for (const Solver& solver : solvers) table.columns.push_back(title_of(solver));
  std::map<std::string, int> counts;
  for (const toml::node& node : *list["case"].as_array()) {
    const toml::table& hard = *node.as_table();
    const toml::array& clip = *hard["clip"].as_array();
    draft.say(hard["name"].value_or(""));
    Scene scene =
        parse_scene(fmt::format("title = \"T\"\n[[book]]\nmethod = \"exact\"\n{}\n", hard["book"].value_or("")), file);
    scene.clip.frames = std::min(clip[0].value_or(0), draft.effort.quick ? 100 : 100'000);
    scene.clip.time_per_frame = clip[1].value_or(0.0);
    table.rows.push_back({hard["name"].value_or("")});
    for (const Solver& solver : solvers) {
      BookSetup& book = scene.books.front();
      book.method = solver.method;
      book.options = options_for(solver, {.size = book.options.size, .omega_W = book.options.omega_W});
      scene.clip.substeps = clip[2].value_or(1) * (solver.method == Method::springs ? 30 : 1);
      const std::string outcome = outcome_of(scene);
      ++counts[outcome];
      table.rows.back().emplace_back(outcome);
    }
  }
  draft.keep("hard_cases", table);
  draft.page["hard"] = {{"runs", table.rows.size() * solvers.size()},
                        {"error", visible_error},
                        {"kept", 100.0 * kept},
                        {"right", counts["right"]},
                        {"shown", counts["wrong, shows it"]},
                        {"silent", counts["wrong in silence"]}};
}

}  // namespace bookspin
