#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "dynamics/rigid_motion.h"
#include "files/files.h"
#include "report/draft.h"
#include "report/odeint.h"

// Speed against error of the springs: the farthest that a corner is from where it should be, in half diagonals of the
// book, against the springs' own motion (data/reference/ref_springs.txt) and against the rigid body's.

namespace bookspin {
namespace {

using SpringVector = std::array<double, 24>;  // positions, velocities of half the corners: SpringBook::Half, twice
using HalfCorners = Eigen::Matrix<double, 4, 3>;
using ConstCorners = Eigen::Map<const Corners>;
using Motion = std::vector<Corners>;  // one a sample

// For Odeint: the forces that the program's own methods have.
struct HalvedSystem {
  SpringBook book;

  void operator()(const SpringVector& s, SpringVector& d, double /*t*/) const {
    SpringBook::Half x, v;
    std::copy_n(s.begin(), x.size(), x.begin());
    std::copy_n(s.begin() + x.size(), v.size(), v.begin());
    const SpringBook::Half a = book.accelerations(x, v);
    std::copy(v.begin(), v.end(), d.begin());
    std::copy(a.begin(), a.end(), d.begin() + v.size());
  }
};

// For Odeint, too: those of the paper, one by one, of all corners.
using WholeState = std::array<double, 48>;  // positions, velocities
struct WholeSystem {
  SpringBook book;
  double particle_mass;

  void operator()(const WholeState& s, WholeState& d, double /*t*/) const {
    const ConstCorners x(s.data());
    const ConstCorners v(s.data() + x.size());
    Eigen::Map<Corners>(d.data()) = v;
    Eigen::Map<Corners>(d.data() + x.size()) = book.forces(x, v).F_W / particle_mass;
  }
};

Corners corners_of(const auto& book) {
  return book.corners_W();
}
Corners corners_of(const WholeState& state) {
  return ConstCorners(state.data());
}
Corners corners_of(const SpringVector& state) {
  const Eigen::Matrix<double, 3, 4> half = Eigen::Map<const HalfCorners>(state.data()).transpose();
  Corners corners;
  corners << half, -half.rowwise().reverse();
  return corners;
}

double farthest(const Corners& a, const Corners& b, const BookOptions& options) {
  return (a - b).colwise().norm().maxCoeff() / body_of(options).reach;
}

// The motion of ref_springs.txt: k = 10, m = 1, the unit of time about one turn in six.
BookOptions reference_options() {
  return options_for({Method::springs}, kicked(body_of(BookOptions()).I_B.x(), 1e-3));
}

BookOptions book_of_case_a(double stiffness) {
  return kicked(2.0, 1e-3, {.stiffness = stiffness});  // whose particles have half the mass
}

Motion read_motion(const std::filesystem::path& file) {
  std::istringstream in(read_file(file));
  Motion motion;
  std::array<double, 48> row;
  while (std::all_of(row.begin(), row.end(), [&](double& number) { return static_cast<bool>(in >> number); }))
    motion.emplace_back(ConstCorners(row.data()));
  if (motion.empty()) throw std::runtime_error(file.string() + ": holds no motion");
  return motion;
}

Motion rigid_motion(const BookOptions& options, const Course& course) {
  const TorqueFree motion = exact_motion(options);
  const Corners rest = body_of(options).corners_B;
  Motion x;
  for (int i = 1; i <= course.samples; ++i)
    x.emplace_back(motion.at(i * course.interval()).q_WB.toRotationMatrix() * rest);
  return x;
}

Motion spring_motion(const BookOptions& options, const Course& course, double h) {
  const auto steps = static_cast<long>(std::ceil(course.interval() / h));
  Stepped<SpringBook> runner{SpringBook(options), course.interval() / static_cast<double>(steps), steps, 1};
  Motion x;
  for (int i = 0; i < course.samples && runner.to(i); ++i) x.push_back(runner.state.corners_W());
  return x;
}

// How far a run's corners are from the motion at sample i.
auto distance_from(const Motion& motion, const BookOptions& options) {
  return [&motion, &options](const auto& book, int i) {
    return farthest(corners_of(book), motion[static_cast<std::size_t>(i)], options);
  };
}

struct AgainstTheirOwnMotion {
  Ladders ladders;  // every method with the program's forces
  Ladders whole;    // Odeint's with all springs, one by one
};

AgainstTheirOwnMotion against_their_own_motion(const Motion& expected, const Effort& effort) {
  const Course course{static_cast<int>(expected.size()), 200.0, 4.0};
  const BookOptions options = reference_options();
  const auto error = distance_from(expected, options);
  auto [ladders, whole] = AgainstTheirOwnMotion();
  climb_all(spring_solvers(), options, course, effort, ladders, error);
  const HalvedSystem system{SpringBook(options)};
  SpringVector start{};
  Eigen::Map<HalfCorners>(start.data()) = system.book.corners_W().leftCols<4>().transpose();
  Eigen::Map<HalfCorners>(start.data() + 12) = system.book.velocities_W().leftCols<4>().transpose();
  climb_odeint(Method::springs, start, system, 0.01, course, effort, ladders, error);
  const WholeSystem whole_system{SpringBook(options), options.particle_mass};
  WholeState whole_start{};
  Eigen::Map<Corners>(whole_start.data()) = system.book.corners_W();
  Eigen::Map<Corners>(whole_start.data() + 24) = system.book.velocities_W();
  climb_odeint(Method::springs, whole_start, whole_system, 0.01, course, effort, whole, error);
  return {std::move(ladders), std::move(whole)};
}

// Of those that `take` takes, the one that reaches 1e-6 at the least cost.
template <class Take>
Best cheapest_within_1e_6(const Ladders& ladders, Take&& take) {
  Best best;
  for (const Ladder& ladder : ladders) {
    const Run run = ladder.cheapest(1e-6);
    if (take(ladder.solver) && run.ns_per_time < best.run.ns_per_time) best = {ladder.solver, run};
  }
  return best;
}

Integrator of_highest_order(bool damped) {
  Integrator best = Integrator::explicit_euler;
  for (const IntegratorInfo& row : integrators) {
    if (takes(Method::springs, damped, row) && row.order > info_of(best).order) best = row.id;
  }
  return best;
}

// The book of case a under three models, at the step of the paper's program. Each model's own motion is computed by the
// highest order that the table has for it, and by far smaller steps.
constexpr double papers_step = 0.1 / 6.0;

ModelError model_error(double stiffness, bool damped, bool normalized, const Course& course) {
  BookOptions options = book_of_case_a(stiffness);
  options.damping = damped ? 1.0 : 0.0;
  options.normalize_every = normalized ? 1 : 0;
  const Motion rigid = rigid_motion(options, course);
  options.integrator = of_highest_order(damped);
  const Motion own = spring_motion(options, course, 0.02 / std::sqrt(stiffness));
  options.integrator = damped ? Integrator::explicit_euler : Integrator::velocity_verlet;
  const Motion x = spring_motion(options, course, papers_step);
  const auto largest = [&](const Motion& a, const Motion& b) {
    double result = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double error = farthest(a[i], b[i], options);
      result = error < 1e3 ? std::max(result, error) : none;
    }
    return result;
  };
  return {stiffness, damped, normalized, options.integrator, largest(x, own), largest(own, rigid), largest(x, rigid)};
}

}  // namespace

