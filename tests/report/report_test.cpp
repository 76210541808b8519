// The whole report, quick: every file, every table, and what they say of the methods. No time is judged, and none
// decides what is measured.

#include "report/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

#include "report/runs.h"
#include "scratch.h"
#include "tolerance.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::json;

std::vector<std::string> names_of(std::vector<Solver> solvers, Method odeint) {
  std::vector<std::string> names;
  for (const Solver& solver : solvers) names.push_back(name_of(solver));
  for (const Solver& solver : odeint_solvers(odeint)) names.push_back(name_of(solver));
  return names;
}
const std::vector<std::string> rigid_methods = names_of(rigid_solvers(), Method::quaternion);
const std::vector<std::string> spring_methods = names_of(spring_solvers(), Method::springs);
const std::vector<std::string> odeint_methods = names_of({}, Method::springs);

const std::size_t contenders = bookspin::contenders().size();

// Made once for all tests.
struct Report : testing::Test {
  static void SetUpTestSuite() {
    folder = fs::temp_directory_path() / ("bookspin-report-" + std::to_string(getpid()));
    make_report({folder, BOOKSPIN_SOURCE_DIR, true, "a commit"},
                [](std::string_view what) { said += std::string(what) + '\n'; });
    json = Json::parse(read_text(folder / "report.json"));
  }
  static void TearDownTestSuite() { fs::remove_all(folder); }

  static double best_error(const std::string& problem, const std::string& method) {
    double best = 1e300;
    for (const Json& run : json["runs"]) {
      if (run["problem"] == problem && run["method"] == method && run["outcome"] == "finished")
        best = std::min(best, run["error"].get<double>());
    }
    return best;
  }
  static double error_at(const std::string& problem, const std::string& method, double setting) {
    for (const Json& run : json["runs"]) {
      if (run["problem"] == problem && run["method"] == method &&
          std::abs(run["setting"].get<double>() / setting - 1.0) < 1e-6)
        return run["error"].get<double>();
    }
    return std::nan("");
  }

  inline static fs::path folder;
  inline static std::string said;
  inline static Json json;
};

TEST(AReport, IsRefusedBeforeItIsMeasuredWhereAFileOfTheUsersHasANameOfIts) {
  const Scratch scratch;
  write_text(scratch / "runs.csv", "mine");
  bool measured = false;
  EXPECT_THAT(
      [&] {
        make_report({scratch.folder(), BOOKSPIN_SOURCE_DIR, true}, [&](auto) { measured = true; });
      },
      testing::ThrowsMessage<std::runtime_error>(HasSubstr("runs.csv")));
  EXPECT_FALSE(measured);
  EXPECT_EQ(read_text(scratch / "runs.csv"), "mine");
}

TEST_F(Report, LeavesNothingHalfMade) {
  const std::string page = read_text(folder / "index.html");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension == ".csv" || extension == ".svg") {
      EXPECT_THAT(page, HasSubstr('"' + entry.path().filename().string() + '"'));
    }
    EXPECT_TRUE(extension == ".sha256" || extension == ".html" || extension == ".json" || extension == ".csv" ||
                extension == ".svg")
        << entry.path();
    EXPECT_GT(entry.file_size(), 40U) << entry.path();
  }
}

TEST_F(Report, ThePageShowsOnlyWhatIsThere) {
  const std::string page = read_text(folder / "index.html");
  EXPECT_THAT(page, Not(HasSubstr("{{")));
  EXPECT_FALSE(std::regex_search(page, std::regex("\\bnan\\b")));
  const std::regex link("(?:src|href)=\"([^\"]+)\"");
  int links = 0;
  for (auto it = std::sregex_iterator(page.begin(), page.end(), link); it != std::sregex_iterator(); ++it) {
    const std::string to = (*it)[1];
    const bool within = to.starts_with('#');
    EXPECT_TRUE(within ? page.find("id=\"" + to.substr(1) + '"') != std::string::npos : fs::exists(folder / to)) << to;
    ++links;
  }
  EXPECT_GE(links, 20);
  for (const auto& entry : fs::directory_iterator(folder)) {  // and all of it
    if (entry.path().extension() == ".html" || entry.path().extension() == ".sha256") continue;
    EXPECT_THAT(page, HasSubstr('"' + entry.path().filename().string() + '"'));
  }
}

