#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "dynamics/rigid_book.h"
#include "files/files.h"
#include "fill/fill.h"
#include "report/draft.h"
#include "scene/toml.h"

// The paper's claims (videos/report/claims.toml), each with the number that supports, limits or refutes it and the
// command that shows it again.

namespace bookspin {
namespace {

constexpr const char* supported = "supported";
constexpr const char* limited = "limited";
constexpr const char* refuted = "refuted";
constexpr const char* not_measured = "not measured";

struct Facts {
  const Draft& draft;
  nlohmann::json say;  // numbers for the sentence
  std::vector<Verdict> found;

  double operator[](std::size_t i) const { return found.at(i).found; }
  [[nodiscard]] double frame(std::size_t i) const {
    return found.at(i).met ? found[i].frame : none;
  }  // of an explosion
  [[nodiscard]] const Ladder& case_a(const Solver& solver) const {
    return ladder(draft.runs.at(Problem::case_a), solver);
  }
};

using Rule = const char* (*)(Facts& facts);

// What no bound on one quantity says.
const std::map<std::string, Rule> rules{
    {"fast",
     [](Facts& f) {
       const double times = 1000.0 / 60.0 / f.draft.page["frame"]["dynamics_ms"].get<double>();
       f.say["times"] = times;
       return times > 1.0 ? supported : refuted;
     }},
    {"damping",
     [](Facts& f) {
       f.say.update({{"lost", std::abs(f[2] - 1.0)}, {"gained", f[3] - 1.0}});
       return !f.found[0].met ? refuted : !f.found[2].met ? limited : supported;
     }},
    {"ten times later", [](Facts& f) { return f.frame(1) > 10.0 * f.frame(0) ? supported : refuted; }},
    {"model",
     [](Facts& f) {
       const ModelError& undamped = f.draft.model_errors[0];  // of k = 10, as the paper's
       const ModelError& paper = f.draft.model_errors[2];
       f.say.update({{"k", paper.stiffness},
                     {"integration", paper.integration},
                     {"model", paper.model},
                     {"other", info_of(undamped.integrator).name},
                     {"others_integration", undamped.integration},
                     {"others_model", undamped.model}});
       return paper.model > paper.integration ? supported : paper.model > 0.1 * paper.integration ? limited : refuted;
     }},
    {"larger step", [](Facts& f) { return f[3] < f[1] - 5.0 ? limited : supported; }},
    {"same flip",
     [](Facts& f) {
       const int frame = f.found[0].frame;
       const bool same = std::abs(frame - f.found[1].frame) <= 0.05 * frame && std::abs(f[0] - f[1]) < 5.0;
       return same ? supported : limited;
     }},
    {"often later",
     [](Facts& f) {
       const int later = (f.frame(1) > f.frame(0)) + (f.frame(3) > f.frame(2)) + (f.frame(5) > f.frame(4));
       f.say["later"] = later;
       return later >= 2 ? supported : limited;
     }},
    {"cheaper",
     [](Facts& f) {
       const auto step_ns = [](auto book) {
         return least_ns(30,
                         [&] {
                           for (int i = 0; i < 500; ++i) book.step(1e-3);
                         }) /
                500.0;
       };
       BookOptions options;
       options.omega_W = {0.11482, 1e-4, 5e-5};
       const double matrix = step_ns(MatrixBook(options));
       const double quaternion = step_ns(QuaternionBook(options));
       options.normalize_every = 0;
       const double svd = matrix - step_ns(MatrixBook(options));
       const double division = std::max(0.0, quaternion - step_ns(QuaternionBook(options)));
       f.say.update({{"svd", svd}, {"division", division}, {"matrix", matrix}, {"quaternion", quaternion}});
       return svd > 3.0 * division ? supported : refuted;
     }},
    {"seldom", [](Facts& f) { return f[1] < 1.5 * f[0] && f.found[2].met ? supported : limited; }},
    {"higher order",
     [](Facts& f) {
       const Ladder& euler = f.case_a({Method::quaternion});
       const Ladder& rk4 = f.case_a({Method::quaternion, Integrator::rk4});
       const Run e = euler.closest(0.1 / 6.0);
       const Run r = rk4.closest(0.1 / 6.0);
       const double eulers_best = euler.nearest().error;
       f.say.update({{"h", r.setting},
                     {"euler_ns", e.ns_per_time},
                     {"euler_error", e.error},
                     {"rk4_ns", r.ns_per_time},
                     {"rk4_error", r.error},
                     {"eulers_best", eulers_best}});
       const Run enough = rk4.cheapest(eulers_best);
       if (enough.error <= eulers_best)
         f.say["enough"] = {{"h", enough.setting}, {"ns", enough.ns_per_time}, {"error", enough.error}};
       return enough.ns_per_time < e.ns_per_time ? limited : supported;
     }},
    {"sufficient",
     [](Facts& f) {
       const double euler =
           std::min(f.case_a({Method::matrix}).nearest().error, f.case_a({Method::quaternion}).nearest().error);
       const Run exact = f.case_a(exact_solver).nearest();
       const Run rk4 = f.case_a({Method::quaternion, Integrator::rk4}).cheapest(1e-6);
       f.say.update(
           {{"euler", euler}, {"rk4_ns", rk4.ns_per_time}, {"exact", exact.error}, {"exact_ns", exact.ns_per_time}});
       return euler > 1e-2 ? refuted : limited;
     }},
};

// The trial's script and what is set, a, b, c, ... of the trials before filled in.
std::vector<std::string> filled(const toml::node& trial, const nlohmann::json& data, const std::string& file) {
  std::vector<std::string> texts;
  for (const toml::node& text : *trial.as_array()) texts.push_back(fill(text.value_or(""), data, file));
  return texts;
}

const char* verdict_of(const toml::table& claim, Facts& facts) {
  if (const auto name = claim["rule"].value<std::string>()) {
    const auto rule = rules.find(*name);
    if (rule == rules.end()) throw std::runtime_error(fmt::format("claims.toml: rule: found \"{}\"", *name));
    return rule->second(facts);
  }
  if (facts.found.empty()) return not_measured;
  const toml::array* words = claim["otherwise"].as_array();
  if (words == nullptr || words->size() != facts.found.size())
    throw std::runtime_error(fmt::format("claims.toml: \"{}\": otherwise: needs {} words, one for each bound",
                                         claim["claim"].value_or(""), facts.found.size()));
  const char* verdict = supported;
  for (std::size_t i = 0; i < facts.found.size(); ++i) {
    const std::string otherwise = (*words)[i].value_or("");
    if (!facts.found[i].met && !otherwise.empty() && verdict != refuted)
      verdict = otherwise == refuted ? refuted : limited;
  }
  return verdict;
}

}  // namespace

void claims(Draft& draft) {
  const std::string file = (draft.order.project / "videos" / "report" / "claims.toml").string();
  const toml::table list = toml::parse(read_file(file), file);
  const nlohmann::json lengths = draft.effort.quick
                                     ? nlohmann::json{{"longer", 800}, {"last", 799}, {"many", 100}}
                                     : nlohmann::json{{"longer", 20000}, {"last", 19999}, {"many", 1000}};
  Table table{{"section", "claim", "verdict", "measured", "command"}, {}};
  std::map<std::string, int> counts;
  for (const toml::node& node : *list["claim"].as_array()) {
    const toml::table& claim = *node.as_table();
    const std::string text = claim["claim"].value_or("");
    draft.say(text.substr(0, 50));
    Facts facts{draft, draft.page, {}};
    facts.say.update(lengths);
    std::vector<std::string> commands;
    for (std::size_t i = 0; claim["trials"][i]; ++i) {
      const std::vector<std::string> trial = filled(*claim["trials"][i].node(), facts.say, file);
      commands.push_back(fmt::format("bookspin check videos/{}.toml --set '{}'", trial.front(),
                                     fmt::join(trial.begin() + 1, trial.end(), "' --set '")));
      const auto [clip, verdicts] = draft.judge(trial);
      for (const Verdict& v : verdicts) {
        facts.say[std::string(1, static_cast<char>('a' + facts.found.size()))] = {
            {"found", v.found},
            {"frame", v.frame},
            {"met", v.met},
            {"h", clip.time_per_frame / clip.substeps},
            {"time", clip.time_per_frame * clip.frames},
            {"explodes", v.met ? fmt::format("explodes in frame {}", v.frame) : "does not explode"}};
        facts.found.push_back(v);
      }
    }
    if (commands.empty()) commands.emplace_back("bookspin report");
    const std::string verdict = verdict_of(claim, facts);
    ++counts[verdict];
    make_readable(facts.say);
    table.rows.push_back({claim["section"].value_or(""), text, verdict,
                          fill(claim["measured"].value_or(""), facts.say, file),
                          fmt::format("{}", fmt::join(commands, "\n"))});
  }
  draft.keep("claims", table);
  draft.page["claims"] = as_json(table);
  draft.page["verdicts"] = nlohmann::json::array();
  for (const char* verdict : {supported, limited, refuted, not_measured})
    draft.page["verdicts"].push_back({{"verdict", verdict}, {"count", counts[verdict]}});
}

}  // namespace bookspin
