#include "report/instability.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"

namespace bookspin {
namespace {

constexpr double spin = 0.11482;
constexpr double h = 0.1 / 6.0;
constexpr int steps_a_sample = 6;

enum class Kind { exact, matrix, quaternion, stepped, springs };

struct Contender {
  const char* name;
  Kind kind;
  Integrator integrator;
  double damping;
  bool normalize;
};

constexpr Contender contenders[] = {
    {"exact", Kind::exact, Integrator::explicit_euler, 0.0, true},
    {"Euler, matrix", Kind::matrix, Integrator::explicit_euler, 0.0, true},
    {"Euler, quaternion", Kind::quaternion, Integrator::explicit_euler, 0.0, true},
    {"rk4", Kind::stepped, Integrator::rk4, 0.0, true},
    {"splitting2", Kind::stepped, Integrator::splitting2, 0.0, true},
    {"splitting4", Kind::stepped, Integrator::splitting4, 0.0, true},
    {"dmv2", Kind::stepped, Integrator::dmv2, 0.0, true},
    {"dmv6", Kind::stepped, Integrator::dmv6, 0.0, true},
    {"dmv10", Kind::stepped, Integrator::dmv10, 0.0, true},
    {"springs, Euler (the paper)", Kind::springs, Integrator::explicit_euler, 1.0, true},
    {"springs, semi-implicit Euler", Kind::springs, Integrator::semi_implicit_euler, 0.0, false},
    {"springs, Verlet", Kind::springs, Integrator::velocity_verlet, 0.0, false},
    {"springs, rk4", Kind::springs, Integrator::rk4, 1.0, false},
    {"springs, composition8", Kind::springs, Integrator::composition8, 0.0, false},
};

// The kick lies along the growing direction's plane: both small components of omega, in the proportion of case a.
BookOptions options_for(const Contender& contender, double kick) {
  BookOptions options;
  const Eigen::Vector3d I_B = body_of(options).I_B;
  options.omega_W = spin * I_B.x() * Eigen::Vector3d(1.0, kick, 0.5 * kick).cwiseQuotient(I_B);
  options.integrator = contender.integrator;
  options.damping = contender.damping;
  options.normalize_every = contender.normalize ? 1 : 0;
  return options;
}

// Calls look(t, l_B) each 0.1 with the direction of the angular momentum in the body frame, until it says false or the
// time is over.
template <class Look>
void follow(const Contender& contender, const BookOptions& options, double T, Look&& look) {
  const auto samples = static_cast<long>(std::ceil(T / (steps_a_sample * h)));
  const auto walk = [&](auto&& book, auto&& direction) {
    for (long n = 0; n <= samples; ++n) {
      if (!look(static_cast<double>(n) * steps_a_sample * h, direction(book))) return;
      for (int i = 0; i < steps_a_sample; ++i) book.step(h);
    }
  };
  const Corners rest = body_of(options).corners_B;
  switch (contender.kind) {
    case Kind::exact: {
      const TorqueFree motion = exact_motion(options);
      for (long n = 0; n <= samples; ++n) {
        const double t = static_cast<double>(n) * steps_a_sample * h;
        if (!look(t, motion.at(t).L_B.normalized().eval())) return;
      }
      return;
    }
    case Kind::matrix:
      return walk(MatrixBook(options), [](const MatrixBook& book) -> Eigen::Vector3d {
        return (book.R_WB().transpose() * book.angular_momentum_W()).normalized();
      });
    case Kind::quaternion:
      return walk(QuaternionBook(options), [](const QuaternionBook& book) -> Eigen::Vector3d {
        return (book.q_WB().conjugate() * book.angular_momentum_W()).normalized();
      });
    case Kind::stepped:
      return walk(FreeBook(options), [](const FreeBook& book) -> Eigen::Vector3d { return book.L_B().normalized(); });
    case Kind::springs:
      return walk(SpringBook(options), [&rest](const SpringBook& book) -> Eigen::Vector3d {
        return (best_fit_orientation(book.corners_W(), rest).conjugate() * book.angular_momentum_W()).normalized();
      });
  }
}

double tilt_of(const Eigen::Vector3d& l_B) {
  return std::atan2(l_B.tail<2>().norm(), l_B.x());
}

// Slope of ln(tilt) over t while the tilt is between `low` and `high`.
double growth_rate(const Contender& contender, double kick, double low, double high) {
  double n = 0.0, st = 0.0, sy = 0.0, stt = 0.0, sty = 0.0;
  follow(contender, options_for(contender, kick), 1000.0, [&](double t, const Eigen::Vector3d& l_B) {
    const double tilt = tilt_of(l_B);
    if (tilt > high || !(tilt >= 0.0)) return false;
    if (tilt > low) {
      const double y = std::log(tilt);
      n += 1.0;
      st += t;
      sy += y;
      stt += t * t;
      sty += t * y;
    }
    return true;
  });
  return (n * sty - st * sy) / (n * stt - st * st);
}

double flip_time(const Contender& contender, double kick, double most) {
  double flip = std::numeric_limits<double>::infinity();
  follow(contender, options_for(contender, kick), most, [&](double t, const Eigen::Vector3d& l_B) {
    if (!l_B.allFinite()) return false;
    if (tilt_of(l_B) < 0.5 * std::numbers::pi) return true;
    flip = t;
    return false;
  });
  return flip;
}

}  // namespace

double theoretical_growth_rate() {
  const Eigen::Vector3d I_B = body_of(BookOptions()).I_B;
  return intermediate_axis_growth_rate(I_B, spin * I_B.x());
}

Table growth_rates(const Effort& effort) {
  Table table{"growth_rates", {"method", "step", "growth rate", "sigma", "growth rate / sigma - 1"}, {}};
  const double sigma = theoretical_growth_rate();
  const double kick = effort.quick ? 1e-4 : 1e-6;
  for (const Contender& contender : contenders) {
    const double rate = growth_rate(contender, kick, 30.0 * kick, 1e-2);
    table.rows.push_back({contender.name, contender.kind == Kind::exact ? 0.0 : h, rate, sigma, rate / sigma - 1.0});
  }
  return table;
}

Table flip_times(const Effort& effort) {
  Table table{"flip_times", {"kick", "theory"}, {}};
  for (const Contender& contender : contenders) table.columns.emplace_back(contender.name);
  std::vector<double> kicks;
  for (int n = 2; n <= 15; n += effort.quick ? 5 : 1) kicks.push_back(std::pow(10.0, -n));
  kicks.push_back(0.0);
  const double most = effort.quick ? 400.0 : 3000.0;
  for (const double kick : kicks) {
    std::vector<Cell> row{kick, exact_motion(options_for(contenders[0], kick)).first_flip()};
    for (const Contender& contender : contenders) {
      // Without a kick, or with one lost in rounding, a book may never flip: the springs are too dear to wait as long.
      const double t = flip_time(contender, kick, contender.kind == Kind::springs ? std::min(most, 1000.0) : most);
      row.push_back(std::isfinite(t) ? Cell(t) : Cell("never"));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace bookspin