TEST_F(Report, SaysHowFarItIs) {
  EXPECT_THAT(said, HasSubstr("1 of 8: speed against error, case a\n"));
  EXPECT_THAT(said, HasSubstr("8 of 8: the paper's claims\n"));
}

TEST_F(Report, SaysWhereItWasMade) {
  EXPECT_EQ(json["commit"], "a commit");
  for (const char* key : {"processor", "compiler", "flags"}) EXPECT_NE(json[key].get<std::string>(), "") << key;
  EXPECT_GT(json["cores"].get<int>(), 0);
  EXPECT_THAT(json["flags"].get<std::string>(), HasSubstr("-ffp-contract=off"));
}

TEST_F(Report, EveryTableHasEveryMethod) {
  const auto methods_of = [](const std::string& table) {
    std::vector<std::string> methods;
    for (const Json& row : json[table]) methods.push_back(row["method"]);
    return methods;
  };
  for (const char* letter : {"a", "b", "c", "d"})
    EXPECT_EQ(methods_of(std::string("cheapest_") + letter), rigid_methods) << letter;
  EXPECT_EQ(methods_of("cheapest_springs"), spring_methods);
  EXPECT_EQ(methods_of("cheapest_springs_one_by_one"), odeint_methods);
  EXPECT_EQ(json["flip_times"][0].size(), 2 + contenders);  // with the kick and theory
}

TEST_F(Report, TheExactMethodBeatsAll) {
  for (const char* problem : {"case a", "case b", "case c", "case d"}) {
    const double exact = best_error(problem, "exact");
    EXPECT_LT(exact, tolerance(1e-14)) << problem;  // measured 1.3e-15
    for (const std::string& method : rigid_methods) {
      if (method == "exact") continue;
      EXPECT_LT(10.0 * exact, best_error(problem, method)) << problem << ' ' << method;
    }
  }
}

TEST_F(Report, NothingThatStepsReachesTheSeparatrix) {
  for (const std::string& method : rigid_methods) {
    if (method == "exact") continue;
    EXPECT_GT(best_error("case b", method), 1.0) << method;
  }
}

TEST_F(Report, TheFirstFlipIsRightAndTheSecondIsLost) {
  const auto dmv_at = [](double t) {
    for (const Json& row : json["error_over_time"]) {
      if (row["time"] == t) return row["dmv"].get<double>();
    }
    return std::nan("");
  };
  EXPECT_LT(dmv_at(450.0), tolerance(1e-12));  // measured 2.1e-14, after the first flip at 407
  EXPECT_GT(dmv_at(1100.0), 1.0);              // measured 3.1, before the second at 1228
}

TEST_F(Report, EulerLosesTheBook) {
  EXPECT_GT(best_error("case a", "explicit_euler, matrix"), 1.0);
  EXPECT_GT(best_error("case a", "explicit_euler, quaternion"), 1.0);
  EXPECT_GT(best_error("springs", "explicit_euler"), 1.0);
  EXPECT_LT(best_error("case a", "rk4"), 1e-6);
}

TEST_F(Report, HigherOrderIsNearerAtTheSameStep) {
  const double step = 1.25;  // one that all have in common
  const double rk4 = error_at("case a", "rk4", step);
  const double dmv = error_at("case a", "dmv", step);
  EXPECT_LT(1e3 * dmv, rk4);  // measured 6.5e-11 and 3.3e-5
}

