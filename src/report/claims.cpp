#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "dynamics/rigid_book.h"
#include "report/draft.h"
#include "scene/judge.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

// The paper's claims, each with the number that supports, limits or refutes it and the command that shows it again.
//
// A trial is a scene script of videos/ with overrides, judged by expectations written into it: exactly what
// `bookspin check SCRIPT --set ... --set 'expect=[...]'` prints as "found". The verdict is computed from what was found.

namespace bookspin {
namespace {

constexpr const char* supported = "supported";
constexpr const char* limited = "limited";
constexpr const char* refuted = "refuted";
constexpr const char* not_measured = "not measured";

constexpr Solver euler_quaternion{Method::quaternion, Integrator::explicit_euler};
constexpr Solver rk4_quaternion{Method::quaternion, Integrator::rk4};

struct Trial {
  std::string script;
  std::vector<std::string> overrides;
  std::vector<std::string> expect;  // inline tables, with one bound each
};

struct Answer {
  const char* verdict;
  std::string measured;
};

using Found = std::vector<Verdict>;  // one an expectation, trial by trial

struct Claim {
  const char* section;
  const char* text;
  std::vector<Trial> trials;  // none: the numbers are those of other sections
  std::function<Answer(const Found& found, const Draft& draft)> answer;
};

const char* yes(bool holds, const char* otherwise = refuted) {
  return holds ? supported : otherwise;
}

std::string exploded_in(const Verdict& v) {
  return v.met ? fmt::format("explodes in frame {}", v.frame) : "does not explode";
}
double frame_or_never(const Verdict& v) {
  return v.met ? v.frame : 1e9;
}

constexpr const char* explodes = "{quantity=\"exploded\", rises_to=1}";

std::string most(const char* quantity, const char* frames = "") {
  return fmt::format("{{quantity=\"{}\", {}at_most=1e9}}", quantity,
                     *frames == 0 ? "" : fmt::format("frames={}, ", frames));
}
std::string at_frame(const char* quantity, int frame) {
  return fmt::format("{{quantity=\"{}\", frame={}, at_most=1e9}}", quantity, frame);
}

double step_ns(auto book) {
  return least_ns(30,
                  [&] {
                    for (int i = 0; i < 500; ++i) book.step(1e-3);
                  }) /
         500.0;
}

std::vector<Claim> list_of_claims(bool quick) {
  const std::string many = quick ? "clip.substeps=100" : "clip.substeps=1000";
  const std::string longer = quick ? "clip.frames=800" : "clip.frames=20000";
  const int last_of_longer = quick ? 799 : 19999;
  return {
      {"5.1",
       "Rotation about z, the axis of the largest moment, is stable even when jiggled (Fig. 3).",
       {{"fig03_stable_z", {"book.0.jiggle=0.03", longer}, {most("tilt")}}},
       [](const Found& f, const Draft&) {
         return Answer{yes(f[0].found < 10.0),
                       fmt::format("After a jiggle of 3 % the tilt never passes {}°.", readable(f[0].found))};
       }},
      {"5.1",
       "Rotation about y, the axis of the smallest moment, is stable even when jiggled (Fig. 4).",
       {{"fig04_stable_y", {"book.0.jiggle=0.03"}, {most("tilt")}},
        {"fig04_stable_y", {"book.0.jiggle=0.03", longer}, {most("tilt")}}},
       [last_of_longer](const Found& f, const Draft&) {
         return Answer{f[1].found < 10.0   ? supported
                       : f[0].found < 10.0 ? limited
                                           : refuted,
                       fmt::format("In the film the tilt never passes {}°, in a run of {} units of time {}°.",
                                   readable(f[0].found), 0.5 * (last_of_longer + 1), readable(f[1].found))};
       }},
      {"5.1",
       "Rotation about x is an unstable equilibrium: numerical inaccuracies suffice to turn the book over (Fig. 5).",
       {{"fig05_unstable_x",
         {"book.0.jiggle=0", quick ? "clip.frames=1100" : "clip.frames=1400"},
         {"{quantity=\"tilt\", rises_to=90}"}}},
       [](const Found& f, const Draft& draft) {
         return Answer{yes(f[0].met), fmt::format("Without any jiggle the damped springs tilt to {}° by frame {}: "
                                                  "rounding alone, grown e-fold every {} units of time.",
                                                  readable(f[0].found), f[0].frame,
                                                  readable(draft.page["sigma"]["e_fold"].get<double>()))};
       }},
      {"5.1",
       "The particle simulation runs sufficiently fast on a standard computer.",
       {},
       [](const Found&, const Draft& draft) {
         return Answer{
             yes(draft.cost.dynamics < 1000.0 / 60.0),
             fmt::format(
                 "{} ms of CPU a film frame (30 steps): {} times faster than the film at 60 frames a second plays.",
                 readable(draft.cost.dynamics), readable(1000.0 / 60.0 / draft.cost.dynamics))};
       }},
      {"5.1",
       "Damping is necessary: without it the rotation is quickly turned into vibration (Fig. 6).",
       {{"fig06_undamped", {}, {at_frame("angular_momentum_ratio", 719)}},
        {"fig06_undamped", {"book.0.damping=1"}, {at_frame("angular_momentum_ratio", 719)}},
        {"fig06_undamped",
         {"book.0.integrator=velocity_verlet", "book.0.normalize=false"},
         {at_frame("angular_momentum_ratio", 719), most("energy_ratio")}}},
       [](const Found& f, const Draft&) {
         return Answer{f[0].found < 0.5 ? (f[2].found > 0.99 ? limited : supported) : refuted,
                       fmt::format("True of explicit Euler: after 720 frames |L|/L₀ is {} undamped, {} damped. Not of "
                                   "the model: velocity Verlet, undamped and not "
                                   "normalized, keeps |L| to {} and the energy within {}.",
                                   readable(f[0].found), readable(f[1].found), readable(std::abs(f[2].found - 1.0)),
                                   readable(f[3].found - 1.0))};
       }},
      {"5.1",
       "Normalization is necessary: without it the energy grows, the book runs faster and faster and explodes (Fig. "
       "7).",
       {{"fig07_unnormalized", {}, {explodes, at_frame("energy_ratio", 330)}},
        {"fig07_unnormalized", {"book.0.integrator=rk4"}, {explodes, at_frame("energy_ratio", 719)}}},
       [](const Found& f, const Draft&) {
         return Answer{f[0].met ? (f[2].met ? supported : limited) : refuted,
                       fmt::format("Explicit Euler: E/E₀ = {} in frame 330, {}. RK4 with the same step and no "
                                   "normalization: {}, E/E₀ = {} in the last frame.",
                                   readable(f[1].found), exploded_in(f[0]), exploded_in(f[2]), readable(f[3].found))};
       }},
      {"5.1",
       "With neither, the simulation diverges very quickly (Fig. 8).",
       {{"fig08_neither", {}, {explodes}}, {"fig08_neither", {"book.0.damping=1"}, {explodes}}},
       [](const Found& f, const Draft&) {
         return Answer{yes(f[0].met && frame_or_never(f[0]) < frame_or_never(f[1])),
                       fmt::format("Undamped it {}, damped it {}.", exploded_in(f[0]), exploded_in(f[1]))};
       }},
      {"5.1",
       "Approximately 1000 smaller iterations a frame delay these problems substantially.",
       {{"fig08_neither", {"clip.frames=2000"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000", many}, {explodes}},
        {"fig07_unnormalized", {"clip.frames=2000", many}, {explodes}}},
       [quick](const Found& f, const Draft&) {
         return Answer{yes(frame_or_never(f[1]) > 10.0 * frame_or_never(f[0])),
                       fmt::format("With 3 steps a frame the undamped book {}; with {} steps within 2000 frames it {}, "
                                   "and the damped book of Fig. 7 {}. The delay is "
                                   "proportional to the number of steps: see time to explosion.",
                                   exploded_in(f[0]), quick ? 100 : 1000, exploded_in(f[1]), exploded_in(f[2]))};
       }},
      {"3.1",
       "A smaller spring constant delays the divergence.",
       {{"fig08_neither", {"clip.frames=2000", "book.0.stiffness=5"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000", "book.0.stiffness=40"}, {explodes}}},
       [](const Found& f, const Draft&) {
         return Answer{yes(frame_or_never(f[0]) > frame_or_never(f[1]) && frame_or_never(f[1]) > frame_or_never(f[2])),
                       fmt::format("k = 5: {}; k = 10: {}; k = 40: {}.", exploded_in(f[0]), exploded_in(f[1]),
                                   exploded_in(f[2]))};
       }},
      {"3.3",
       "Damping and normalization together give a reasonable simulation indefinitely.",
       {{"fig05_unstable_x",
         {longer},
         {most("stretch"), at_frame("energy_ratio", last_of_longer),
          at_frame("angular_momentum_ratio", last_of_longer)}}},
       [](const Found& f, const Draft&) {
         const bool keeps = std::abs(f[2].found - 1.0) < 0.01;
         return Answer{
             f[0].found < 0.05 ? (keeps ? supported : limited) : refuted,
             fmt::format(
                 "Over the whole run of {} frames the stretch stays below {}; at its end E/E₀ = {} and |L|/L₀ = {}{}",
                 f[1].frame + 1, readable(f[0].found), readable(f[1].found), readable(f[2].found),
                 keeps ? "." : ": the shape and the energy are kept, the angular momentum is not.")};
       }},
      {"3.3",
       "A more serious source of global error than the integration is the model: the book is not a bunch of springs.",
       {},
       [](const Found&, const Draft& draft) {
         const ModelError& undamped = draft.model_errors[0];  // of k = 10, as the paper's
         const ModelError& paper = draft.model_errors[2];
         return Answer{
             yes(paper.model > paper.integration, paper.model > 0.1 * paper.integration ? limited : refuted),
             fmt::format("The paper's springs (k = {}, damped, normalized), case a at the paper's step: "
                         "integration error {}, model error {} half diagonals. Undamped, with {}: {} and {}.",
                         readable(paper.stiffness), readable(paper.integration), readable(paper.model),
                         info_of(undamped.integrator).name, readable(undamped.integration), readable(undamped.model))};
       }},
      {"5.2",
       "The orientation matrix, with normalization, gives a natural looking result (Fig. 9).",
       {{"fig09_matrix", {}, {at_frame("flips", 959), most("orthogonality_defect"), most("angle_error")}}},
       [](const Found& f, const Draft&) {
         return Answer{
             f[0].found >= 2.0 && f[1].found < 1e-10 ? (f[2].found < 0.1 ? supported : limited) : refuted,
             fmt::format(
                 "{} flips, |RᵀR − 1| below {}: it looks right. But the angle to the true orientation reaches {} rad.",
                 readable(f[0].found), readable(f[1].found), readable(f[2].found))};
       }},
      {"5.2",
       "With a larger time step the results are also good, slightly less consistent (Fig. 9, external video).",
       {{"fig09_matrix", {}, {most("angle_error", "[0, 300]"), most("tilt", "[600, 959]")}},
        {"fig09b_matrix_large_step", {}, {most("angle_error", "[0, 300]"), most("tilt", "[600, 959]")}}},
       [](const Found& f, const Draft&) {
         return Answer{
             f[3].found < f[1].found - 5.0 ? limited : supported,
             fmt::format("In the first 300 frames the error reaches {} rad at 30 steps a frame and "
                         "{} rad at 4; later the small step's tilt still "
                         "reaches {}°, the large one's {}°.",
                         readable(f[0].found), readable(f[2].found), readable(f[1].found), readable(f[3].found))};
       }},
      {"5.2",
       "Without normalization the book changes shape and the simulation eventually breaks down (Fig. 10).",
       {{"fig10_matrix_unnormalized", {}, {at_frame("largest_singular_value", 200), explodes}}},
       [](const Found& f, const Draft&) {
         return Answer{yes(f[0].found > 1.1 && f[1].met), fmt::format("By frame 200 it has grown {} times; it {}.",
                                                                      readable(f[0].found), exploded_in(f[1]))};
       }},
      {"5.2",
       "The quaternion looks the same as the matrix.",
       {{"fig09_matrix", {}, {most("tilt", "[0, 400]")}},
        {"fig09_matrix", {"book.0.method=quaternion"}, {most("tilt", "[0, 400]")}}},
       [](const Found& f, const Draft&) {
         const bool same =
             std::abs(f[0].frame - f[1].frame) <= 0.05 * f[0].frame && std::abs(f[0].found - f[1].found) < 5.0;
         return Answer{
             yes(same, limited),
             fmt::format(
                 "The first flip is complete in frame {} for the matrix ({}°), in frame {} for the quaternion ({}°).",
                 f[0].frame, readable(f[0].found), f[1].frame, readable(f[1].found))};
       }},
      {"5.2",
       "Not normalized, the quaternion often diverges later than the matrix, but not always (Figs. 10, 11).",
       {{"fig10_matrix_unnormalized", {"clip.frames=4000"}, {explodes}},
        {"fig10_matrix_unnormalized", {"clip.frames=4000", "book.0.method=quaternion"}, {explodes}},
        {"fig11_quaternion_unnormalized", {"clip.frames=4000", "book.0.method=matrix"}, {explodes}},
        {"fig11_quaternion_unnormalized", {"clip.frames=4000"}, {explodes}},
        {"fig12_pulsating_quaternion", {"clip.frames=4000", "book.0.method=matrix"}, {explodes}},
        {"fig12_pulsating_quaternion", {"clip.frames=4000"}, {explodes}}},
       [](const Found& f, const Draft&) {
         int later = 0;
         std::string text;
         for (std::size_t i = 0; i < 6; i += 2) {
           later += frame_or_never(f[i + 1]) > frame_or_never(f[i]) ? 1 : 0;
           text += fmt::format("{}: matrix {}, quaternion {}. ",
                               i == 0   ? "Fig. 10"
                               : i == 2 ? "Fig. 11"
                                        : "Fig. 12",
                               exploded_in(f[i]), exploded_in(f[i + 1]));
         }
         return Answer{later >= 2 ? supported : limited, text + fmt::format("Later in {} of 3.", later)};
       }},
      {"5.2",
       "The denormalized quaternion makes the book pulsate (Fig. 12).",
       {{"fig12_pulsating_quaternion", {}, {at_frame("pulsations", 659), most("blend_defect")}}},
       [](const Found& f, const Draft&) {
         return Answer{
             yes(f[0].found >= 2.0),
             fmt::format(
                 "{} pulsations. They are the blend (1 − s²)·1 + s²·R of the book with its unrotated self, to {}.",
                 readable(f[0].found), readable(f[1].found))};
       }},
      {"4.4",
       "Normalizing a quaternion is much cheaper than normalizing a matrix by SVD.",
       {},
       [](const Found&, const Draft&) {
         BookOptions options;
         options.omega_W = {0.11482, 1e-4, 5e-5};
         BookOptions never = options;
         never.normalize_every = 0;
         const double matrix = step_ns(MatrixBook(options));
         const double quaternion = step_ns(QuaternionBook(options));
         const double svd = matrix - step_ns(MatrixBook(never));
         const double division = quaternion - step_ns(QuaternionBook(never));
         return Answer{yes(svd > 3.0 * division),
                       fmt::format("SVD {} ns, quaternion {} ns; a whole step {} ns against {} ns.", readable(svd),
                                   readable(std::max(division, 0.0)), readable(matrix), readable(quaternion))};
       }},
      {"6",
       "Normalization need not be done in every step.",
       {{"fig09_matrix", {}, {most("angle_error", "[0, 300]")}},
        {"fig09_matrix",
         {"book.0.normalize_every=100"},
         {most("angle_error", "[0, 300]"), most("orthogonality_defect")}},
        {"fig09_matrix", {"book.0.normalize=false"}, {most("orthogonality_defect", "[0, 300]")}}},
       [](const Found& f, const Draft&) {
         const bool same = f[1].found < 1.5 * f[0].found && f[2].found < 0.01;
         return Answer{
             yes(same, limited),
             fmt::format("Every 100 steps: |RᵀR − 1| stays below {} (without: {} after 300 frames), and the error "
                         "after 300 frames is {} rad instead of {}.",
                         readable(f[2].found), readable(f[3].found), readable(f[1].found), readable(f[0].found))};
       }},
      {"6",
       "A higher order method (RK4) has a smaller error in every step but is computationally more expensive.",
       {},
       [](const Found&, const Draft& draft) {
         const Run* euler = run_near(draft.runs, Problem::case_a, euler_quaternion, 0.1 / 6.0);
         const Run* rk4 = run_near(draft.runs, Problem::case_a, rk4_quaternion, 0.1 / 6.0);
         if (euler == nullptr || rk4 == nullptr) return Answer{not_measured, "No run near h = 0.1/6 finished."};
         const double eulers_best = best_error(draft.runs, Problem::case_a, euler_quaternion);
         const Run* enough = cheapest_run(draft.runs, Problem::case_a, rk4_quaternion, eulers_best);
         const bool cheaper = enough != nullptr && enough->ns_per_time < euler->ns_per_time;
         std::string text = fmt::format(
             "At h ≈ {} a unit of time costs {} ns by Euler on the quaternion (error {} rad) and {} ns by RK4 (error "
             "{}).",
             readable(rk4->setting), readable(euler->ns_per_time), readable(euler->error), readable(rk4->ns_per_time),
             readable(rk4->error));
         if (enough != nullptr) {
           text += fmt::format(" But RK4 at h = {}, for {} ns, is off by {}; Euler at its best step tried by {}.",
                               readable(enough->setting), readable(enough->ns_per_time), readable(enough->error),
                               readable(eulers_best));
         }
         return Answer{cheaper ? limited : supported, text};
       }},
      {"6",
       "Normalization will eliminate the error made, so Euler integration is sufficient.",
       {},
       [](const Found&, const Draft& draft) {
         const double euler = std::fmin(best_error(draft.runs, Problem::case_a, {Method::matrix}),
                                        best_error(draft.runs, Problem::case_a, euler_quaternion));
         return Answer{
             euler > 1e-2 ? refuted : limited,
             fmt::format("Case a: at no step tried is normalized Euler's orientation nearer than {} rad. RK4 "
                         "reaches 10⁻⁶ for {} ns a unit of time, the exact solution {} for {} ns.",
                         readable(euler), readable(least_cost(draft.runs, Problem::case_a, rk4_quaternion, 1e-6)),
                         readable(best_error(draft.runs, Problem::case_a, exact_solver)),
                         readable(least_cost(draft.runs, Problem::case_a, exact_solver, 1.0)))};
       }},
      {"6",
       "The particle-based and the rigid simulation produce similar results.",
       {{"fig05_unstable_x", {"book.0.jiggle=1e-3", "clip.frames=200"}, {most("angle_error")}},
        {"fig05_unstable_x", {"book.0.jiggle=1e-3"}, {most("angle_error")}}},
       [](const Found& f, const Draft&) {
         return Answer{f[0].found < 0.3 ? limited : refuted,
                       fmt::format("From the same start the springs stay within {} rad of the rigid motion for 100 "
                                   "units of time, and are {} rad away "
                                   "within 540: the same kind of motion, another book.",
                                   readable(f[0].found), readable(f[1].found))};
       }},
      {"6",
       "The rigid method keeps the shape of the body; particles let it change.",
       {{"fig09_matrix", {}, {most("stretch")}}, {"fig05_unstable_x", {"book.0.jiggle=1e-3"}, {most("stretch")}}},
       [](const Found& f, const Draft&) {
         return Answer{
             yes(f[0].found < 1e-10 && f[1].found > f[0].found),
             fmt::format("Largest stretch: rigid {}, springs {}.", readable(f[0].found), readable(f[1].found))};
       }},
      {"6",
       "For complex shapes the particle method is easier: no moment of inertia is needed.",
       {},
       [](const Found&, const Draft&) {
         return Answer{not_measured,
                       "A statement about work for people. (The moments of particles are sums, too: one line.)"};
       }},
  };
}

// Judges the trials of all claims; a motion that several of them share is simulated once.
class Court {
 public:
  explicit Court(const std::filesystem::path& project) : project_(project) {}

  Found judge(const Trial& trial) {
    const Scene scene = load_scene(project_ / "videos" / (trial.script + ".toml"), overrides(trial));
    std::string key = trial.script;
    for (const std::string& text : trial.overrides) key += '\n' + text;
    const auto [place, is_new] = motions_.try_emplace(key);
    if (is_new) place->second = simulate(scene);
    return bookspin::judge(scene, place->second);
  }
  static std::string command(const Trial& trial) {
    std::string text = fmt::format("bookspin check videos/{}.toml", trial.script);
    for (const std::string& override_text : overrides(trial)) text += fmt::format(" --set '{}'", override_text);
    return text;
  }

 private:
  static std::vector<std::string> overrides(const Trial& trial) {
    std::vector<std::string> all = trial.overrides;
    all.push_back(fmt::format("expect=[{}]", fmt::join(trial.expect, ", ")));
    return all;
  }

  std::filesystem::path project_;
  std::map<std::string, Trajectory> motions_;
};

}  // namespace

void claims(Draft& draft) {
  Table table{{"section", "claim", "verdict", "measured", "command"}, {}};
  nlohmann::json list = nlohmann::json::array();
  std::map<std::string, int> counts;
  Court court(draft.order.project);
  for (const Claim& claim : list_of_claims(draft.effort.quick)) {
    draft.say(std::string(claim.text).substr(0, 50));
    Found found;
    std::vector<std::string> commands;
    for (const Trial& trial : claim.trials) {
      const Found more = court.judge(trial);
      found.insert(found.end(), more.begin(), more.end());
      commands.push_back(Court::command(trial));
    }
    if (commands.empty()) commands.emplace_back("bookspin report");
    const Answer answer = claim.answer(found, draft);
    const std::string command = fmt::format("{}", fmt::join(commands, "\n"));
    std::string style = answer.verdict;
    std::replace(style.begin(), style.end(), ' ', '-');
    ++counts[answer.verdict];
    table.rows.push_back({claim.section, claim.text, answer.verdict, answer.measured, command});
    list.push_back({{"section", claim.section},
                    {"claim", claim.text},
                    {"verdict", answer.verdict},
                    {"style", style},
                    {"measured", answer.measured},
                    {"command", command}});
  }
  draft.keep("claims", table);
  draft.page["claims"] = std::move(list);
  draft.page["verdicts"] = nlohmann::json::array();
  for (const char* verdict : {supported, limited, refuted, not_measured})
    draft.page["verdicts"].push_back({{"verdict", verdict}, {"count", counts[verdict]}});
}

}  // namespace bookspin
