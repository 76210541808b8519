#include <fmt/format.h>

#include <cmath>
#include <future>

#include "dynamics/shape.h"
#include "report/draft.h"
#include "report/stability.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"

namespace bookspin {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

// Distances from the axis of omega: what the centrifugal force pulls at.
Vector24 from_axis(const Vector24& x, const Eigen::Vector3d& omega) {
  const Eigen::Vector3d axis = omega.normalized();
  Vector24 result;
  for (Eigen::Index i = 0; i < 8; ++i) {
    const Eigen::Vector3d corner = x.segment<3>(3 * i);
    result.segment<3>(3 * i) = corner - axis * axis.dot(corner);
  }
  return result;
}

// The turning book's springs start at rest, so that each mode swings by a = omega^2 f / lambda about its balance, f the
// centrifugal pull on it; explicit Euler swells that by sqrt(1 + h^2 lambda) a step. The time until a corner may have
// moved by half a diagonal.
double predicted_undamped_explosion(const BookOptions& options, double h) {
  const SpringModes modes = spring_modes(options.size);
  const Corners rest = body_of(options).corners_B;
  const Vector24 pull = modes.vectors.transpose() * from_axis(rest.reshaped(), options.omega_W);
  const auto moved = [&](double t) {
    Eigen::Matrix<double, 8, 1> distance = Eigen::Matrix<double, 8, 1>::Zero();
    for (int mode = 0; mode < 24; ++mode) {
      const double lambda = modes.mu(mode) * options.stiffness / options.particle_mass;
      if (lambda < 1e-9) continue;
      const double amplitude = std::abs(pull(mode)) * options.omega_W.squaredNorm() / lambda *
                               std::exp(std::log1p(h * h * lambda) / (2.0 * h) * t);
      for (Eigen::Index i = 0; i < 8; ++i) distance(i) += amplitude * modes.vectors.col(mode).segment<3>(3 * i).norm();
    }
    return distance.maxCoeff();
  };
  double before = 0.0;
  double after = 1.0;
  while (moved(after) < 0.5 * options.size.norm()) after *= 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (before + after);
    (moved(middle) < 0.5 * options.size.norm() ? before : after) = middle;
  }
  return after;
}

// Damped, the book is always in balance: (K - m omega^2 P) u = m omega^2 P x, P taking the distance from the axis.
// Explicit Euler leaves the circle along its tangent, so that L grows by (1 + h^2 omega^2) a step: t = integral of d(ln
// L) / (h omega^2), L = I(omega) omega, until a corner is twice as far as at rest, or the springs can bear no more
// spin. A stiff book's I is constant, and t = 1 / (2 h omega^2).
double predicted_damped_explosion(const BookOptions& options, double h) {
  const Matrix24 K = options.stiffness / options.particle_mass * stiffness_matrix(options.size);
  const Corners rest = body_of(options).corners_B;
  const Vector24 x = rest.reshaped();
  Matrix24 P;
  for (int d = 0; d < 24; ++d) P.col(d) = from_axis(Vector24::Unit(d), options.omega_W);
  double t = 0.0;
  double log_L = std::nan("");
  double omega = options.omega_W.norm();
  while (true) {
    const Vector24 u = (K - omega * omega * P).completeOrthogonalDecomposition().solve(omega * omega * (P * x));
    const Vector24 now = x + u;
    const double next = std::log((P * now).squaredNorm() * omega);
    const Corners corners = now.reshaped(3, 8);
    if (next < log_L || extent(corners, rest) > 2.0) return t;
    if (!std::isnan(log_L)) t += (next - log_L) / (h * omega * omega);
    log_L = next;
    omega *= 1.002;
  }
}

// Steps until a corner is twice as far as at rest. -1: not within `most`.
long steps_to_explosion(const BookOptions& options, double h, long most) {
  SpringBook book(options);
  const Corners rest = body_of(options).corners_B;
  for (long n = 1; n <= most; ++n) {
    book.step(h);
    if (n % 4 == 0 && !(extent(book.corners_W(), rest) <= 2.0)) return n;
  }
  return -1;
}

struct Explosion {
  int substeps;
  bool damped;
  double predicted;
  double measured = std::nan("");  // NaN: not tried
};

// Frames of 0.1, books that spin at 0.6 about z (Figure 7) and 0.7 about x (Figure 8).
constexpr double frame = 0.1;

