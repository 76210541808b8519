#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "dynamics/integrators.h"
#include "report/advise.h"
#include "scene/scene_file.h"

// What `bookspin advise` prints: a table of what was tried, and the lines to paste.

namespace bookspin {

namespace fs = std::filesystem;

int give_advice(const Options& options) {
  const std::string& file = options.scenes.front();
  const Scene scene = load_scene(file, options.overrides);
  const auto named = [](const Solver& solver, const char* separator) {
    const std::string_view integrator = solver.method == Method::exact ? "" : info_of(solver.integrator).name;
    return fmt::format("{}{}{}", name_of(solver.method), integrator.empty() ? "" : separator, integrator);
  };
  print(fmt::format("{}: angle_error at most {} rad in each of {} frames\n", fs::path(file).filename().string(),
                    options.error, scene.clip.frames));
  for (const Advice& advice : advise(scene, options.error, options.stop)) {
    print("\n");
    for (std::size_t i = 0; i < advice.books.size(); ++i) {
      const BookSetup& book = scene.books[advice.books[i]];
      print(fmt::format("book {}, {}, {} steps a frame: {:.2g} rad off\n", advice.books[i],
                        named({book.method, book.options.integrator}, " by "), scene.clip.substeps, advice.errors[i]));
    }
    print(fmt::format("  {:34} {:>13} {:>11} {:>19} {:>12}\n", "", "steps a frame", "error, rad", "evaluations a frame",
                      "ns a frame"));
    bool springs = false;
    for (const Candidate& c : advice.candidates) {
      const bool exact = c.solver.method == Method::exact;
      const std::string of = c.solver.method == Method::springs ? fmt::format(", book {}", c.book) : "";
      print(fmt::format("  {:34} {:>13} {:>11.1e} {:>19} {:>12.0f}{}\n", named(c.solver, ", ") + of,
                        exact ? "none" : fmt::format("{}", c.substeps), c.error, c.evaluations, c.ns,
                        c.error <= options.error ? "" : "  not within it"));
      springs = springs || c.solver.method == Method::springs;
    }
    if (springs) {
      print(
          "Springs, damped ones above all, have a motion of their own, and no exact solution: their error is the\n"
          "distance from the rigid book, and no step takes away what the model adds.\n");
    }
    // The least of all, and of those that are stepped.
    for (const bool stepped : {false, true}) {
      const auto best = std::find_if(advice.candidates.begin(), advice.candidates.end(), [&](const Candidate& c) {
        return c.error <= options.error && (c.solver.method != Method::exact || !stepped);
      });
      if (best == advice.candidates.end() || (stepped && best == advice.candidates.begin())) continue;
      const bool exact = best->solver.method == Method::exact;
      std::vector<std::string> lines{fmt::format("method = \"{}\"", name_of(best->solver.method))};
      std::string set = fmt::format("--set book.{}.method={}", best->book, name_of(best->solver.method));
      if (!exact) {
        const std::string_view integrator = info_of(best->solver.integrator).name;
        lines.push_back(fmt::format("integrator = \"{}\"", integrator));
        set +=
            fmt::format(" --set book.{}.integrator={} --set clip.substeps={}", best->book, integrator, best->substeps);
      }
      print(fmt::format("{}, at the least work; in [[book]]{}:\n  {}\n",
                        stepped ? "Of those that take steps" : "Of all", exact ? ", without integrator" : "",
                        fmt::join(lines, "\n  ")));
      if (!exact) print(fmt::format("and in [clip], for all its books:\n  substeps = {}\n", best->substeps));
      print(fmt::format(
          "to see it:\n  bookspin check {} {} --set 'expect=[{{quantity=\"angle_error\", book={}, at_most={}}}]'\n",
          file, set, best->book, options.error));
    }
  }
  return 0;
}

}  // namespace bookspin
