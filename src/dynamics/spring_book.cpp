#include "dynamics/spring_book.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "dynamics/integrators.h"

namespace bookspin {
namespace {

using Half = SpringBook::Half;
using Packet = std::array<double, 4>;
using Packets = std::array<Packet, 4>;

// One coordinate of the 16 springs that are not the mirror image of another: of the diagonals (i, 7 - i), then for each
// two pairs (i, j) of the corners 0 ... 3 of (i, j) and of (i, 7 - j). A packet is what wide instructions take at once.
Packets coordinate(const double* x) {
  return {{{2.0 * x[0], 2.0 * x[1], 2.0 * x[2], 2.0 * x[3]},
           {x[0] - x[1], x[2] - x[3], x[0] + x[1], x[2] + x[3]},
           {x[0] - x[2], x[1] - x[3], x[0] + x[2], x[1] + x[3]},
           {x[0] - x[3], x[1] - x[2], x[0] + x[3], x[1] + x[2]}}};
}

std::array<Packets, 3> springs(const Half& x) {
  return {coordinate(x.data()), coordinate(x.data() + 4), coordinate(x.data() + 8)};
}

// The same coordinate of what pulls the four corners.
void add_up(const Packets& d, const Packets& pull, double* a) {
  Packets p;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 4; ++i) p[k][i] = pull[k][i] * d[k][i];
  }
  a[0] = p[0][0] + (p[1][0] + p[1][2]) + (p[2][0] + p[2][2]) + (p[3][0] + p[3][2]);
  a[1] = p[0][1] + (p[1][2] - p[1][0]) + (p[2][1] + p[2][3]) + (p[3][1] + p[3][3]);
  a[2] = p[0][2] + (p[1][1] + p[1][3]) + (p[2][2] - p[2][0]) + (p[3][3] - p[3][1]);
  a[3] = p[0][3] + (p[1][3] - p[1][1]) + (p[2][3] - p[2][1]) + (p[3][2] - p[3][0]);
}

Half half_of(const Corners& corners) {
  Half half;
  for (std::size_t d = 0; d < 3; ++d) {
    for (std::size_t i = 0; i < 4; ++i) half[4 * d + i] = corners(static_cast<int>(d), static_cast<int>(i));
  }
  return half;
}

// to += factor * what
void add(Half& to, double factor, const Half& what) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * what[i];
}

// Weights of the accelerations at the last ten times: of h^2 in the next x now - x one step ago, and of h in v - (x now -
// x one step ago) / h. With nabla = 1 - (one step back) and lambda = h d/dt = -ln(1 - nabla) they are the series
//   (nabla / lambda)^2 / (1 - nabla)   and   (lambda - nabla) / lambda^2
// in powers of nabla, cut off (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations I, III.10).
struct Stoermer {
  static constexpr std::size_t order = 10;
  std::array<double, order> advance{}, velocity{};

  constexpr Stoermer() {
    std::array<double, order> quotient{}, square{}, sum{}, rest{};
    for (std::size_t m = 0; m < order; ++m) {
      quotient[m] = m == 0 ? 1.0 : 0.0;
      for (std::size_t j = 1; j <= m; ++j) quotient[m] -= quotient[m - j] / static_cast<double>(j + 1);
      for (std::size_t j = 0; j <= m; ++j) square[m] += quotient[j] * quotient[m - j];
      for (std::size_t j = 0; j <= m; ++j) rest[m] += square[m - j] / static_cast<double>(j + 2);
      sum[m] = square[m] + (m == 0 ? 0.0 : sum[m - 1]);
      double binomial = 1.0;  // nabla^m = sum of (-1)^j (m over j) (j steps back)
      for (std::size_t j = 0; j <= m; ++j) {
        advance[j] += sum[m] * binomial;
        velocity[j] += rest[m] * binomial;
        binomial *= -static_cast<double>(m - j) / static_cast<double>(j + 1);
      }
    }
  }
};
constexpr Stoermer stoermer;

// h times the sum of weights times accelerations, the newest first.
Half weighted(const std::array<double, Stoermer::order>& weight, double factor, const Half* acceleration) {
  Half sum{};
  for (std::size_t j = Stoermer::order; j-- > 0;) add(sum, factor * weight[j], acceleration[j]);
  return sum;
}

