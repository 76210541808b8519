#include "dynamics/rigid_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "dynamics/rigid_book.h"

namespace bookspin {
namespace {

using Eigen::Vector3d;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Scalars, not Eigen's vectors: they stay in registers from step to step.
struct Scalars {
  double w, x, y, z;  // q_WB
  double Lx, Ly, Lz;  // L_B
};

// q = q / |q|. Near 1 by the series of the root, which is ready sooner.
[[gnu::always_inline]] inline void normalize(Scalars& s) {
  const double excess = (s.w * s.w + s.x * s.x) + (s.y * s.y + s.z * s.z) - 1.0;
  const double scale = 1.0 - excess * (0.5 - 0.375 * excess);
  if (!(std::abs(excess) < 1e-6)) {
    Eigen::Quaterniond q(s.w, s.x, s.y, s.z);
    bookspin::normalize(q);
    s = {q.w(), q.x(), q.y(), q.z(), s.Lx, s.Ly, s.Lz};
    return;
  }
  s.w *= scale;
  s.x *= scale;
  s.y *= scale;
  s.z *= scale;
}

// Nothing goes through memory from step to step: the counter is a copy, and the step is inlined.
template <class Step>
[[gnu::always_inline]] inline void repeat(RigidState& state, long n, Normalization& normalization, const Step& step) {
  auto& [q, L] = state;
  Scalars s{q.w(), q.x(), q.y(), q.z(), L.x(), L.y(), L.z()};
  Normalization count = normalization;
  for (; n > 0; --n) {
    step(s);
    if (count.due()) normalize(s);
  }
  normalization = count;
  q = {s.w, s.x, s.y, s.z};
  L = {s.Lx, s.Ly, s.Lz};
}

// The curve on which L_B runs, sphere |L_B| and ellipsoid 2 E, by where it crosses L_b = 0: at (A_a, 0, A_c) and its
// mirror images. b is the axis of the middle moment, (a, b, c) are right-handed. In units of the largest component.
struct Orbit {
  int a, b = 0, c;
  double f_a, f_c;  // f_a / I_a + f_c / I_c = 1 / I_b, f_a + f_c = 1
  double unit, A_a, A_c;

  Orbit(const Vector3d& I, const Vector3d& L) : unit(L.cwiseAbs().maxCoeff()) {
    while ((I(b) - I((b + 1) % 3)) * (I(b) - I((b + 2) % 3)) > 0.0) ++b;
    a = (b + 2) % 3;
    c = (b + 1) % 3;
    const double gap = I(c) - I(a);
    f_a = gap == 0.0 ? 0.5 : (I(c) - I(b)) / gap * (I(a) / I(b));
    f_c = gap == 0.0 ? 0.5 : (I(b) - I(a)) / gap * (I(c) / I(b));
    const Vector3d l = L / unit;
    A_a = std::sqrt(l(a) * l(a) + f_a * l(b) * l(b));
    A_c = std::sqrt(l(c) * l(c) + f_c * l(b) * l(b));
  }