void spring_precision(Draft& draft) {
  Effort effort = draft.effort;
  effort.most_evaluations *= 2;
  effort.repeats = 1;
  draft.say("their own motion");
  auto [ladders, whole] =
      against_their_own_motion(read_motion(draft.order.project / "data" / "reference" / "ref_springs.txt"), effort);
  const Ladders& springs = draft.runs[Problem::springs] = std::move(ladders);
  draft.keep("cheapest_springs", cheapest_table(springs));
  draft.keep("cheapest_springs_one_by_one", cheapest_table(whole));
  draft.plot("work_precision_springs",
             work_precision_plot(springs, "largest error, half diagonals, from the springs' own motion", 1e-11));

  draft.keep("runs", runs_table(draft.runs));
  const Course course{60, effort.quick ? 100.0 : 600.0, 16.0};
  draft.say("the model's error");
  for (const double k : effort.quick ? std::vector<double>{10.0} : std::vector<double>{10.0, 100.0, 1000.0}) {
    for (const auto& [damped, normalized] : {std::pair{false, false}, {true, false}, {true, true}})
      draft.model_errors.push_back(model_error(k, damped, normalized, course));
  }
  Table table{{"stiffness", "springs", "integrator", "integration error", "model error", "all: from the rigid motion"},
              {}};
  nlohmann::json stiffer = nlohmann::json::array();  // what ten times the stiffness makes of the undamped model's error
  const ModelError* before = nullptr;
  for (const ModelError& e : draft.model_errors) {
    const char* const springs_are = !e.damped ? "undamped" : e.normalized ? "damped and normalized" : "damped";
    table.rows.push_back({e.stiffness, springs_are, std::string(info_of(e.integrator).name),
                          number_or("exploded", e.integration), number_or("exploded", e.model),
                          number_or("exploded", e.all)});
    if (e.damped) continue;
    if (before != nullptr)
      stiffer.push_back({{"from", before->stiffness}, {"to", e.stiffness}, {"by", before->model / e.model}});
    before = &e;
  }
  draft.keep("spring_model_error", table);
  const ModelError& undamped = draft.model_errors[0];
  const ModelError& damped = draft.model_errors[1];
  const Solver verlet{Method::springs, Integrator::velocity_verlet};
  const std::vector<Run>& verlets = ladder(springs, verlet).runs;
  const auto finest = [&](const Solver& solver) {
    const Run run = ladder(springs, solver).finest();
    return nlohmann::json{{"h", run.setting}, {"error", run.error}};
  };
  const auto is_odeint = [](const Solver& solver) { return solver.odeint.has_value(); };
  const Best ours = cheapest_within_1e_6(springs, std::not_fn(is_odeint));
  const Best theirs = cheapest_within_1e_6(springs, is_odeint);
  const Best theirs_whole = cheapest_within_1e_6(whole, is_odeint);
  const auto beside_ours = [&](const Best& best) {
    return nlohmann::json{{"name", name_of(best.solver)}, {"times", best.run.ns_per_time / ours.run.ns_per_time}};
  };
  draft.page["springs"] = {
      {"any", winners(springs, false)},
      {"euler", finest({Method::springs})},
      {"verlet", finest(verlet)},
      {"verlet_runs", verlets.size()},
      {"verlet_diverged",
       std::count_if(verlets.begin(), verlets.end(), [](const Run& run) { return run.outcome != Outcome::finished; })},
      {"verlet_limit", predicted_step_limit(options_for(verlet, BookOptions()))},
      {"turn", 2.0 * std::numbers::pi / reference_options().omega_W.norm()},
      {"T", course.T},
      {"h", papers_step},
      {"stiffer", std::move(stiffer)},
      {"odeint", theirs.run.error < none && theirs_whole.run.error < none && ours.run.error < none
                     ? nlohmann::json{{"ours", name_of(ours.solver)},
                                      {"halved", beside_ours(theirs)},
                                      {"whole", beside_ours(theirs_whole)}}
                     : nlohmann::json()},
      {"damping_changes_more", damped.model > undamped.model},
      {"damped_model", damped.model},
      {"undamped_model", undamped.model}};
}

}  // namespace bookspin
