#include "dynamics/torque_free_theta.h"

namespace bookspin {
namespace {

constexpr double negligible = 1e-34;
constexpr int enough = 40;  // rounds of an iteration that converges within 15

// Arithmetic-geometric mean of 1 and 0 < b <= 1: the complete integral K(k) is pi / (2 agm(1, k')) (DLMF 19.8.5).
Dd agm(Dd b) {
  Dd a = 1.0;
  for (int round = 0; round < enough && std::abs(a.hi - b.hi) > 1e-15 * a.hi; ++round) {
    const Dd mean = (a + b) * 0.5;
    b = sqrt(a * b);
    a = mean;
  }
  return (a + b) * 0.5;  // quadratic convergence: the last mean is exact to 1e-31
}

// Arc tangent of 0 <= v <= 1: three halvings of the angle, then Taylor, in double where its terms are below 1e-16.
Dd atan(Dd v) {
  static constexpr auto reciprocals = [] {
    std::array<Dd, 8> table;
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = Dd(1.0) / (2.0 * static_cast<double>(i) + 1);
    return table;
  }();
  for (int halving = 0; halving < 3; ++halving) v = v / (sqrt(v * v + 1.0) + 1.0);
  const Dd square = v * v;
  double tail = 0;
  for (int odd = 31; odd > 15; odd -= 2) tail = 1.0 / odd - square.hi * tail;
  Dd sum = tail;
  for (std::size_t i = reciprocals.size(); i-- > 0;) sum = reciprocals[i] - square * sum;
  return v * sum * 8.0;
}

// q = epsilon + 2 epsilon^5 + 15 epsilon^9 + ..., DLMF 19.5.6; here epsilon < 0.0433, and double is enough from the
// fourth term.
Dd nome_over_epsilon(Dd epsilon) {
  const Dd square = epsilon * epsilon;
  const Dd fourth = square * square;
  double tail = 0;
  for (const double term : {48555069.0, 3567400.0, 268616.0, 20910.0, 1707.0, 150.0}) tail = (tail + term) * fourth.hi;
  return ((fourth * (Dd(15.0) + tail)) + 2.0) * fourth + 1.0;
}

// Theta functions at a point of the imaginary axis, or their image: each Real is a double or a Dd.
template <class Real>
struct ThetaSums {
  Real theta1, partner;  // the quotient theta1 / partner is what eta is found from
  Real slope;            // d(arg alpha)/dx at x = 0, times partner
};

// c sqrt(c^2 + 4 p), divided by c^2, with p = r^2: squares of tiny values do not underflow.
template <class Real>
Real root_over_c(Real c, Real r) {
  using std::sqrt;  // or, by argument, that of Dd
  const Real ratio = r * 2.0 / c;
  return sqrt(ratio * ratio + 1.0);
}

// At z = i eta, nome Q = p^2, p = r^2, in terms of c = 2 r sinh eta: theta1 / i and theta4 are polynomials in e = 2 p
// cosh 2 eta: U_n = p^n sinh((2n+1) eta) / sinh eta, V_n = 2 p^n cosh 2n eta, W_n = p^n sinh 2n eta / sinh 2 eta.
template <class Real>
ThetaSums<Real> trigonometric_sums(Real c, Real r) {
  const Real p = r * r;
  const Real c2 = c * c;
  const Real e = c2 + p * 2.0;
  const Real p2 = p * p;
  const Real p4 = p2 * p2;
  Real U = e + p;
  Real U_before = 1.0;
  Real V = e;
  Real V_before = 2.0;
  Real W = 1.0;
  Real W_before = 0.0;
  Real weight4 = -p;   // (-1)^n p^(2n^2-n)
  Real power = p2;     // p^(2n): weight1 / weight4
  Real step = p4 * p;  // p^(4n+1)
  ThetaSums<Real> sums{1.0, 1.0, 0.0};
  const auto recur = [&](Real& now, Real& before) {
    const Real next = e * now - p2 * before;
    before = now;
    now = next;
  };
  for (int n = 1; std::abs(static_cast<double>(weight4)) > negligible; ++n) {
    sums.theta1 = sums.theta1 + weight4 * power * U;
    sums.partner = sums.partner + weight4 * V;
    sums.slope = sums.slope - weight4 * W * (2.0 * n);
    recur(U, U_before);
    recur(V, V_before);
    recur(W, W_before);
    weight4 = -(weight4 * step);
    power = power * p2;
    step = step * p4;
  }
  sums.theta1 = sums.theta1 * c;
  sums.slope = sums.slope * c2 * root_over_c(c, r);
  return sums;
}

// theta1(eta, Q') and theta2(eta, Q') over cos eta, in terms of v = tan eta:
// S_n = sin((2n+1) eta) / sin eta and C_n = cos((2n+1) eta) / cos eta are polynomials in w = 2 cos 2 eta.
template <class Real>
ThetaSums<Real> hyperbolic_sums(Real v, Real nome) {
  const Real v2 = v * v;
  const Real w = (Real(1.0) - v2) * 2.0 / (v2 + 1.0);
  Real S = w + 1.0;
  Real S_before = 1.0;
  Real C = w - 1.0;
  Real C_before = 1.0;
  const Real nome2 = nome * nome;
  Real weight = nome2;  // Q'^(n(n+1))
  Real step = nome2 * nome2;
  ThetaSums<Real> sums{1.0, 1.0, 1.0};
  const auto recur = [&](Real& now, Real& before) {
    const Real next = w * now - before;
    before = now;
    now = next;
  };
  double sign = -1;
  for (int n = 1; static_cast<double>(weight) > negligible; ++n) {
    const Real term = weight * S;
    sums.theta1 = sums.theta1 + term * sign;
    sums.partner = sums.partner + weight * C;
    sums.slope = sums.slope + term * (2.0 * n + 1);
    recur(S, S_before);
    recur(C, C_before);
    weight = weight * step;
    step = step * nome2;
    sign = -sign;
  }
  sums.theta1 = sums.theta1 * v;
  sums.slope = sums.slope * v;
  return sums;
}

// Newton's iteration for theta1 / partner = target, in double and once more in double-double. slope: the derivative at
// the root, in closed form, so that the step from 16 digits gives 31.
template <class Sums, class Slope>
Dd solve(Dd target, const Sums& sums, const Slope& slope) {
  double root = target.hi;
  for (int step = 0; step < 10; ++step) {
    const auto at = sums(root);
    const double change = (at.theta1 / at.partner - target.hi) / slope(root);
    root -= change;
    if (std::abs(change) <= 1e-15 * root) break;
  }
  const auto at = sums(Dd(root));
  return Dd(root) - (at.theta1 / at.partner - target).hi / slope(root);
}

double power(double x, std::size_t n) {
  double product = 1;
  for (; n > 0; n /= 2, x *= x) {
    if (n % 2 == 1) product *= x;
  }
  return product;
}

// w_0 + sum of w_n v_n, v_0 = 2, v_1 = x, v_(n+1) = x v_n - beta v_(n-1), as coefficients of powers of x (Clenshaw):
// v_n = 2 p^n cos 2nx is a polynomial in x = 2 p cos 2x, with beta = p^2; with cosh as well.
template <std::size_t N>
std::array<double, N> in_powers(const std::array<double, N>& w, double beta) {
  std::array<double, N> b{};
  std::array<double, N> b_before{};
  for (std::size_t n = N - 1; n > 0; --n) {
    std::array<double, N> next{};
    next[0] = w[n] - beta * b_before[0];
    for (std::size_t i = 1; i < N; ++i) next[i] = b[i - 1] - beta * b_before[i];
    b_before = b;
    b = next;
  }
  std::array<double, N> sum{};
  sum[0] = w[0] - 2 * beta * b_before[0];
  for (std::size_t i = 1; i < N; ++i) sum[i] = b[i - 1] - 2 * beta * b_before[i];
  return sum;
}

// Sum of t_n p^(n (n+1)) sin((2n+1) x) / sin x = 1 + 2 cos 2x + ... + 2 cos 2nx, likewise.
template <std::size_t N>
std::array<double, N> odd_multiples(const std::array<double, N>& t, double p) {
  std::array<double, N> w{};
  for (std::size_t j = 0; j < N; ++j) {
    for (std::size_t n = N; n-- > j;) w[j] += t[n] * power(p, n * (n + 1) - j);
  }
  return in_powers(w, p * p);
}

// theta1..4(x, p), in powers of 2 p cos 2x; or of 2 p cosh 2x for imaginary x.
void elliptic_polynomials(double p, ThetaForm& form) {
  form.theta12 = odd_multiples<5>({1, -1, 1, -1, 1}, p);
  form.theta34 = in_powers<5>({1, 1, power(p, 2), power(p, 6), power(p, 12)}, p * p);
}

struct ThetaConstants {
  Dd theta2, theta3, theta4;  // theta2 over 2 p^(1/4)
};

ThetaConstants theta_constants(Dd p) {
  const Dd p2 = p * p;
  const double q = p.hi;
  const Dd even = Dd(1.0) + 2 * (power(q, 4) + power(q, 16));
  const Dd odd = (p + power(q, 9) + power(q, 25)) * 2.0;
  return {p2 + 1.0 + (power(q, 6) + power(q, 12) + power(q, 20) + power(q, 30)), even + odd, even - odd};
}

ThetaForm trigonometric_form(const EllipticMotion& motion) {
  ThetaForm form;
  // Landen: Q is the nome of k1 = (1 - k') / (1 + k'), k1' = 2 sqrt k' / (1 + k'); k1 and 1 - sqrt k1' from k, not from
  // 1 - k'.
  const Dd root_k_prime = sqrt(motion.k_prime);
  const Dd root_k1 = motion.k / (motion.k_prime + 1.0);
  const Dd k1_prime = root_k_prime * 2.0 / (motion.k_prime + 1.0);
  const Dd divisor = sqrt(k1_prime + 1.0) * (sqrt(k1_prime) + 1.0);
  const Dd half = root_k1 * root_k1 / divisor;
  const Dd r = root_k1 * sqrt(sqrt(nome_over_epsilon(half * half * 0.5) * 0.5) / divisor);
  const Dd p = r * r;

  const Dd rate = motion.lambda * agm(motion.k_prime);
  form.frequency = rate / dd_pi;
  // d(theta1 / i theta4)/d eta = theta3(Q)^2 sqrt((k1 + T^2)(1 + k1 T^2)), d eta / dc = 1 / sqrt(c^2 + 4 p).
  const double T = motion.tangent.hi;
  const double theta3 = theta_constants(p * p).theta3.hi;
  const double by_eta =
      theta3 * theta3 * root_over_c(T, root_k1.hi / 2) * std::sqrt(1 + root_k1.hi * root_k1.hi * T * T);  // over T
  const Dd c = solve(
      motion.tangent, [&](auto at) { return trigonometric_sums(at, decltype(at)(r)); },
      [&](double at) { return by_eta * (T / at) / root_over_c(at, r.hi); });
  const auto sums = trigonometric_sums(c, r);
  form.mu = motion.rate_at_zero - rate * sums.slope / sums.partner * motion.s;

  form.nome = p.hi;
  elliptic_polynomials(p.hi, form);
  const ThetaConstants at_zero = theta_constants(p);
  form.sn_scale = at_zero.theta3 / at_zero.theta2;
  form.cn_scale = root_k_prime * form.sn_scale;
  form.dn_scale = root_k_prime;

  // theta4(x + i s eta, Q) = 1 + sum of (-1)^n Q^(n^2) 2 cos(2n (x + i s eta)); sqrt(p) exp(+-eta) are finite at p = 0.
  const double y = c.hi * (1 + root_over_c(c.hi, r.hi)) / 2;
  const double up = y * y;
  const double down = power(r.hi * (r.hi / y), 2);
  std::array<double, 4> re{1, 0, 0, 0};
  std::array<double, 4> im{};
  for (std::size_t n = 1; n < 4; ++n) {
    const double weight = (n % 2 == 0 ? 0.5 : -0.5) * power(p.hi, 2 * n * (n - 1));
    re[n] = weight * (power(up, n) + power(down, n));
    im[n] = -motion.s * 4 * p.hi * weight * (power(up, n) - power(down, n));
  }
  form.alpha_re = in_powers(re, power(p.hi, 2));
  form.alpha_im = {im[1] - power(p.hi, 2) * im[3], im[2], im[3], 0};
  return form;
}

ThetaForm hyperbolic_form(const EllipticMotion& motion) {
  ThetaForm form;
  form.hyperbolic = true;
  // Landen: Q' is the nome of k1' = 2 sqrt k' / (1 + k'); 1 - sqrt k1 from k', not from 1 - k'.
  const Dd k1 = (Dd(1.0) - motion.k_prime) / (motion.k_prime + 1.0);
  const Dd root = sqrt(k1) + 1.0;
  const Dd epsilon = motion.k_prime / ((motion.k_prime + 1.0) * root * root);
  const Dd nome = epsilon * nome_over_epsilon(epsilon);

  const Dd agm_k = agm(motion.k);
  const Dd rate = motion.lambda * agm_k * 0.5;
  // d(theta1 / theta2)/d eta' = theta3(Q')^2 sqrt((k1 + T^2)(1 + k1 T^2)), d eta' / dv = 1 / (1 + v^2).
  const double T2 = motion.tangent.hi * motion.tangent.hi;
  const double theta3 = theta_constants(nome).theta3.hi;
  const double by_eta = theta3 * theta3 * std::sqrt((k1.hi + T2) * (1 + k1.hi * T2));
  const Dd v = solve(
      motion.tangent, [&](auto at) { return hyperbolic_sums(at, decltype(at)(nome)); },
      [&](double at) { return by_eta / (1 + at * at); });
  const auto sums = hyperbolic_sums(v, nome);
  form.mu = motion.rate_at_zero - rate * sums.slope / sums.partner * motion.s;
  if (motion.k_prime.hi > 0) {
    const Dd period = dd_pi * 0.5 * agm_k / agm(motion.k_prime);
    const Dd kappa = atan(v) * (2 * motion.s) / period;
    form.frequency = rate / period;
    form.period = period.hi;
    form.limit = std::min(form.limit, 0.5 * form.period);
    form.kappa = (kappa * 2.0 / dd_pi).hi;
    form.mu = form.mu + kappa * rate;
  } else {
    form.frequency = rate;
    form.reduce = 0;
  }

  const double Q = nome.hi;
  form.nome = Q;
  elliptic_polynomials(Q * Q, form);
  const ThetaConstants at_zero = theta_constants(nome * nome);
  form.sn_scale = at_zero.theta3 / at_zero.theta4;
  form.cn_scale = at_zero.theta2 / at_zero.theta4;
  form.dn_scale = at_zero.theta2 / at_zero.theta3;

  // theta2(-s eta' + i X, Q') = sum of Q'^(n (n+1)) cos((2n+1)(-s eta' + i X)), over cos eta'.
  const double w = 2 * (1 - v.hi * v.hi) / (1 + v.hi * v.hi);
  std::array<double, 4> S{1, w + 1, 0, 0};
  std::array<double, 4> C{1, w - 1, 0, 0};
  for (std::size_t n = 2; n < 4; ++n) {
    S[n] = w * S[n - 1] - S[n - 2];
    C[n] = w * C[n - 1] - C[n - 2];
  }
  form.alpha_re = odd_multiples<4>({C[0], -C[1], C[2], -C[3]}, Q);
  form.alpha_im = odd_multiples(S, Q);
  for (std::size_t i = 0; i < 4; ++i) {
    if (i % 2 == 1) form.alpha_re[i] = -form.alpha_re[i];
    form.alpha_im[i] = (v * form.alpha_im[i]).hi * motion.s;
  }
  return form;
}

}  // namespace

ThetaForm theta_form(const EllipticMotion& motion) {
  constexpr double switch_k_prime = 0.17157287525380990;  // (sqrt 2 - 1)^2: K = 2 K'
  return motion.k_prime.hi < switch_k_prime ? hyperbolic_form(motion) : trigonometric_form(motion);
}

}  // namespace bookspin