  // The largest |omega|: omega^2 is linear in L_b^2, so it is where L_b = 0 or where L_b^2 is largest.
  [[nodiscard]] double fastest(const Vector3d& I) const {
    const auto omega2 = [&](double L_b2) {
      return (A_a * A_a - f_a * L_b2) / I(a) / I(a) + L_b2 / I(b) / I(b) + (A_c * A_c - f_c * L_b2) / I(c) / I(c);
    };
    double most = std::numeric_limits<double>::infinity();
    if (f_a > 0.0) most = A_a * A_a / f_a;
    if (f_c > 0.0) most = std::min(most, A_c * A_c / f_c);
    return unit * std::sqrt(std::max(omega2(0.0), omega2(most)));
  }
};

// dL_1/dt = pull_1 L_2 L_3, and cyclically: 1 / I_3 - 1 / I_2, without cancellation.
Vector3d pulls(const Vector3d& I) {
  return {(I.y() - I.z()) / I.y() / I.z(), (I.z() - I.x()) / I.z() / I.x(), (I.x() - I.y()) / I.x() / I.y()};
}

// sum of p_i q_(n-i), i = 0 ... n.
using Series = std::array<double, 40>;
double convolution(const Series& p, const Series& q, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i <= n; ++i) sum += p[i] * q[n - i];
  return sum;
}

// The discrete Moser-Veselov motion runs on the same curve if 1 / J = s / I + d. The two numbers follow from one exact
// step F, and from the one that is halved where L_b = 0 they follow in closed form: its e = F / F_w has e_b = 0, and the
// equation of dmv_steps reads e_a J_a = (1 + e^2) h L_a / 2, the same with c. F is a Taylor series from there.
Vector3d dmv_moments(const Vector3d& I, const Vector3d& L_B, double h) {
  const Orbit orbit(I, L_B);
  const auto [a, b, c, f_a, f_c, unit, A_a, A_c] = orbit;
  if (unit == 0.0) return I;
  if (!(std::abs(h) * orbit.fastest(I) < 0.5 * std::numbers::pi)) return Vector3d::Constant(nan);
  const double t = 0.5 * h * unit;
  const Vector3d rate = t * I.cwiseInverse();
  const Vector3d pull = t * pulls(I);
  // Of L and of q = (w, x, y, z) in powers of time squared; L_b, x and z are odd and have a factor of time before it.
  // An axis along which there is nothing counts as hardly anything: what is left is the limit.
  Series L_a{std::max(A_a, 1e-20)}, L_b{}, L_c{std::max(A_c, 1e-20)}, w{1.0}, x{}, y{}, z{};
  Vector3d L = Vector3d::Zero();
  double W = 0.0, X = 0.0, Y = 0.0, Z = 0.0;
  for (std::size_t n = 0;; ++n) {
    const auto odd = 2.0 * static_cast<double>(n) + 1.0;
    L_b[n] = pull(b) * convolution(L_c, L_a, n) / odd;
    x[n] = rate(a) * convolution(w, L_a, n) + rate(c) * convolution(y, L_c, n);
    z[n] = rate(c) * convolution(w, L_c, n) - rate(a) * convolution(y, L_a, n);
    if (n > 0) {
      x[n] -= rate(b) * convolution(z, L_b, n - 1);
      z[n] += rate(b) * convolution(x, L_b, n - 1);
    }
    x[n] *= 0.5 / odd;
    z[n] *= 0.5 / odd;
    L += Vector3d(L_a[n], L_b[n], L_c[n]);
    W += w[n];
    X += x[n];
    Y += y[n];
    Z += z[n];
    constexpr double rest = 1e-18;
    if (std::abs(L_a[n]) < rest * L_a[0] && std::abs(L_c[n]) < rest * L_c[0] &&
        std::abs(x[n]) < rest * std::abs(x[0]) && std::abs(z[n]) < rest * std::abs(z[0]))
      break;
    if (n + 1 == L_a.size()) return Vector3d::Constant(nan);
    L_a[n + 1] = pull(a) * convolution(L_b, L_c, n) / (odd + 1.0);
    L_c[n + 1] = pull(c) * convolution(L_a, L_b, n) / (odd + 1.0);
    w[n + 1] =
        -0.5 *
        (rate(a) * convolution(x, L_a, n) + rate(b) * convolution(y, L_b, n) + rate(c) * convolution(z, L_c, n)) /
        (odd + 1.0);
    y[n + 1] =
        0.5 * (rate(b) * convolution(w, L_b, n) + rate(a) * convolution(z, L_a, n) - rate(c) * convolution(x, L_c, n)) /
        (odd + 1.0);
  }
  // From time -1 to time 1.
  const double F_w = W * W - X * X + Y * Y - Z * Z;
  const double F_a = 2.0 * (W * X - Y * Z);
  const double F_c = 2.0 * (W * Z + X * Y);
  Vector3d J;
  J(a) = t * L(0) / (F_w * F_a);
  J(c) = t * L(2) / (F_w * F_c);
  J(b) = 1.0 / (f_a / J(a) + f_c / J(c));
  return J;
}

}  // namespace

RigidPlan rigid_plan(Integrator integrator, const Vector3d& I_B, const Vector3d& L_B, double h) {
  RigidPlan plan;
  plan.h = h;
  plan.I_B = I_B;
  if (integrator == Integrator::dmv) plan.dmv_moments = dmv_moments(I_B, L_B, h);
  return plan;
}

void rk4_steps(RigidState& state, const RigidPlan& plan, long n, Normalization& normalization) {
  const Vector3d half = 0.5 * plan.I_B.cwiseInverse();
  const Vector3d pull = pulls(plan.I_B);
  const double h = plan.h;
  const auto rates = [ax = half.x(), ay = half.y(), az = half.z(), bx = pull.x(), by = pull.y(),
                      bz = pull.z()](const Scalars& s) -> Scalars {
    const double p = s.Lx * ax;  // omega / 2
    const double q = s.Ly * ay;
    const double r = s.Lz * az;
    return {-(s.x * p + s.y * q + s.z * r),
            s.w * p + s.y * r - s.z * q,
            s.w * q + s.z * p - s.x * r,
            s.w * r + s.x * q - s.y * p,
            bx * (s.Ly * s.Lz),
            by * (s.Lz * s.Lx),
            bz * (s.Lx * s.Ly)};
  };
  const auto moved = [](const Scalars& s, double by, const Scalars& d) -> Scalars {
    return {s.w + by * d.w,   s.x + by * d.x,   s.y + by * d.y,  s.z + by * d.z,
            s.Lx + by * d.Lx, s.Ly + by * d.Ly, s.Lz + by * d.Lz};
  };
  repeat(state, n, normalization, [=](Scalars& s) {
    const Scalars k1 = rates(s);
    const Scalars k2 = rates(moved(s, 0.5 * h, k1));
    const Scalars k3 = rates(moved(s, 0.5 * h, k2));
    const Scalars k4 = rates(moved(s, h, k3));
    s = moved(s, h / 6.0, moved(moved(k1, 1.0, k4), 2.0, moved(k2, 1.0, k3)));
  });
}

