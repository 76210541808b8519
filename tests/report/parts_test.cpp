// The report's own machinery: tables, the measuring of a run, the queries of runs, programs, plots, the springs' modes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <set>
#include <stdexcept>
#include <tuple>

#include "dynamics/book.h"
#include "report/draft.h"
#include "report/table.h"
#include "scratch.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Tables, AsCsvAsJsonAndForThePage) {
  const Table table{{"method", "error", "note"}, {{"Euler, \"matrix\"", 1.0 / 3.0, "a"}, {"b", std::nan(""), "c"}}};
  EXPECT_EQ(as_csv({{"kick", "Euler, matrix"}, {}}), "kick,\"Euler, matrix\"\n");
  EXPECT_EQ(as_csv(table), "method,error,note\n\"Euler, \"\"matrix\"\"\",0.3333333333333333,a\nb,,c\n");
  EXPECT_EQ(as_json(table).dump(), R"([{"method":"Euler, \"matrix\"","error":0.3333333333333333,"note":"a"},)"
                                   R"({"method":"b","error":null,"note":"c"}])");
  const nlohmann::json page = for_page(table);
  EXPECT_EQ(page["columns"][1], nlohmann::json({{"text", "error"}, {"number", true}}));
  EXPECT_EQ(page["columns"][2]["number"], false);
  EXPECT_EQ(page["rows"][0]["cells"][0],
            nlohmann::json({{"text", "Euler, \"matrix\""}, {"number", false}, {"head", true}}));
  EXPECT_EQ(page["rows"][0]["cells"][1]["text"], "0.333");
  EXPECT_EQ(page["rows"][1]["cells"][1]["text"], "–");
}

TEST(Tables, NumbersToRead) {
  EXPECT_EQ(readable(1.234e-7), "1.2·10⁻⁷");
  EXPECT_EQ(readable(123456.0), "1.2·10⁵");
  EXPECT_EQ(readable(-0.012345), "-0.0123");
  EXPECT_EQ(readable(12345.6), "12346");
  EXPECT_EQ(readable(3.0), "3");
  EXPECT_EQ(readable(3.001), "3.00");
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(1e-2), "10⁻²");
  EXPECT_EQ(readable(1e-15), "10⁻¹⁵");
  EXPECT_EQ(readable(std::numeric_limits<double>::infinity()), "–");
}

// Stalls after `last`.
struct Toy {
  double state;  // its error
  int last;
  long evaluations = 0;
  bool to(int sample) {
    ++evaluations;
    return sample <= last;
  }
};

