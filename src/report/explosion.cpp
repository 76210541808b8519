#include <fmt/format.h>

#include <cmath>
#include <future>

#include "dynamics/shape.h"
#include "report/draft.h"

namespace bookspin {
namespace {

using Vector24 = Eigen::Matrix<double, 24, 1>;

// Distances from the axis of omega: what the centrifugal force pulls at.
Vector24 from_axis(const Vector24& x, const Eigen::Vector3d& omega) {
  const Eigen::Vector3d axis = omega.normalized();
  const Corners corners = x.reshaped(3, 8);
  return (corners - axis * (axis.transpose() * corners)).reshaped();
}

// The turning book's springs start at rest, so that each mode swings by a = omega^2 f / lambda about its balance, f the
// centrifugal pull on it; explicit Euler swells that by sqrt(1 + h^2 lambda) a step. The time until a corner may have
// moved by half a diagonal.
double predicted_undamped_explosion(const BookOptions& options, double h) {
  const SpringModes modes = spring_modes(options.size);
  const Corners rest = body_of(options).corners_B;
  const Vector24 pull = modes.vectors.transpose() * from_axis(rest.reshaped(), options.omega_W);
  const auto moved = [&](double t) {
    Eigen::RowVectorXd distance = Eigen::RowVectorXd::Zero(8);
    for (int mode = 0; mode < 24; ++mode) {
      const double lambda = modes.mu(mode) * options.stiffness / options.particle_mass;
      if (lambda < 1e-9) continue;
      const double amplitude = std::abs(pull(mode)) * options.omega_W.squaredNorm() / lambda *
                               std::exp(std::log1p(h * h * lambda) / (2.0 * h) * t);
      distance += amplitude * modes.vectors.col(mode).reshaped(3, 8).colwise().norm();
    }
    return distance.maxCoeff();
  };
  const auto whole = [&](double t) { return moved(t) < 0.5 * options.size.norm(); };
  double late = 1.0;
  while (whole(late)) late *= 2.0;
  return bisect(0.0, late, 60, whole);
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
  double substeps;
  bool damped;
  double predicted;
  double measured;  // none: not tried, or not seen
};

// Frames of 0.1, books that spin at 0.6 about z (Figure 7) and 0.7 about x (Figure 8).
constexpr double time_per_frame = 0.1;

Explosion explosion_at(double substeps, bool damped, bool quick) {
  const double h = time_per_frame / substeps;
  BookOptions options{.normalize_every = 0, .damping = damped ? 1.0 : 0.0};
  options.omega_W = damped ? Eigen::Vector3d(0.0, 0.0, 0.6) : Eigen::Vector3d(0.7, 0.0, 0.0);
  const double predicted = damped ? predicted_damped_explosion(options, h) : predicted_undamped_explosion(options, h);
  const long most = 1000 + static_cast<long>(6.0 * predicted / h);
  const long steps = quick && most >= 1'000'000 ? -1 : steps_to_explosion(options, h, most);
  return {substeps, damped, predicted, steps < 0 ? none : static_cast<double>(steps) * time_per_frame / substeps};
}

std::vector<Explosion> explosions(bool quick) {
  std::vector<std::future<Explosion>> runs;  // at once, on all cores: nothing is timed here
  for (const bool damped : {true, false}) {
    for (const double substeps :
         quick ? std::vector<double>{4, 16} : std::vector<double>{3, 6, 12, 25, 50, 100, 200, 400, 1000})
      runs.push_back(std::async(std::launch::async, explosion_at, substeps, damped, quick));
  }
  std::vector<Explosion> rows;
  for (auto& run : runs) rows.push_back(run.get());
  return rows;
}

// How a time grew from the smallest number of substeps to the largest.
nlohmann::json growth(std::vector<Explosion> rows, bool damped) {
  std::erase_if(rows, [damped](const Explosion& row) { return row.damped != damped || row.measured == none; });
  if (rows.size() < 2) return {};
  const Explosion& first = rows.front();
  const Explosion& last = rows.back();
  const double substeps = last.substeps / first.substeps;
  const double times = last.measured / first.measured;
  double most = 0.0;  // measured over predicted
  for (const Explosion& row : rows) most = std::max(most, row.measured / row.predicted);
  return {{"from", first.substeps},
          {"to", last.substeps},
          {"substeps", substeps},
          {"times", times},
          {"power", fmt::format("{:.2f}", std::log(times) / std::log(substeps))},
          {"most", fmt::format("{:.2f}", most)},
          {"last", last.measured},
          {"last_predicted", last.predicted}};
}

}  // namespace

void explosion(Draft& draft) {
  const std::vector<Explosion> rows = explosions(draft.effort.quick);
  Table table{
      {"substeps a frame", "springs", "predicted time", "measured time", "measured / predicted", "measured frames"},
      {}};
  for (const auto& [substeps, damped, predicted, measured] : rows)
    table.rows.push_back({substeps, damped ? "damped" : "undamped", predicted, measured, measured / predicted,
                          measured / time_per_frame});
  Plot plot{"substeps a frame of 0.1", "time to explosion"};
  plot.more = {"set key inside left top"};
  for (const bool damped : {true, false})
    add_predicted_and_measured(
        plot, damped ? "damped: predicted" : "undamped: predicted", {damped ? color::blue : color::vermillion}, rows,
        [=](const Explosion& row) { return row.damped == damped; }, &Explosion::substeps);
  draft.plot("time_to_explosion", plot);
  draft.keep("time_to_explosion", table);
  const Eigen::VectorXd mu = spring_modes(BookOptions().size).mu;
  const double mean = mu.sum() / static_cast<double>((mu.array() > 1e-9).count());
  draft.page["explosion"] = {{"damped", growth(rows, true)},
                             {"undamped", growth(rows, false)},
                             {"mean_rate", fmt::format("{:.2f}", mean / mu.maxCoeff())}};
}

}  // namespace bookspin