// One step of order 6 for x'' = a(x): eleven drifts between twelve kicks, the last of which needs the forces that the
// next step begins with.
template <class Acceleration>
void rkn6_step(Half& x, Half& v, Half& a, double h, const Acceleration& acceleration) {
  constexpr std::array kick{0.0414649985182624, 0.198128671918067,   -0.0400061921041533,
                            0.0752539843015807, -0.0115113874206879, 0.2366699247869311};
  constexpr std::array drift{0.123229775946271,  0.290553797799558, -0.127049212625417,
                             -0.246331761062075, 0.357208872795928, 0.204777054291470};
  add(v, kick[0] * h, a);
  for (std::size_t stage = 0; stage < 11; ++stage) {
    add(x, drift[std::min(stage, 10 - stage)] * h, v);
    a = acceleration(x);
    add(v, kick[std::min(stage + 1, 10 - stage)] * h, a);
  }
}

}  // namespace

SpringBook::SpringBook(const BookOptions& options)
    : stiffness_(options.stiffness),
      stiffness_over_mass_(options.stiffness / options.particle_mass),
      particle_mass_(options.particle_mass),
      damping_(options.damping * 2.0 * std::sqrt(options.stiffness * options.particle_mass)),
      steps_(step_of(options.integrator, &IntegratorInfo::spring_steps)),
      normalization_{options.normalize_every},
      rest_length_(),
      x_W_(body_of(options).corners_B) {
  std::size_t pair = 0;
  for (int i = 0; i < 8; ++i) {
    v_W_.col(i) = options.omega_W.cross(x_W_.col(i));
    for (int j = i + 1; j < 8; ++j) {
      rest_length_[pair++] = (x_W_.col(i) - x_W_.col(j)).norm();
    }
  }
  const auto [dx, dy, dz] = springs(half_of(x_W_));
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 4; ++i)
      packet_length_[k][i] = std::sqrt(dx[k][i] * dx[k][i] + dy[k][i] * dy[k][i] + dz[k][i] * dz[k][i]);
  }
  start_energy_ = kinetic_energy();
}

SpringForces SpringBook::forces(const Corners& x_W, const Corners& v_W) const {
  SpringForces result{Corners::Zero(), 0.0};
  std::size_t pair = 0;
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      const Eigen::Vector3d d = x_W.col(i) - x_W.col(j);
      const double length = d.norm();
      const double r = length - rest_length_[pair++];
      result.elastic_energy += 0.5 * stiffness_ * r * r;
      if (length > 0.0) {
        const Eigen::Vector3d xhat = d / length;
        const Eigen::Vector3d F =
            -(damping_ * xhat.cwiseProduct(v_W.col(i) - v_W.col(j)).sum() + stiffness_ * r) * xhat;
        result.F_W.col(i) += F;
        result.F_W.col(j) -= F;
      }
    }
  }
  return result;
}

SpringBook::Half SpringBook::accelerations(const Half& x, const Half& v) const {
  const auto [dx, dy, dz] = springs(x);
  Packets pull;
  for (std::size_t k = 0; k < 4; ++k) {
    for (std::size_t i = 0; i < 4; ++i) {
      const double length = std::sqrt(dx[k][i] * dx[k][i] + dy[k][i] * dy[k][i] + dz[k][i] * dz[k][i]);
      pull[k][i] = stiffness_over_mass_ * (packet_length_[k][i] - length) / std::max(length, 1e-150);
    }
  }
  if (damping_ > 0.0) {
    const auto [ux, uy, uz] = springs(v);
    const double damping = damping_ / particle_mass_;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t i = 0; i < 4; ++i) {
        const double rate = dx[k][i] * ux[k][i] + dy[k][i] * uy[k][i] + dz[k][i] * uz[k][i];
        const double square = dx[k][i] * dx[k][i] + dy[k][i] * dy[k][i] + dz[k][i] * dz[k][i];
        pull[k][i] -= damping * rate / std::max(square, 1e-300);
      }
    }
  }
  Half a;
  add_up(dx, pull, a.data());
  add_up(dy, pull, a.data() + 4);
  add_up(dz, pull, a.data() + 8);
  return a;
}

void SpringBook::keep(const Half& x, const Half& v) {
  for (int d = 0; d < 3; ++d) {
    for (int i = 0; i < 4; ++i) {
      const auto at = 4 * static_cast<std::size_t>(d) + static_cast<std::size_t>(i);
      x_W_(d, i) = x[at];
      x_W_(d, 7 - i) = -x[at];
      v_W_(d, i) = v[at];
      v_W_(d, 7 - i) = -v[at];
    }
  }
}

void SpringBook::step(double h, long n) {
  if (normalization_.every <= 0) return (this->*steps_)(h, n);
  for (; n > 0; --n) {
    (this->*steps_)(h, 1);
    if (normalization_.due()) {
      normalize(steps_ == &SpringBook::explicit_euler_steps ? old_elastic_energy_ : elastic_energy());
      multistep_h_ = 0.0;
    }
  }
}