TEST_F(Report, RunsThatEndBadlyAreMarked) {
  int diverged = 0;
  for (const Json& run : json["runs"]) {
    const bool finished = run["outcome"] == "finished";
    EXPECT_EQ(finished, run["error"].is_number()) << run;
    diverged += finished ? 0 : 1;
  }
  EXPECT_GT(diverged, 0);  // DMV beyond its reach, springs beyond their limit
}

TEST_F(Report, PredictedAndMeasuredStepLimitsAgree) {
  int compared = 0;
  for (const Json& row : json["step_limits"]) {
    if (!row["measured / predicted - 1"].is_number()) continue;
    EXPECT_NEAR(row["measured / predicted - 1"].get<double>(), 0.0, tolerance(0.01)) << row;  // measured 0.0057
    ++compared;
  }
  EXPECT_EQ(compared, 6);  // three undamped, three damped
}

TEST_F(Report, ExplosionsComeWhenTheyShould) {
  for (const Json& row : json["time_to_explosion"])
    EXPECT_NEAR(row["measured / predicted"].get<double>(), 1.0, tolerance(0.25)) << row;  // measured 0.16
}

TEST_F(Report, FlipsComeAtTheirTimes) {
  std::size_t flips = 0;
  for (const Json& row : json["flip_times"]) {
    if (!row["theory"].is_number() || row["theory"].get<double>() > 399.0) continue;
    for (const auto& [method, time] : row.items()) {
      if (method == "kick") continue;
      ASSERT_TRUE(time.is_number()) << method << row;
      EXPECT_NEAR(time.get<double>(), row["theory"].get<double>(), tolerance(0.5)) << method << row;  // measured 0.22
      ++flips;
    }
  }
  EXPECT_EQ(flips, 2 * (1 + contenders));  // of two kicks, with theory
}

TEST_F(Report, EveryMethodIsTriedOnEveryHardCase) {
  std::map<std::string, int> outcomes;
  for (const Json& row : json["hard_cases"]) {
    EXPECT_EQ(row.size(), 1 + contenders);
    EXPECT_EQ(row["exact"], "right") << row;
    for (const auto& [method, outcome] : row.items()) {
      if (method != "case") ++outcomes[outcome];
    }
  }
  ASSERT_EQ(json["hard_cases"].size(), 12U);
  EXPECT_EQ(json["hard_cases"][0]["dmv"], "right");
  EXPECT_EQ(json["hard_cases"][1]["rk4"], "wrong, shows it");
  EXPECT_GT(outcomes["wrong in silence"], 0);
  EXPECT_EQ(outcomes.size(), 3U);
}

TEST_F(Report, EveryClaimHasAVerdictANumberAndACommand) {
  std::map<std::string, int> verdicts;
  for (const Json& claim : json["claims"]) {
    ++verdicts[claim["verdict"]];
    EXPECT_THAT(claim["command"].get<std::string>(),
                testing::AnyOf(HasSubstr("bookspin check videos/"), testing::Eq("bookspin report")));
    EXPECT_NE(claim["measured"].get<std::string>(), "");
    if (claim["claim"].get<std::string>().find("Euler integration is sufficient") != std::string::npos) {
      EXPECT_EQ(claim["verdict"], "refuted");
    }
  }
  EXPECT_GE(json["claims"].size(), 20U);
  EXPECT_GE(verdicts["supported"], 5);
  EXPECT_GE(verdicts["limited"], 3);
}

TEST_F(Report, PlotsAreDrawn) {
  for (const char* name :
       {"error_over_time", "work_precision_a", "work_precision_b", "work_precision_c", "work_precision_d",
        "work_precision_springs", "step_limits", "time_to_explosion", "flip_times"}) {
    const std::string svg = read_text(folder / (std::string(name) + ".svg"));
    EXPECT_THAT(svg, HasSubstr("</svg>")) << name;
    EXPECT_THAT(svg, HasSubstr("<path")) << name;
  }
}

}  // namespace
}  // namespace bookspin