TEST(Measuring, MarksWhatDivergesAndWhatStalls) {
  const auto once = [&](double error, int last) {
    return measure(
        1.0, {5, 10.0}, {1'000, 2, 0},
        [&] {
          return Toy{error, last};
        },
        [](double state, int) { return state; });
  };
  EXPECT_EQ(once(0.5, 9).outcome, Outcome::finished);
  EXPECT_EQ(once(0.5, 9).error, 0.5);
  EXPECT_EQ(once(0.5, 9).evaluations, 5);
  EXPECT_GT(once(0.5, 9).ns_per_time, 0.0);
  EXPECT_EQ(once(std::nan(""), 9).outcome, Outcome::diverged);
  EXPECT_EQ(once(std::nan(""), 9).error, none);
  EXPECT_EQ(once(2e3, 9).outcome, Outcome::diverged);
  EXPECT_EQ(once(0.5, 3).outcome, Outcome::stalled);
}

// Where a ladder ends follows from what was done, not from how long it took.
TEST(Measuring, ALadderEndsWhereItMust) {
  const std::vector<int> settings{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const auto rungs = [&](auto outcome_at, auto error_at, long most) {
    const auto run_at = [&](int rung) {
      const double slow = 1e18;  // ns: no matter
      return bookspin::Run{1.0, error_at(rung), slow, 1L << rung, outcome_at(rung)};
    };
    return climb({most, 1, 0}, settings, run_at).size();
  };
  const auto fine = [](int) { return Outcome::finished; };
  const auto stalls = [](int rung) { return rung < 2 ? Outcome::finished : Outcome::stalled; };
  EXPECT_EQ(rungs(
                fine, [](int) { return 3.0; }, 100),
            6U);  // 1 + 2 + ... + 32 = 63, and another 45 would be too many
  EXPECT_EQ(rungs(
                stalls, [](int) { return 1e-3; }, 1'000'000),
            3U);
  EXPECT_EQ(rungs(
                stalls, [](int) { return 1.0; }, 1'000'000),
            5U);
  const auto rounding = [](int rung) { return rung < 3 ? std::pow(1e-3, rung + 1) : 1e-9; };
  EXPECT_EQ(rungs(fine, rounding, 1'000'000), 7U);  // four without gain after the third
}

TEST(Measuring, RungsAreTwoAnOctaveAndEachIsNew) {
  const std::vector<long> every = step_ladder(1.0, 1.0);
  EXPECT_EQ(std::vector<long>(every.begin(), every.begin() + 6), (std::vector<long>{1, 2, 3, 4, 6, 8}));
  const std::vector<long> third = step_ladder(4.0, 3.0);
  EXPECT_EQ(std::vector<long>(third.begin(), third.begin() + 3), (std::vector<long>{4, 12, 32}));
}

constexpr Solver rk4{Method::quaternion, Integrator::rk4};
constexpr Solver dmv{Method::quaternion, Integrator::dmv};

TEST(Queries, SeeFinishedRunsAlone) {
  const Ladder ran{
      rk4, {{1.0, 1e-1, 10.0, 1}, {0.5, 1e-3, 30.0, 1}, {0.2, 1e-5, 20.0, 1}, {0.1, none, 5.0, 1, Outcome::stalled}}};
  const Ladders ladders{ran, {dmv, {{2.0, none, 1.0, 1, Outcome::diverged}}}};
  EXPECT_EQ(ran.nearest().error, 1e-5);
  EXPECT_EQ(ran.cheapest(1e-2).ns_per_time, 20.0);
  EXPECT_EQ(ran.cheapest(0.5).ns_per_time, 10.0);
  EXPECT_EQ(ran.cheapest(1e-6).ns_per_time, none);
  EXPECT_EQ(ran.finest().setting, 0.2);
  EXPECT_EQ(ran.closest(0.4).setting, 0.5);
  EXPECT_EQ(ran.closest(0.01).setting, 0.2);
  EXPECT_EQ(ladder(ladders, dmv).nearest().error, none);
  EXPECT_EQ(ladder(ladders, exact_solver).finest().setting, none);
  EXPECT_EQ(nearest_stepper(ladders).run.setting, 0.2);
  const Table table = cheapest_table(ladders);
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[0][1], 20.0);
  EXPECT_EQ(table.rows[0][3], "never");
  EXPECT_EQ(table.rows[1][5], "none finished");
}

TEST(Queries, TheCheapestOfAllWins) {
  const Ladders ladders{
      {exact_solver, {{0.0, 1e-15, 10.0, 1}}}, {rk4, {{0.5, 1e-3, 5.0, 1}}}, {dmv, {{0.5, 1e-5, 20.0, 1}}}};
  const auto names = [&](bool stepping) {
    std::string text;
    for (const auto& winner : winners(ladders, stepping)) text += winner["name"].get<std::string>() + ' ';
    return text;
  };
  EXPECT_EQ(names(false), "rk4 exact exact exact ");
  EXPECT_EQ(names(true), "rk4 dmv ");  // and nothing for what none of them reaches
}

TEST(Solvers, AreThoseOfTheTableEachWithItsOwnNameAndPen) {
  std::set<std::string> names;
  std::set<std::tuple<std::string, int, int>> pens;
  std::vector<Solver> all = rigid_solvers();
  for (const Solver& solver : odeint_solvers(Method::quaternion)) all.push_back(solver);
  EXPECT_EQ(all.size(), 9U);
  for (const Solver& solver : all) {
    names.insert(name_of(solver));
    const Pen pen = pen_of(solver);
    pens.emplace(pen.color, pen.dash, pen.point);
  }
  EXPECT_EQ(names.size(), all.size());
  EXPECT_EQ(pens.size(), all.size());
  EXPECT_EQ(spring_solvers().size(), 6U);
}

TEST(RigidCases, TheOptionsAreTheSameBody) {
  const auto cases = read_rigid_cases(std::filesystem::path(BOOKSPIN_SOURCE_DIR) / "data/reference");
  ASSERT_EQ(cases.size(), 4U);
  for (const RigidCase& c : cases) {
    EXPECT_EQ(c.q_WB.size(), 60U);
    const BookOptions options = c.options();
    const Eigen::Vector3d I_B = body_of(options).I_B;
    EXPECT_LT((I_B - c.I_B).norm(), tolerance(1e-14) * c.I_B.norm());  // measured 3e-16
    EXPECT_LT((I_B.cwiseProduct(options.omega_W) - c.L_W).norm(), tolerance(1e-14) * c.L_W.norm());
  }
}

TEST(StepLimits, AreNotMadeUp) {
  EXPECT_EQ(predicted_step_limit({.integrator = Integrator::stoermer10}), 0.0);  // no matrix of its step is known
  EXPECT_EQ(predicted_step_limit({.integrator = Integrator::explicit_euler, .damping = 0.0}), 0.0);  // there is none
}

TEST(SpringModes, SixAreRigidAndTheFastestBreathes) {
  const SpringModes modes = spring_modes(BookOptions().size);
  ASSERT_EQ(modes.mu.size(), 24);
  EXPECT_LT(modes.mu.head(6).cwiseAbs().maxCoeff(), tolerance(1e-13));  // measured 2e-15
  EXPECT_GT(modes.mu(6), 0.01);
  EXPECT_NEAR(modes.mu(23), 8.0, tolerance(1e-13));  // all eight corners outward: 8 k / m, whatever the shape
}

TEST(SpringModes, VerletsLimitIsTwoOverTheFastest) {
  BookOptions options;
  options.damping = 0.0;
  options.integrator = Integrator::velocity_verlet;
  EXPECT_NEAR(predicted_step_limit(options), 2.0 / std::sqrt(80.0), tolerance(1e-10));  // measured 4e-12
  options.integrator = Integrator::rk4;
  EXPECT_NEAR(predicted_step_limit(options), std::sqrt(8.0) / std::sqrt(80.0), tolerance(1e-8));  // measured 1e-10
}

TEST(SpringModes, TheFastestAndSoTheLimitIsThatOfAnyShape) {
  BookOptions options;
  options.integrator = Integrator::rk4;
  const double book = predicted_step_limit(options);
  options.size = {1.0, 1.0, 1.0};
  EXPECT_NEAR(predicted_step_limit(options), book, tolerance(1e-12));  // measured 1e-16
}

TEST(Plots, GnuplotsOwnWordsAreTold) {
  Plot plot{"x", "y"};
  plot.more = {"set label 'here' at first nan, 1"};
  plot.series = {{"a line", {{1.0, 1.0}, {2.0, 0.5}}, {}, Mark::line}};
  EXPECT_THAT(
      [&] { (void)svg_of("a.svg", plot); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("a.svg: gnuplot"), HasSubstr("undefined variable: nan"))));
}

