#include "dynamics/torque_free_theta.h"

namespace bookspin {
namespace {

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

// Arc tangent of 0 <= v <= 1: three halvings of the angle, then Taylor.
Dd atan(Dd v) {
  for (int halving = 0; halving < 3; ++halving) v = v / (sqrt(v * v + 1.0) + 1.0);
  const Dd square = v * v;
  Dd sum;
  for (int odd = 31; odd > 0; odd -= 2) sum = Dd(1.0) / odd - square * sum;
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

// c sqrt(c^2 + 4 r^2) over c^2: squares of tiny values do not underflow.
template <class Real>
Real root_over_c(Real c, Real r) {
  using std::sqrt;  // or, by argument, that of Dd
  const Real ratio = r * 2.0 / c;
  return sqrt(ratio * ratio + 1.0);
}

// Section 4: theta functions are sums w_0 + w_1 v_1 + w_2 v_2 + ...; here the weights are prepared, at nome p.

// Sum of t_n p^(n^2) 2 cos 2nx, or of t_n p^(n^2) 2 sin 2nx: w_n = t_n p^(n^2 - n), in which step = p^(2n).
template <class Real, std::size_t N>
std::array<Real, N> even_multiples(const std::array<double, N>& t, Real p, Real step = 1.0) {
  std::array<Real, N> w;
  Real power = 1.0;
  for (std::size_t n = 0; n < N; ++n) {
    w[n] = power * t[n];
    power = power * step;
    step = step * p * p;
  }
  return w;
}

// Sum of t_n p^(n (n+1)) sin((2n+1) x) / sin x: w_n = t_n p^(n^2) + p w_(n+1).
template <class Real, std::size_t N>
std::array<Real, N> odd_multiples(const std::array<double, N>& t, Real p) {
  std::array<Real, N> w = even_multiples(t, p, p);
  for (std::size_t n = N - 1; n > 0; --n) w[n - 1] = w[n - 1] + p * w[n];
  return w;
}

template <class Real>
struct Sums {
  Real cosines;  // w_0 + sum of w_n v_n
  Real sines;    // sum of w_n 2 p^n sin 2nx, over 2 p sin 2x
};

// By Clenshaw's recurrence; v_1 = 2 p cos 2x. With cosh for imaginary x.
template <class Real, std::size_t N>
Sums<Real> sums(const std::array<Dd, N>& w, Real v_1, Real p) {
  const Real p2 = p * p;
  Real b = 0.0;
  Real b_before = 0.0;
  for (std::size_t n = N - 1; n > 0; --n) {
    const Real next = Real(w[n]) + v_1 * b - p2 * b_before;
    b_before = b;
    b = next;
  }
  return {Real(w[0]) + v_1 * b - p2 * b_before * 2.0, b};
}

// The same as coefficients of powers of v_1.
template <std::size_t N>
std::array<double, N> in_powers(const std::array<double, N>& w, double p) {
  std::array<double, N> b{};
  std::array<double, N> b_before{};
  for (std::size_t n = N; n-- > 0;) {
    std::array<double, N> next{};
    next[0] = w[n] - p * p * b_before[0] * (n == 0 ? 2 : 1);
    for (std::size_t i = 1; i < N; ++i) next[i] = b[i - 1] - p * p * b_before[i] * (n == 0 ? 2 : 1);
    b_before = b;
    b = next;
  }
  return b;
}

constexpr std::array<double, 7> alternating{1, -1, 1, -1, 1, -1, 1};

// Newton's iteration for quotient(root) = target, in double and once more in double-double. slope: the derivative at the
// root, in closed form, so that the step from 16 digits gives 31.
template <class Quotient, class Slope>
Dd solve(Dd target, const Quotient& quotient, const Slope& slope) {
  double root = target.hi;
  for (int step = 0; step < 10; ++step) {
    const double change = (quotient(root) - target.hi) / slope(root);
    root -= change;
    if (std::abs(change) <= 1e-15 * root) break;
  }
  return Dd(root) - (quotient(Dd(root)) - target).hi / slope(root);
}

// theta1..4(x, p), in powers of 2 p cos 2x; or of 2 p cosh 2x for imaginary x.
void elliptic_polynomials(double p, ThetaForm& form) {
  form.theta12 = in_powers(odd_multiples<double, 5>({1, -1, 1, -1, 1}, p), p);
  form.theta34 = in_powers(even_multiples<double, 5>({1, 1, 1, 1, 1}, p), p);
}

double power(double x, std::size_t n) {
  double product = 1;
  for (; n > 0; n /= 2, x *= x) {
    if (n % 2 == 1) product *= x;
  }
  return product;
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
  // theta1(i eta, Q) / i = c theta1, v_1 = 2 Q cosh 2 eta, 2 Q sinh 2 eta = p c sqrt(c^2 + 4 p).
  const Dd Q = p * p;
  const auto theta1 = odd_multiples(alternating, Q);
  const auto theta4 = even_multiples(alternating, Q);
  const auto theta1_over_theta4 = [&](auto at) {
    using Real = decltype(at);
    const Real v_1 = Real(p) * (at * at + Real(p) * 2.0);
    return at * sums(theta1, v_1, Real(Q)).cosines / sums(theta4, v_1, Real(Q)).cosines;
  };
  const Dd c =
      solve(motion.tangent, theta1_over_theta4, [&](double at) { return by_eta * (T / at) / root_over_c(at, r.hi); });
  const Dd v_1 = p * (c * c + p * 2.0);
  const auto theta4_slope = even_multiples<Dd, 7>({0, 2, -4, 6, -8, 10, -12}, Q);
  const Dd slope = p * c * c * root_over_c(c, r) * sums(theta4_slope, v_1, Q).sines / sums(theta4, v_1, Q).cosines;
  form.mu = motion.rate_at_zero - rate * slope * motion.s;

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
  form.alpha_re = in_powers(re, p.hi);
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
  // v_1 = 2 Q' cos 2 eta', v = tan eta'; theta2 is theta1 with the sign of v_1 changed.
  const auto theta1 = odd_multiples(alternating, nome);
  const auto v_1 = [&](auto at) {
    using Real = decltype(at);
    return Real(nome) * 2.0 * (Real(1.0) - at * at) / (at * at + 1.0);
  };
  const auto theta1_over_theta2 = [&](auto at) {
    using Real = decltype(at);
    return at * sums(theta1, v_1(at), Real(nome)).cosines / sums(theta1, -v_1(at), Real(nome)).cosines;
  };
  const Dd v = solve(motion.tangent, theta1_over_theta2, [&](double at) { return by_eta / (1 + at * at); });
  const auto theta2_slope = odd_multiples<Dd, 7>({1, 3, 5, 7, 9, 11, 13}, nome);
  const Dd slope = v * sums(theta2_slope, v_1(v), nome).cosines / sums(theta1, -v_1(v), nome).cosines;
  form.mu = motion.rate_at_zero - rate * slope * motion.s;
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
  form.alpha_re = in_powers(odd_multiples<double, 4>({C[0], -C[1], C[2], -C[3]}, Q), Q);
  form.alpha_im = in_powers(odd_multiples(S, Q), Q);
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