std::vector<Explosion> explosions(bool quick) {
  std::vector<Explosion> rows;
  std::vector<std::future<long>> runs;  // at once, on all cores: nothing is timed here
  for (const int substeps : quick ? std::vector<int>{4, 16} : std::vector<int>{3, 6, 12, 25, 50, 100, 200, 400, 1000}) {
    const double h = frame / substeps;
    for (const bool damped : {true, false}) {
      BookOptions options;
      options.normalize_every = 0;
      options.damping = damped ? 1.0 : 0.0;
      options.omega_W = damped ? Eigen::Vector3d(0.0, 0.0, 0.6) : Eigen::Vector3d(0.7, 0.0, 0.0);
      rows.push_back({substeps, damped,
                      damped ? predicted_damped_explosion(options, h) : predicted_undamped_explosion(options, h)});
      const long most = 1000 + static_cast<long>(6.0 * rows.back().predicted / h);
      const bool tried = !quick || most < 1'000'000;
      runs.push_back(std::async(std::launch::async, [=] { return tried ? steps_to_explosion(options, h, most) : -1; }));
    }
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const long steps = runs[i].get();
    if (steps > 0) rows[i].measured = static_cast<double>(steps) * frame / rows[i].substeps;
  }
  return rows;
}

// How a time grew from the smallest number of substeps to the largest.
nlohmann::json growth(const std::vector<Explosion>& rows, bool damped) {
  const Explosion* first = nullptr;
  const Explosion* last = nullptr;
  double most = 0.0;  // measured over predicted
  for (const Explosion& row : rows) {
    if (row.damped != damped || !std::isfinite(row.measured)) continue;
    if (first == nullptr) first = &row;
    last = &row;
    most = std::max(most, row.measured / row.predicted);
  }
  if (last == nullptr || last == first) return {};
  const double substeps = static_cast<double>(last->substeps) / first->substeps;
  const double times = last->measured / first->measured;
  return {{"from", first->substeps},
          {"to", last->substeps},
          {"substeps", substeps},
          {"times", times},
          {"power", fmt::format("{:.2f}", std::log(times) / std::log(substeps))},
          {"most", fmt::format("{:.2f}", most)},
          {"last", last->measured},
          {"last_predicted", last->predicted}};
}

void what_normalization_hides(Draft& draft) {
  const Scene scene = load_scene(draft.order.project / "videos" / "normalization_hides.toml");
  const Trajectory trajectory = simulate(scene);
  Table table{{"time", "energy ratio", "angular momentum ratio", "stretch"}, {}};
  Series energy{"energy", {}, {color::blue}, Mark::line};
  Series momentum{"angular momentum", {}, {color::vermillion}, Mark::line};
  double t = 0.0;
  int n = 0;
  for (const BookFrame& f : trajectory.books.front().frames) {
    t = n++ * scene.clip.time_per_frame;
    table.rows.push_back({t, f[Q::energy_ratio], f[Q::angular_momentum_ratio], f[Q::stretch]});
    energy.points.emplace_back(t, f[Q::energy_ratio]);
    momentum.points.emplace_back(t, f[Q::angular_momentum_ratio]);
  }
  draft.page["hides"] = {
      {"time", t}, {"energy", energy.points.back().second}, {"momentum", momentum.points.back().second}};
  Plot plot{"time", "relative to the start", false, false};
  plot.y_range = "[0:1.2]";
  plot.series = {std::move(energy), std::move(momentum)};
  draft.plot("what_normalization_hides", plot);
  draft.keep("what_normalization_hides", table);
}

}  // namespace

void explosion(Draft& draft) {
  const std::vector<Explosion> rows = explosions(draft.effort.quick);
  Table table{
      {"substeps a frame", "springs", "predicted time", "measured time", "measured / predicted", "measured frames"},
      {}};
  Plot plot{"substeps a frame of 0.1", "time to explosion"};
  plot.more = {"set key inside left top"};
  for (const bool damped : {true, false}) {
    const Pen pen{damped ? color::blue : color::vermillion};
    Series predicted{damped ? "damped: predicted" : "undamped: predicted", {}, pen, Mark::line};
    Series measured{"measured", {}, pen, Mark::points};
    for (const Explosion& row : rows) {
      if (row.damped != damped) continue;
      const double substeps = row.substeps;
      table.rows.push_back({substeps, damped ? "damped" : "undamped", row.predicted, row.measured,
                            row.measured / row.predicted, row.measured / frame});
      predicted.points.emplace_back(substeps, row.predicted);
      measured.points.emplace_back(substeps, row.measured);
    }
    plot.series.push_back(std::move(predicted));
    plot.series.push_back(std::move(measured));
  }
  draft.plot("time_to_explosion", plot);
  draft.keep("time_to_explosion", table);
  const Eigen::VectorXd mu = spring_modes(BookOptions().size).mu;
  const double mean = mu.sum() / static_cast<double>((mu.array() > 1e-9).count());
  draft.page["explosion"] = {{"damped", growth(rows, true)},
                             {"undamped", growth(rows, false)},
                             {"mean_rate", fmt::format("{:.2f}", mean / mu.maxCoeff())}};
  what_normalization_hides(draft);
}

}  // namespace bookspin
