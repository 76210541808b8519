#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "dynamics/rigid_book.h"
#include "fill/fill.h"
#include "report/draft.h"

// The paper's claims, each with the number that supports, limits or refutes it and the command that shows it again.
//
// A claim is judged by its trials: their verdicts, one an expectation, are a, b, c, ... in the order of the trials. Its
// rule says from what was found whether the claim holds; its sentence is filled with {{a.found}}, {{a.frame}},
// {{a.explodes}}, what the rule has added, and the numbers of the page.

namespace bookspin {
namespace {

constexpr const char* supported = "supported";
constexpr const char* limited = "limited";
constexpr const char* refuted = "refuted";
constexpr const char* not_measured = "not measured";

struct Facts {
  std::vector<Verdict> found;
  const Draft& draft;
  nlohmann::json say;  // further numbers for the sentence

  double operator[](std::size_t i) const { return found.at(i).found; }
  [[nodiscard]] bool met(std::size_t i) const { return found.at(i).met; }
  [[nodiscard]] double frame(std::size_t i) const { return met(i) ? found.at(i).frame : none; }  // of an explosion
};

struct Claim {
  const char* section;
  const char* text;
  std::vector<Trial> trials;  // none: the numbers are those of other sections
  const char* (*rule)(Facts& facts);
  const char* sentence;
};

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
  return {
      {"5.1",
       "Rotation about z, the axis of the largest moment, is stable even when jiggled (Fig. 3).",
       {{"fig03_stable_z", {"book.0.jiggle=0.03", longer}, {most("tilt")}}},
       [](Facts& f) { return f[0] < 10.0 ? supported : refuted; },
       "After a jiggle of 3 % the tilt never passes {{a.found}}°."},
      {"5.1",
       "Rotation about y, the axis of the smallest moment, is stable even when jiggled (Fig. 4).",
       {{"fig04_stable_y", {"book.0.jiggle=0.03"}, {most("tilt")}},
        {"fig04_stable_y", {"book.0.jiggle=0.03", longer}, {most("tilt")}}},
       [](Facts& f) {
         f.say["longer"] = f.draft.effort.quick ? 400 : 10000;
         return f[1] < 10.0 ? supported : f[0] < 10.0 ? limited : refuted;
       },
       "In the film the tilt never passes {{a.found}}°, in a run of {{longer}} units of time {{b.found}}°."},
      {"5.1",
       "Rotation about x is an unstable equilibrium: numerical inaccuracies suffice to turn the book over (Fig. 5).",
       {{"fig05_unstable_x",
         {"book.0.jiggle=0", quick ? "clip.frames=1100" : "clip.frames=1400"},
         {"{quantity=\"tilt\", rises_to=90}"}}},
       [](Facts& f) { return f.met(0) ? supported : refuted; },
       "Without any jiggle the damped springs tilt to {{a.found}}° by frame {{a.frame}}: rounding alone, grown e-fold "
       "every {{sigma.e_fold}} units of time."},
      {"5.1",
       "The particle simulation runs sufficiently fast on a standard computer.",
       {},
       [](Facts& f) {
         const double times = 1000.0 / 60.0 / f.draft.page["frame"]["dynamics_ms"].get<double>();
         f.say["times"] = times;
         return times > 1.0 ? supported : refuted;
       },
       "{{frame.dynamics_ms}} ms of CPU a film frame ({{frame.steps}} steps): {{times}} times faster than the film at "
       "60 frames a second plays."},
      {"5.1",
       "Damping is necessary: without it the rotation is quickly turned into vibration (Fig. 6).",
       {{"fig06_undamped", {}, {at_frame("angular_momentum_ratio", 719)}},
        {"fig06_undamped", {"book.0.damping=1"}, {at_frame("angular_momentum_ratio", 719)}},
        {"fig06_undamped",
         {"book.0.integrator=velocity_verlet", "book.0.normalize=false"},
         {at_frame("angular_momentum_ratio", 719), most("energy_ratio")}}},
       [](Facts& f) {
         f.say["lost"] = std::abs(f[2] - 1.0);
         f.say["gained"] = f[3] - 1.0;
         return f[0] >= 0.5 ? refuted : f[2] > 0.99 ? limited : supported;
       },
       "True of explicit Euler: after 720 frames |L|/L₀ is {{a.found}} undamped, {{b.found}} damped. Not of the model: "
       "velocity Verlet, undamped and not normalized, keeps |L| to {{lost}} and the energy within {{gained}}."},
      {"5.1",
       "Normalization is necessary: without it the energy grows, the book runs faster and faster and explodes (Fig. "
       "7).",
       {{"fig07_unnormalized", {}, {explodes, at_frame("energy_ratio", 330)}},
        {"fig07_unnormalized", {"book.0.integrator=rk4"}, {explodes, at_frame("energy_ratio", 719)}}},
       [](Facts& f) { return !f.met(0)  ? refuted
                             : f.met(2) ? supported
                                        : limited; },
       "Explicit Euler: E/E₀ = {{b.found}} in frame 330, {{a.explodes}}. RK4 with the same step and no normalization: "
       "{{c.explodes}}, E/E₀ = {{d.found}} in the last frame."},
      {"5.1",
       "With neither, the simulation diverges very quickly (Fig. 8).",
       {{"fig08_neither", {}, {explodes}}, {"fig08_neither", {"book.0.damping=1"}, {explodes}}},
       [](Facts& f) { return f.frame(0) < f.frame(1) ? supported : refuted; },
       "Undamped it {{a.explodes}}, damped it {{b.explodes}}."},
      {"5.1",
       "Approximately 1000 smaller iterations a frame delay these problems substantially.",
       {{"fig08_neither", {"clip.frames=2000"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000", many}, {explodes}},
        {"fig07_unnormalized", {"clip.frames=2000", many}, {explodes}}},
       [](Facts& f) {
         f.say["many"] = f.draft.effort.quick ? 100 : 1000;
         return f.frame(1) > 10.0 * f.frame(0) ? supported : refuted;
       },
       "With 3 steps a frame the undamped book {{a.explodes}}; with {{many}} steps within 2000 frames it "
       "{{b.explodes}}, "
       "and the damped book of Fig. 7 {{c.explodes}}. How the delay grows with the number of steps: see time to "
       "explosion."},
      {"3.1",
       "A smaller spring constant delays the divergence.",
       {{"fig08_neither", {"clip.frames=2000", "book.0.stiffness=5"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000"}, {explodes}},
        {"fig08_neither", {"clip.frames=2000", "book.0.stiffness=40"}, {explodes}}},
       [](Facts& f) { return f.frame(0) > f.frame(1) && f.frame(1) > f.frame(2) ? supported : refuted; },
       "k = 5: {{a.explodes}}; k = 10: {{b.explodes}}; k = 40: {{c.explodes}}."},
      {"3.3",
       "Damping and normalization together give a reasonable simulation indefinitely.",
       {{"fig05_unstable_x",
         {longer},
         {most("stretch"), at_frame("energy_ratio", quick ? 799 : 19999),
          at_frame("angular_momentum_ratio", quick ? 799 : 19999)}}},
       [](Facts& f) {
         f.say["frames"] = f.found[1].frame + 1;
         f.say["keeps"] = std::abs(f[2] - 1.0) < 0.01;
         return f[0] >= 0.05 ? refuted : f.say["keeps"] == true ? supported : limited;
       },
       "Over the whole run of {{frames}} frames the stretch stays below {{a.found}}; at its end E/E₀ = {{b.found}} and "
       "|L|/L₀ = {{c.found}}{{^keeps}}: the shape and the energy are kept, the angular momentum is not{{/keeps}}."},
      {"3.3",
       "A more serious source of global error than the integration is the model: the book is not a bunch of springs.",
       {},
       [](Facts& f) {
         const ModelError& undamped = f.draft.model_errors[0];  // of k = 10, as the paper's
         const ModelError& paper = f.draft.model_errors[2];
         f.say = {{"k", paper.stiffness},
                  {"integration", paper.integration},
                  {"model", paper.model},
                  {"other", info_of(undamped.integrator).name},
                  {"others_integration", undamped.integration},
                  {"others_model", undamped.model}};
         return paper.model > paper.integration ? supported : paper.model > 0.1 * paper.integration ? limited : refuted;
       },
       "The paper's springs (k = {{k}}, damped, normalized), case a at the paper's step: integration error "
       "{{integration}}, model error {{model}} half diagonals. Undamped, with {{other}}: {{others_integration}} and "
       "{{others_model}}."},
      {"5.2",
       "The orientation matrix, with normalization, gives a natural looking result (Fig. 9).",
       {{"fig09_matrix", {}, {at_frame("flips", 959), most("orthogonality_defect"), most("angle_error")}}},
       [](Facts& f) { return f[0] < 2.0 || f[1] >= 1e-10 ? refuted
                             : f[2] < 0.1                ? supported
                                                         : limited; },
       "{{a.found}} flips, |RᵀR − 1| below {{b.found}}: it looks right. But the angle to the true orientation reaches "
       "{{c.found}} rad."},
      {"5.2",
       "With a larger time step the results are also good, slightly less consistent (Fig. 9, external video).",
       {{"fig09_matrix", {}, {most("angle_error", "[0, 300]"), most("tilt", "[600, 959]")}},
        {"fig09b_matrix_large_step", {}, {most("angle_error", "[0, 300]"), most("tilt", "[600, 959]")}}},
       [](Facts& f) { return f[3] < f[1] - 5.0 ? limited : supported; },
       "In the first 300 frames the error reaches {{a.found}} rad at 30 steps a frame and {{c.found}} rad at 4; later "
       "the small step's tilt still reaches {{b.found}}°, the large one's {{d.found}}°."},
      {"5.2",
       "Without normalization the book changes shape and the simulation eventually breaks down (Fig. 10).",
       {{"fig10_matrix_unnormalized", {}, {at_frame("largest_singular_value", 200), explodes}}},
       [](Facts& f) { return f[0] > 1.1 && f.met(1) ? supported : refuted; },
       "By frame 200 it has grown {{a.found}} times; it {{b.explodes}}."},
      {"5.2",
       "The quaternion looks the same as the matrix.",
       {{"fig09_matrix", {}, {most("tilt", "[0, 400]")}},
        {"fig09_matrix", {"book.0.method=quaternion"}, {most("tilt", "[0, 400]")}}},
       [](Facts& f) {
         const int frame = f.found[0].frame;
         const bool same = std::abs(frame - f.found[1].frame) <= 0.05 * frame && std::abs(f[0] - f[1]) < 5.0;
         return same ? supported : limited;
       },
       "The first flip is complete in frame {{a.frame}} for the matrix ({{a.found}}°), in frame {{b.frame}} for the "
       "quaternion ({{b.found}}°)."},
      {"5.2",
       "Not normalized, the quaternion often diverges later than the matrix, but not always (Figs. 10, 11).",
       {{"fig10_matrix_unnormalized", {"clip.frames=4000"}, {explodes}},
        {"fig10_matrix_unnormalized", {"clip.frames=4000", "book.0.method=quaternion"}, {explodes}},
        {"fig11_quaternion_unnormalized", {"clip.frames=4000", "book.0.method=matrix"}, {explodes}},
        {"fig11_quaternion_unnormalized", {"clip.frames=4000"}, {explodes}},
        {"fig12_pulsating_quaternion", {"clip.frames=4000", "book.0.method=matrix"}, {explodes}},
        {"fig12_pulsating_quaternion", {"clip.frames=4000"}, {explodes}}},
       [](Facts& f) {
         const int later = (f.frame(1) > f.frame(0)) + (f.frame(3) > f.frame(2)) + (f.frame(5) > f.frame(4));
         f.say["later"] = later;
         return later >= 2 ? supported : limited;
       },
       "Fig. 10: matrix {{a.explodes}}, quaternion {{b.explodes}}. Fig. 11: matrix {{c.explodes}}, quaternion "
       "{{d.explodes}}. Fig. 12: matrix {{e.explodes}}, quaternion {{f.explodes}}. Later in {{later}} of 3."},
      {"5.2",
       "The denormalized quaternion makes the book pulsate (Fig. 12).",
       {{"fig12_pulsating_quaternion", {}, {at_frame("pulsations", 659), most("blend_defect")}}},
       [](Facts& f) { return f[0] >= 2.0 ? supported : refuted; },
       "{{a.found}} pulsations. They are the blend (1 − s²)·1 + s²·R of the book with its unrotated self, to "
       "{{b.found}}."},
      {"4.4",
       "Normalizing a quaternion is much cheaper than normalizing a matrix by SVD.",
       {},
       [](Facts& f) {
         BookOptions options;
         options.omega_W = {0.11482, 1e-4, 5e-5};
         BookOptions never = options;
         never.normalize_every = 0;
         const double matrix = step_ns(MatrixBook(options));
         const double quaternion = step_ns(QuaternionBook(options));
         const double svd = matrix - step_ns(MatrixBook(never));
         const double division = std::max(0.0, quaternion - step_ns(QuaternionBook(never)));
         f.say = {{"svd", svd}, {"division", division}, {"matrix", matrix}, {"quaternion", quaternion}};
         return svd > 3.0 * division ? supported : refuted;
       },
       "SVD {{svd}} ns, quaternion {{division}} ns; a whole step {{matrix}} ns against {{quaternion}} ns."},
      {"6",
       "Normalization need not be done in every step.",
       {{"fig09_matrix", {}, {most("angle_error", "[0, 300]")}},
        {"fig09_matrix",
         {"book.0.normalize_every=100"},
         {most("angle_error", "[0, 300]"), most("orthogonality_defect")}},
        {"fig09_matrix", {"book.0.normalize=false"}, {most("orthogonality_defect", "[0, 300]")}}},
       [](Facts& f) { return f[1] < 1.5 * f[0] && f[2] < 0.01 ? supported : limited; },
       "Every 100 steps: |RᵀR − 1| stays below {{c.found}} (without: {{d.found}} after 300 frames), and the error "
       "after "
       "300 frames is {{b.found}} rad instead of {{a.found}}."},
      {"6",
       "A higher order method (RK4) has a smaller error in every step but is computationally more expensive.",
       {},
       [](Facts& f) {
         const Ladder& by_euler = ladder(f.draft.runs.at(Problem::case_a), {Method::quaternion});
         const Ladder& by_rk4 = ladder(f.draft.runs.at(Problem::case_a), {Method::quaternion, Integrator::rk4});
         const Run euler = by_euler.closest(0.1 / 6.0);
         const Run rk4 = by_rk4.closest(0.1 / 6.0);
         const double eulers_best = by_euler.nearest().error;
         const Run enough = by_rk4.cheapest(eulers_best);
         f.say = {{"h", rk4.setting},          {"euler_ns", euler.ns_per_time}, {"euler_error", euler.error},
                  {"rk4_ns", rk4.ns_per_time}, {"rk4_error", rk4.error},        {"eulers_best", eulers_best}};
         if (enough.error <= eulers_best)
           f.say["enough"] = {{"h", enough.setting}, {"ns", enough.ns_per_time}, {"error", enough.error}};
         return enough.ns_per_time < euler.ns_per_time ? limited : supported;
       },
       "At h ≈ {{h}} a unit of time costs {{euler_ns}} ns by Euler on the quaternion (error {{euler_error}} rad) and "
       "{{rk4_ns}} ns by RK4 (error {{rk4_error}}).{{#enough}} But RK4 at h = {{h}}, for {{ns}} ns, is off by "
       "{{error}}; "
       "Euler at its best step tried by {{eulers_best}}.{{/enough}}"},
      {"6",
       "Normalization will eliminate the error made, so Euler integration is sufficient.",
       {},
       [](Facts& f) {
         const auto its = [&](const Solver& solver) { return ladder(f.draft.runs.at(Problem::case_a), solver); };
         const double euler =
             std::min(its({Method::matrix}).nearest().error, its({Method::quaternion}).nearest().error);
         f.say = {{"euler", euler},
                  {"rk4_ns", its({Method::quaternion, Integrator::rk4}).cheapest(1e-6).ns_per_time},
                  {"exact", its(exact_solver).nearest().error},
                  {"exact_ns", its(exact_solver).nearest().ns_per_time}};
         return euler > 1e-2 ? refuted : limited;
       },
       "Case a: at no step tried is normalized Euler's orientation nearer than {{euler}} rad. RK4 reaches 10⁻⁶ for "
       "{{rk4_ns}} ns a unit of time, the exact solution {{exact}} for {{exact_ns}} ns."},
      {"6",
       "The particle-based and the rigid simulation produce similar results.",
       {{"fig05_unstable_x", {"book.0.jiggle=1e-3", "clip.frames=200"}, {most("angle_error")}},
        {"fig05_unstable_x", {"book.0.jiggle=1e-3"}, {most("angle_error")}}},
       [](Facts& f) { return f[0] < 0.3 ? limited : refuted; },
       "From the same start the springs stay within {{a.found}} rad of the rigid motion for 100 units of time, and are "
       "{{b.found}} rad away within 540: the same kind of motion, another book."},
      {"6",
       "The rigid method keeps the shape of the body; particles let it change.",
       {{"fig09_matrix", {}, {most("stretch")}}, {"fig05_unstable_x", {"book.0.jiggle=1e-3"}, {most("stretch")}}},
       [](Facts& f) { return f[0] < 1e-10 && f[1] > f[0] ? supported : refuted; },
       "Largest stretch: rigid {{a.found}}, springs {{b.found}}."},
      {"6",
       "For complex shapes the particle method is easier: no moment of inertia is needed.",
       {},
       [](Facts&) { return not_measured; },
       "A statement about work for people. (The moments of particles are sums, too: one line.)"},
  };
}

std::string sentence_of(const Claim& claim, const Facts& facts) {
  nlohmann::json data = facts.draft.page;
  data.update(facts.say);
  for (std::size_t i = 0; i < facts.found.size(); ++i) {
    const Verdict& v = facts.found[i];
    data[std::string(1, static_cast<char>('a' + i))] = {
        {"found", v.found},
        {"frame", v.frame},
        {"explodes", v.met ? fmt::format("explodes in frame {}", v.frame) : "does not explode"}};
  }
  make_readable(data);
  return fill(claim.sentence, data, "claims.cpp");
}

}  // namespace

void claims(Draft& draft) {
  Table table{{"section", "claim", "verdict", "measured", "command"}, {}};
  nlohmann::json list = nlohmann::json::array();
  std::map<std::string, int> counts;
  for (const Claim& claim : list_of_claims(draft.effort.quick)) {
    draft.say(std::string(claim.text).substr(0, 50));
    Facts facts{{}, draft, nlohmann::json::object()};
    std::vector<std::string> commands;
    for (const Trial& trial : claim.trials) {
      const std::vector<Verdict> found = draft.judge(trial);
      facts.found.insert(facts.found.end(), found.begin(), found.end());
      commands.push_back(fmt::format("bookspin check videos/{}.toml --set '{}'", trial.script,
                                     fmt::join(trial.all_overrides(), "' --set '")));
    }
    if (commands.empty()) commands.emplace_back("bookspin report");
    const std::string command = fmt::format("{}", fmt::join(commands, "\n"));
    const std::string verdict = claim.rule(facts);
    const std::string measured = sentence_of(claim, facts);
    std::string style = verdict;
    std::replace(style.begin(), style.end(), ' ', '-');
    ++counts[verdict];
    table.rows.push_back({claim.section, claim.text, verdict, measured, command});
    list.push_back({{"section", claim.section},
                    {"claim", claim.text},
                    {"verdict", verdict},
                    {"style", style},
                    {"measured", measured},
                    {"command", command}});
  }
  draft.keep("claims", table);
  draft.page["claims"] = std::move(list);
  draft.page["verdicts"] = nlohmann::json::array();
  for (const char* verdict : {supported, limited, refuted, not_measured})
    draft.page["verdicts"].push_back({{"verdict", verdict}, {"count", counts[verdict]}});
}

}  // namespace bookspin