// With F = (1, e) / sqrt(1 + e^2) the matrix equation reads, and cyclically,
//   e_1 I_1 + (I_3 - I_2) e_2 e_3 = (1 + e^2) h L_1 / 2.
// Newton's iteration from the second-order guess converges in 2 or 3 rounds; the solution that tends to 0 with h has
// |e| < 1.
void dmv_steps(RigidState& state, const RigidPlan& plan, long n, Normalization& normalization) {
  const double I1 = plan.dmv_moments.x(), I2 = plan.dmv_moments.y(), I3 = plan.dmv_moments.z();
  const double gap1 = I3 - I2, gap2 = I1 - I3, gap3 = I2 - I1;
  const double a1 = 1.0 / I1, a2 = 1.0 / I2, a3 = 1.0 / I3;
  const double half_h = 0.5 * plan.h;
  const double change1 = gap1 * 2.0 / half_h, change2 = gap2 * 2.0 / half_h, change3 = gap3 * 2.0 / half_h;
  repeat(state, n, normalization, [=](Scalars& s) {
    const double l1 = half_h * s.Lx, l2 = half_h * s.Ly, l3 = half_h * s.Lz;
    const double w1 = l1 * a1, w2 = l2 * a2, w3 = l3 * a3;
    double e1 = (l1 + (l2 * w3 - l3 * w2)) * a1;
    double e2 = (l2 + (l3 * w1 - l1 * w3)) * a2;
    double e3 = (l3 + (l1 * w2 - l2 * w1)) * a3;
    double size = 0.0;
    bool solved = false;
    for (int round = 0; round < 20 && !solved; ++round) {
      size = 1.0 + e1 * e1 + e2 * e2 + e3 * e3;
      const double r1 = e1 * I1 + gap1 * (e2 * e3) - size * l1;
      const double r2 = e2 * I2 + gap2 * (e3 * e1) - size * l2;
      const double r3 = e3 * I3 + gap3 * (e1 * e2) - size * l3;
      const double d1 = 2.0 * e1, d2 = 2.0 * e2, d3 = 2.0 * e3;
      // J = (u, v, w): columns of the derivative.
      const double u1 = I1 - d1 * l1, u2 = gap2 * e3 - d1 * l2, u3 = gap3 * e2 - d1 * l3;
      const double v1 = gap1 * e3 - d2 * l1, v2 = I2 - d2 * l2, v3 = gap3 * e1 - d2 * l3;
      const double p1 = gap1 * e2 - d3 * l1, p2 = gap2 * e1 - d3 * l2, p3 = I3 - d3 * l3;
      const double n1 = v2 * p3 - v3 * p2, n2 = v3 * p1 - v1 * p3, n3 = v1 * p2 - v2 * p1;  // v x p
      const double m1 = r2 * u3 - r3 * u2, m2 = r3 * u1 - r1 * u3, m3 = r1 * u2 - r2 * u1;  // r x u
      const double over = 1.0 / (u1 * n1 + u2 * n2 + u3 * n3);
      const double c1 = over * (r1 * n1 + r2 * n2 + r3 * n3);
      const double c2 = -over * (p1 * m1 + p2 * m2 + p3 * m3);
      const double c3 = over * (v1 * m1 + v2 * m2 + v3 * m3);
      e1 -= c1;
      e2 -= c2;
      e3 -= c3;
      solved = c1 * c1 + c2 * c2 + c3 * c3 <= 1e-18 * (size - 1.0);
    }
    size = e1 * e1 + e2 * e2 + e3 * e3;
    if (!solved || !(size < 1.0)) {
      s = {nan, nan, nan, nan, nan, nan, nan};
      return;
    }
    // L' = F^T L, with the equation used once more: a small component keeps its digits.
    const double square = 1.0 / (1.0 + size);
    s.Lx -= square * change1 * (e2 * e3);
    s.Ly -= square * change2 * (e3 * e1);
    s.Lz -= square * change3 * (e1 * e2);
    const double w = std::sqrt(square);
    const double x = w * e1, y = w * e2, z = w * e3;  // q F
    s = {s.w * w - s.x * x - s.y * y - s.z * z,
         s.w * x + s.x * w + s.y * z - s.z * y,
         s.w * y + s.y * w + s.z * x - s.x * z,
         s.w * z + s.z * w + s.x * y - s.y * x,
         s.Lx,
         s.Ly,
         s.Lz};
  });
}

}  // namespace bookspin
