#include "dynamics/torque_free_theta.h"

namespace bookspin {
namespace {

// q = epsilon + 2 epsilon^5 + 15 epsilon^9 + ..., DLMF 19.5.6; here epsilon < 0.0433, and double is enough from the
// fourth term.
Dd nome_over_epsilon(Dd epsilon) {
  const Dd square = epsilon * epsilon;
  const Dd fourth = square * square;
  double tail = 0;
  for (const double term : {48555069.0, 3567400.0, 268616.0, 20910.0, 1707.0, 150.0}) tail = (tail + term) * fourth.hi;
  return ((fourth * (Dd(15.0) + tail)) + 2.0) * fourth + 1.0;
}

constexpr double negligible = 1e-34;

// Theta functions at a point of the imaginary axis, or their image: each Real is a double or a Dd.
template <class Real>
struct ThetaSums {
  Real theta1, partner;  // the quotient theta1 / partner is what eta is found from
  Real slope;            // d(arg alpha)/dx at x = 0, times partner
};

// At z = i eta, nome Q = p^2, in terms of c = 2 sqrt(p) sinh eta: theta1 / i and theta4 are polynomials in e = 2 p cosh
// 2 eta: U_n = p^n sinh((2n+1) eta) / sinh eta, V_n = 2 p^n cosh 2n eta, W_n = p^n sinh 2n eta / sinh 2 eta.
template <class Real>
ThetaSums<Real> trigonometric_sums(Real c, Real p) {
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
  using std::sqrt;  // or, by argument, that of Dd
  sums.slope = sums.slope * c * sqrt(c2 + p * 4.0);
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

double theta3_squared(double Q) {
  const double Q4 = Q * Q * Q * Q;
  const double theta3 = 1 + 2 * (Q + Q4 + Q4 * Q4 * Q);
  return theta3 * theta3;
}

double rounded(long double x) {
  return static_cast<double>(x);
}

// theta1..4(x, p) and alpha = theta4(x + i s eta, p^2) as polynomials in C = cos 2x.
void trigonometric_coefficients(long double p, long double c, long double root_k_prime, long double s,
                                ThetaForm& form) {
  const auto power = [p](int n) {
    long double product = 1;
    for (int i = 0; i < n; ++i) product *= p;
    return product;
  };
  const long double p2 = power(2), p4 = power(4), p6 = power(6), p9 = power(9), p12 = power(12), p16 = power(16),
                    p20 = power(20);
  const long double theta2_0 = 1 + p2 + p6 + p12 + p20 + p20 * p9 * p;
  const long double theta3_0 = 1 + 2 * (p + p4 + p9 + p16 + p16 * p9);
  const long double to_sn = theta3_0 / theta2_0;
  const long double to_cn = root_k_prime * theta3_0 / theta2_0;
  form.theta1 = {rounded(to_sn * (1 - p2 - p6 + p12 + p20)), rounded(to_sn * (-2 * p2 + 2 * p6 + 4 * p12 - 4 * p20)),
                 rounded(to_sn * (4 * p6 - 4 * p12 - 12 * p20)), rounded(to_sn * (-8 * p12 + 8 * p20)),
                 rounded(to_sn * 16 * p20)};
  form.theta2 = {rounded(to_cn * (1 - p2 - p6 + p12 + p20)), rounded(to_cn * (2 * p2 - 2 * p6 - 4 * p12 + 4 * p20)),
                 rounded(to_cn * (4 * p6 - 4 * p12 - 12 * p20)), rounded(to_cn * (8 * p12 - 8 * p20)),
                 rounded(to_cn * 16 * p20)};
  form.even = {rounded(1 - 2 * p4 + 2 * p16), rounded(4 * p4 - 16 * p16), rounded(16 * p16)};
  form.odd = {rounded(2 * p - 6 * p9), rounded(8 * p9)};
  form.dn_scale = rounded(root_k_prime);

  // y = sqrt(p) exp(eta) and p / y = sqrt(p) exp(-eta) stay finite when p = 0.
  const long double y = (c + std::sqrt(c * c + 4 * p)) / 2;
  const long double up = y * y;
  const long double down = p / y * (p / y);
  const long double w1 = -p, w2 = p6, w3 = -(power(15));
  const long double re1 = w1 * (up + down), re2 = w2 * (up * up + down * down);
  const long double re3 = w3 * (up * up * up + down * down * down);
  const long double im1 = -s * w1 * (up - down), im2 = -s * w2 * (up * up - down * down);
  const long double im3 = -s * w3 * (up * up * up - down * down * down);
  form.alpha_re = {rounded(1 - re2), rounded(re1 - 3 * re3), rounded(2 * re2), rounded(4 * re3)};
  form.alpha_im = {rounded(2 * (im1 - im3)), rounded(4 * im2), rounded(8 * im3), 0};
}

// theta1..4(2 i X, Q'^2) as polynomials in J = 2 q' cosh 4X, q' = Q'^2, and alpha = theta2(-s eta' + i X, Q') as
// polynomials in H = 2 Q' cosh 2X.
void hyperbolic_coefficients(long double Q, long double tangent, long double s, ThetaForm& form) {
  const long double q = Q * Q;
  const long double q2 = q * q, q4 = q2 * q2, q5 = q4 * q, q6 = q5 * q;
  const long double theta2_0 = 1 + q2 + q6;
  const long double theta3_0 = 1 + 2 * q + 2 * q4;
  const long double theta4_0 = 1 - 2 * q + 2 * q4;
  const long double to_sn = theta3_0 / theta4_0;
  form.theta1 = {rounded(to_sn * (1 - q2 - q6)), rounded(to_sn * (-q + q5)), rounded(to_sn * q4), 0, 0};
  form.theta2 = {rounded(1 - q2 - q6), rounded(q - q5), rounded(q4), 0, 0};
  form.even = {rounded(1 - 2 * q4), rounded(q2), 0};
  form.cn_scale = rounded(theta2_0 / theta4_0);
  form.dn_scale = rounded(theta2_0 / theta3_0);

  std::array<long double, 4> re{};
  std::array<long double, 4> im{};
  const long double cosine = 1 / std::sqrt(1 + tangent * tangent);
  const long double sine = s * tangent * cosine;
  const long double cos2 = (cosine - sine) * (cosine + sine);
  const long double sin2 = 2 * sine * cosine;
  re[0] = cosine;
  im[0] = sine;
  for (std::size_t n = 1; n < 4; ++n) {
    re[n] = re[n - 1] * cos2 - im[n - 1] * sin2;
    im[n] = im[n - 1] * cos2 + re[n - 1] * sin2;
  }
  const long double Q2 = q, Q4 = q2, Q5 = q2 * Q, Q6 = q2 * q, Q9 = q4 * Q, Q10 = q5, Q11 = q5 * Q, Q12 = q6;
  form.alpha_re = {rounded(re[0] - Q2 * re[1] - Q6 * re[2] + Q12 * re[3]),
                   rounded(Q * re[1] - Q5 * re[2] - 2 * Q11 * re[3]), rounded(Q4 * re[2] - Q10 * re[3]),
                   rounded(Q9 * re[3])};
  form.alpha_im = {rounded(im[0] + Q2 * im[1] - Q6 * im[2] - Q12 * im[3]),
                   rounded(Q * im[1] + Q5 * im[2] - 2 * Q11 * im[3]), rounded(Q4 * im[2] + Q10 * im[3]),
                   rounded(Q9 * im[3])};
}

ThetaForm trigonometric_form(const EllipticMotion& motion) {
  ThetaForm form;
  // Landen: Q is the nome of k1 = (1 - k') / (1 + k'), k1' = 2 sqrt k' / (1 + k'); k1 and 1 - sqrt k1' from k, not from
  // 1 - k'.
  const Dd root_k_prime = sqrt(motion.k_prime);
  const Dd k_over = motion.k / (motion.k_prime + 1.0);
  const Dd k1 = k_over * k_over;
  const Dd k1_prime = root_k_prime * 2.0 / (motion.k_prime + 1.0);
  const Dd half = k1 / (sqrt(k1_prime + 1.0) * (sqrt(k1_prime) + 1.0));
  const Dd epsilon = half * half * 0.5;
  const Dd p = half * sqrt(nome_over_epsilon(epsilon) * 0.5);

  const Dd rate = motion.lambda * agm(motion.k_prime);
  form.frequency = rate / dd_pi;
  form.period = dd_pi.hi;
  // d(theta1 / i theta4)/d eta = theta3(Q)^2 sqrt((k1 + T^2)(1 + k1 T^2)), d eta / dc = 1 / sqrt(c^2 + 4 p).
  const double T2 = motion.tangent.hi * motion.tangent.hi;
  const double by_eta = theta3_squared(p.hi * p.hi) * std::sqrt((k1.hi + T2) * (1 + k1.hi * T2));
  const Dd c = solve(
      motion.tangent, [&](auto at) { return trigonometric_sums(at, decltype(at)(p)); },
      [&](double at) { return by_eta / std::sqrt(at * at + 4 * p.hi); });
  const auto sums = trigonometric_sums(c, p);
  form.mu = motion.rate_at_zero - rate * sums.slope / sums.partner * motion.s;
  trigonometric_coefficients(p.wide(), c.wide(), root_k_prime.wide(), motion.s, form);
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
  form.nome = nome.hi;

  const Dd agm_k = agm(motion.k);
  const Dd rate = motion.lambda * agm_k * 0.5;
  // d(theta1 / theta2)/d eta' = theta3(Q')^2 sqrt((k1 + T^2)(1 + k1 T^2)), d eta' / dv = 1 / (1 + v^2).
  const double T2 = motion.tangent.hi * motion.tangent.hi;
  const double by_eta = theta3_squared(nome.hi) * std::sqrt((k1.hi + T2) * (1 + k1.hi * T2));
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
    form.kappa = kappa.hi;
    form.mu = form.mu + kappa * rate;
  } else {
    form.frequency = rate;
    form.reduce = 0;
  }
  hyperbolic_coefficients(nome.wide(), v.wide(), motion.s, form);
  return form;
}

}  // namespace

ThetaForm theta_form(const EllipticMotion& motion) {
  constexpr double switch_k_prime = 0.17157287525380990;  // (sqrt 2 - 1)^2: K = 2 K'
  return motion.k_prime.hi < switch_k_prime ? hyperbolic_form(motion) : trigonometric_form(motion);
}

}  // namespace bookspin
