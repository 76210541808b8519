#include "report/claims.h"

#include <fmt/format.h>

#include "dynamics/rigid_book.h"
#include "report/claims_list.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

std::vector<std::string> overrides_of(const Trial& trial) {
  std::vector<std::string> overrides = trial.overrides;
  overrides.push_back(fmt::format("expect=[{}]", trial.expect));
  return overrides;
}

}  // namespace

StepCost step_cost() {
  const auto ns = [](auto make) {
    auto book = make();
    return least_ns(30,
                    [&] {
                      for (int i = 0; i < 500; ++i) book.step(1e-3);
                    }) /
           500.0;
  };
  BookOptions options;
  options.omega_W = {0.11482, 1e-4, 5e-5};
  BookOptions plain = options;
  plain.normalize_every = 0;
  return {ns([&] { return MatrixBook(options); }), ns([&] { return MatrixBook(plain); }),
          ns([&] { return QuaternionBook(options); }), ns([&] { return QuaternionBook(plain); })};
}

Table claims_table(const std::filesystem::path& project, const Facts& facts, const Effort& effort, const Tell& tell) {
  Table table{"claims", {"section", "claim", "verdict", "measured", "command"}, {}};
  const std::vector<Claim> all = claims_of_the_paper(effort.quick);
  double done = 0.0;
  for (const Claim& claim : all) {
    tell(claim.text, done++ / static_cast<double>(all.size()));
    Found found;
    std::string commands;
    for (const Trial& trial : claim.trials) {
      const std::vector<std::string> overrides = overrides_of(trial);
      const Scene scene = load_scene(project / "videos" / (trial.script + ".toml"), overrides);
      found.push_back(judge(scene, simulate(scene)).front());
      commands += fmt::format("{}build/bookspin check videos/{}.toml", commands.empty() ? "" : "\n", trial.script);
      for (const std::string& text : overrides) commands += fmt::format(" --set '{}'", text);
    }
    const Answer answer = claim.answer(found, facts);
    table.rows.push_back(
        {claim.section, claim.text, answer.verdict, answer.measured, commands.empty() ? "make report" : commands});
  }
  return table;
}

}  // namespace bookspin