TEST(Plots, ATitleMayHoldAnyCharacter) {
  Plot plot{"x", "y"};
  plot.series = {{"a \"line\" \\ 'of' $name", {{1.0, 1.0}, {2.0, 0.5}}, {}, Mark::line}};
  EXPECT_THAT(svg_of("a.svg", plot), HasSubstr("a \"line\" \\ 'of' $name"));
}

TEST(Plots, LeaveOutWhatIsNotFinite) {
  Plot plot{"x", "y"};
  plot.series = {{"holes", {{1.0, 1.0}, {std::nan(""), 0.5}, {3.0, std::nan("")}, {2.0, 0.5}}, {}, Mark::line},
                 {"nothing", {{1.0, std::nan("")}}, {}, Mark::line}};
  const std::string svg = svg_of("a.svg", plot);
  EXPECT_THAT(svg, HasSubstr("holes"));
  EXPECT_THAT(svg, testing::Not(HasSubstr("nothing")));
}

TEST(Plots, ALinesNameStandsAtItWhereThereIsRoom) {
  Plot plot{"x", "y"};
  plot.x_range = {1.0, 100.0};
  plot.y_range = {1.0, 100.0};
  const Points here{{10.0, 10.0}};
  plot.series = {{"above", {{10.0, 50.0}}, {}, Mark::points}};
  for (const char* name : {"first one here", "second one here", "third one here", "fourth one here", "fifth one here"})
    plot.series.push_back({name, here, {}, Mark::points});
  plot.series.push_back({"", {{30.0, 3.0}}, {}, Mark::points});
  const std::string svg = svg_of("a.svg", plot);
  for (const char* name : {"<text>above<", "<text>first one here<", "<text>fourth one here<"})
    EXPECT_THAT(svg, HasSubstr(name));
  EXPECT_THAT(svg, testing::Not(HasSubstr("<text>fifth one here<")));  // on each side of the point there is one already
}

TEST(Plots, AMissingGnuplotIsNamedWithItsPackage) {
  const Scratch scratch;
  const std::string path = std::getenv("PATH");
  setenv("PATH", scratch.folder().c_str(), 1);
  EXPECT_THAT([] { require_gnuplot(); }, ThrowsMessage<std::runtime_error>(HasSubstr("package gnuplot-nox")));
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace bookspin