void SpringBook::explicit_euler_steps(double h, long n) {
  for (; n > 0; --n) {
    const SpringForces old = forces(x_W_, v_W_);
    x_W_ += h * v_W_;
    v_W_ += (h / particle_mass_) * old.F_W;
    old_elastic_energy_ = old.elastic_energy;
  }
}

void SpringBook::semi_implicit_euler_steps(double h, long n) {
  Half x = half_of(x_W_);
  Half v = half_of(v_W_);
  for (; n > 0; --n) {
    add(v, h, accelerations(x, v));
    add(x, h, v);
  }
  keep(x, v);
}

void SpringBook::verlet_steps(double h, long n) {
  Half x = half_of(x_W_);
  Half v = half_of(v_W_);
  Half a = accelerations(x, v);
  for (; n > 0; --n) {
    add(v, 0.5 * h, a);
    add(x, h, v);
    a = accelerations(x, v);
    add(v, 0.5 * h, a);
  }
  keep(x, v);
}

void SpringBook::rk4_steps(double h, long n) {
  Half x = half_of(x_W_);
  Half v = half_of(v_W_);
  const auto moved = [](Half from, double factor, const Half& what) {
    add(from, factor, what);
    return from;
  };
  for (; n > 0; --n) {
    const Half a1 = accelerations(x, v);
    const Half v2 = moved(v, 0.5 * h, a1);
    const Half a2 = accelerations(moved(x, 0.5 * h, v), v2);
    const Half v3 = moved(v, 0.5 * h, a2);
    const Half a3 = accelerations(moved(x, 0.5 * h, v2), v3);
    const Half v4 = moved(v, h, a3);
    const Half a4 = accelerations(moved(x, h, v3), v4);
    add(x, h / 6.0, moved(moved(v, 2.0, moved(v2, 1.0, v3)), 1.0, v4));
    add(v, h / 6.0, moved(moved(a1, 2.0, moved(a2, 1.0, a3)), 1.0, a4));
  }
  keep(x, v);
}

void SpringBook::rkn6_steps(double h, long n) {
  Half x = half_of(x_W_);
  Half v = half_of(v_W_);
  Half a = accelerations(x, v);
  for (; n > 0; --n) rkn6_step(x, v, a, h, [&](const Half& at) { return accelerations(at, v); });
  keep(x, v);
}

// Where the book would have been at the nine times before.
void SpringBook::start_multistep(double h) {
  constexpr std::size_t room = 64;
  past_.resize(room);
  newest_ = room - Stoermer::order;
  Half x = half_of(x_W_);
  Half v = half_of(v_W_);
  Half a = accelerations(x, v);
  past_[newest_] = a;
  for (std::size_t j = 1; j < Stoermer::order; ++j) {
    rkn6_step(x, v, a, -h, [&](const Half& at) { return accelerations(at, v); });
    past_[newest_ + j] = a;
  }
  advance_ = weighted(stoermer.velocity, -h * h, &past_[newest_]);
  add(advance_, h, half_of(v_W_));
  multistep_h_ = h;
}

void SpringBook::stoermer10_steps(double h, long n) {
  if (h != multistep_h_) start_multistep(h);
  Half x = half_of(x_W_);
  for (; n > 0; --n) {
    add(advance_, 1.0, weighted(stoermer.advance, h * h, &past_[newest_]));
    add(x, 1.0, advance_);
    if (newest_ == 0) {
      newest_ = past_.size() - Stoermer::order + 1;
      std::copy_n(past_.begin(), Stoermer::order - 1, past_.begin() + static_cast<std::ptrdiff_t>(newest_));
    }
    past_[--newest_] = accelerations(x, x);
  }
  Half v = weighted(stoermer.velocity, h, &past_[newest_]);
  add(v, 1.0 / h, advance_);
  keep(x, v);
}

void SpringBook::normalize(double elastic_energy) {
  const double kinetic = kinetic_energy();
  const double floor = 0.1 * start_energy_;
  const double wanted = start_energy_ - elastic_energy;
  if (wanted < floor) ++floor_hits_;
  if (kinetic > 0.0) v_W_ *= std::sqrt(std::max(floor, wanted) / kinetic);
  const Eigen::Vector3d mean_position = x_W_.rowwise().mean();
  const Eigen::Vector3d mean_velocity = v_W_.rowwise().mean();
  x_W_.colwise() -= mean_position;
  v_W_.colwise() -= mean_velocity;
}

Eigen::Vector3d SpringBook::angular_momentum_W() const {
  Eigen::Vector3d L_W = Eigen::Vector3d::Zero();
  for (int i = 0; i < 8; ++i) L_W += particle_mass_ * x_W_.col(i).cross(v_W_.col(i));
  return L_W;
}

double SpringBook::kinetic_energy() const {
  return 0.5 * particle_mass_ * v_W_.squaredNorm();
}

}  // namespace bookspin
