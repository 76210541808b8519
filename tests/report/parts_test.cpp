// The report's own machinery: tables, the page's template, the measuring of a run, the springs' modes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "dynamics/book.h"
#include "report/measure.h"
#include "report/page.h"
#include "report/plots.h"
#include "report/program.h"
#include "report/stability.h"
#include "report/table.h"
#include "report/work_precision.h"
#include "scratch.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Tables, AsCsvAndHtml) {
  const Table table{"t", {"method", "error"}, {{"Euler, \"matrix\"", 1.0 / 3.0}, {"never", std::nan("")}}};
  EXPECT_EQ(as_csv(table), "method,error\n\"Euler, \"\"matrix\"\"\",0.33333333\nnever,\n");
  EXPECT_THAT(as_html(table), HasSubstr("<td class=\"n\">0.333</td>"));
  EXPECT_THAT(as_html(table), HasSubstr("<td class=\"n\">–</td>"));
  EXPECT_THAT(as_json({table}, {{"commit", "c"}}), HasSubstr("\"error\": null"));
}

TEST(Tables, NumbersToRead) {
  EXPECT_EQ(readable(1.234e-7), "1.2·10⁻⁷");
  EXPECT_EQ(readable(123456.0), "1.2·10⁵");
  EXPECT_EQ(readable(-0.012345), "-0.0123");
  EXPECT_EQ(readable(12345.6), "12346");
  EXPECT_EQ(readable(3.0), "3");
  EXPECT_EQ(readable(3.001), "3.00");
  EXPECT_EQ(readable(0.0), "0");
  EXPECT_EQ(readable(std::numeric_limits<double>::infinity()), "–");
}

TEST(Page, AsksForEveryValueAndForNoOther) {
  const Scratch scratch;
  write_text(scratch / "page.html", "<p>{{a}} and {{b}}</p>");
  EXPECT_EQ(fill_page(scratch / "page.html", {{"a", "1"}, {"b", "{{2}}"}}), "<p>1 and {{2}}</p>");
  EXPECT_THAT(
      [&] {
        (void)fill_page(scratch / "page.html", {{"a", "1"}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("{{b}}")));
  EXPECT_THAT(
      [&] {
        (void)fill_page(scratch / "page.html", {{"a", ""}, {"b", ""}, {"c", ""}});
      },
      ThrowsMessage<std::runtime_error>(HasSubstr("{{c}} is nowhere asked for")));
  EXPECT_THROW((void)fill_page(scratch / "none.html", {}), std::runtime_error);
}

// Halves its error with every halving of the step, diverges where it is coarse, stalls where it is fine.
struct Toy {
  double error;
  int last;
  long taken = 0;
  bool to(int sample) {
    ++taken;
    return sample <= last;
  }
  [[nodiscard]] long evaluations() const { return taken; }
};

TEST(Measuring, MarksWhatDivergesAndWhatStalls) {
  const Effort effort{1'000, 2};
  const auto once = [&](double error, int last) {
    bookspin::Run run{"toy", "toy", 1.0};
    measure(
        run, 5, 10.0, effort,
        [&] {
          return Toy{error, last};
        },
        [&](const Toy& toy, int) {
          run.error = std::max(run.error, toy.error);
          return std::isfinite(toy.error);
        });
    return run;
  };
  EXPECT_EQ(once(0.5, 9).outcome, Outcome::finished);
  EXPECT_EQ(once(0.5, 9).error, 0.5);
  EXPECT_GT(once(0.5, 9).ns_per_time, 0.0);
  EXPECT_EQ(once(std::nan(""), 9).outcome, Outcome::diverged);
  EXPECT_TRUE(std::isnan(once(std::nan(""), 9).error));
  EXPECT_EQ(once(0.5, 3).outcome, Outcome::stalled);
}

// Where a ladder ends follows from what was done, not from how long it took.
TEST(Measuring, ALadderEndsWhereItMust) {
  const std::vector<int> settings{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const auto rungs = [&](auto outcome_at, auto error_at, long most) {
    std::vector<bookspin::Run> runs;
    climb({most, 1}, settings, runs, [&](int rung) {
      const double slow = 1e18;  // ns: no matter
      return bookspin::Run{"toy", "toy", 1.0, error_at(rung), slow, 1L << rung, outcome_at(rung)};
    });
    return runs.size();
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

TEST(Programs, AreAnsweredInFull) {
  const Finished echo = run_program("sh", {"-c", "cat; echo \"$1\" >&2; exit 3", "sh", "a 'quoted' $name"}, "in\n");
  EXPECT_EQ(echo.status, 3);
  EXPECT_EQ(echo.out, "in\n");
  EXPECT_EQ(echo.errors, "a 'quoted' $name\n");
  EXPECT_EQ(run_program("sh", {"-c", "kill -9 $$"}, "").status, 128 + 9);
  EXPECT_EQ(run_program("no-such-program", {}, "").status, program_not_found);
}

TEST(Cheapest, IsTheFastestThatIsNearEnough) {
  const std::vector<bookspin::Run> runs{{"p", "m", 1.0, 1e-1, 10.0, 1, Outcome::finished},
                                        {"p", "m", 0.5, 1e-3, 30.0, 1, Outcome::finished},
                                        {"p", "m", 0.2, 1e-5, 20.0, 1, Outcome::finished},
                                        {"p", "n", 0.2, std::nan(""), 5.0, 1, Outcome::diverged}};
  const Table table = cheapest(runs, "p", {1e-2, 1e-6});
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(std::get<double>(table.rows[0][1]), 20.0);
  EXPECT_EQ(std::get<std::string>(table.rows[0][2]), "never");
  EXPECT_EQ(std::get<std::string>(table.rows[1][1]), "never");
  EXPECT_EQ(std::get<std::string>(table.rows[1][3]), "none finished");
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

TEST(StepLimits, AreNotMadeUpForAnIntegratorWhoseLinearStepIsNotKnown) {
  EXPECT_THROW(static_cast<void>(predicted_step_limit(unnormalized_springs(10.0, 0.0, Integrator::composition8))),
               std::invalid_argument);
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

TEST(Plots, GnuplotsOwnWordsAreTold) {
  const Scratch scratch;
  Plot plot{"x", "y"};
  plot.more = {"set label 'here' at first nan, 1"};
  plot.series = {{"rk4", {{1.0, 1.0}, {2.0, 0.5}}, Mark::line, ""}};
  EXPECT_THAT(
      [&] { draw_plot(scratch / "a.svg", plot); },
      ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("a.svg: gnuplot"), HasSubstr("undefined variable: nan"))));
  EXPECT_FALSE(std::filesystem::exists(scratch / "a.svg"));
}

TEST(Plots, AMissingGnuplotIsNamedWithItsPackage) {
  const Scratch scratch;
  const std::string path = std::getenv("PATH");
  setenv("PATH", scratch.folder().c_str(), 1);
  EXPECT_THAT([] { require_gnuplot(); }, ThrowsMessage<std::runtime_error>(HasSubstr("package gnuplot-nox")));
  setenv("PATH", path.c_str(), 1);
}

TEST(Plots, WithoutAFolderTheFileIsNamed) {
  Plot plot{"x", "y"};
  plot.series = {{"rk4", {{1.0, 1.0}, {2.0, 0.5}}, Mark::line, ""}};
  EXPECT_THAT([&] { draw_plot("/proc/nowhere/a.svg", plot); },
              ThrowsMessage<std::runtime_error>(HasSubstr("/proc/nowhere/a.svg")));
}

}  // namespace
}  // namespace bookspin
