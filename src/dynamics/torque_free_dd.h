// Double-double arithmetic: an unevaluated sum hi + lo with |lo| <= ulp(hi) / 2, about 31 decimal digits.
//
// Only what the setup of TorqueFree needs, so that a phase keeps 16 digits after 1e15 turns.
// Exact sum: Knuth; exact product: Dekker's splitting (no fused multiply-add, so that every machine gets the same
// bits). Preconditions: finite values, magnitudes below 1e290; below 1e-290 the low part fades to zero. Source: Dekker,
// Numer. Math. 18 (1971) 224; Hida, Li & Bailey, ARITH-15 (2001) 155, algorithms 3 to 14.
#pragma once

#include <array>
#include <cmath>

namespace bookspin {

struct Dd {
  double hi = 0;  // the value, rounded
  double lo = 0;  // what the rounding lost

  constexpr Dd() = default;
  constexpr Dd(double hi_, double lo_ = 0) : hi(hi_), lo(lo_) {}  // NOLINT(*-explicit-*): a double is a Dd
  constexpr explicit operator double() const { return hi; }
  [[nodiscard]] long double wide() const { return static_cast<long double>(hi) + static_cast<long double>(lo); }
};

inline constexpr Dd dd_pi{3.141592653589793116, 1.2246467991473532072e-16};

// |a| >= |b| or a = 0.
constexpr Dd quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

constexpr Dd two_sum(double a, double b) {
  const double sum = a + b;
  const double b_part = sum - a;
  return {sum, (a - (sum - b_part)) + (b - b_part)};
}

constexpr Dd two_product(double a, double b) {
  constexpr double splitter = 134217729.0;  // 2^27 + 1
  const double product = a * b;
  const double a_scaled = splitter * a;
  const double b_scaled = splitter * b;
  const double a_high = a_scaled - (a_scaled - a);
  const double b_high = b_scaled - (b_scaled - b);
  const double a_low = a - a_high;
  const double b_low = b - b_high;
  return {product, ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low};
}

constexpr Dd operator-(Dd a) {
  return {-a.hi, -a.lo};
}

constexpr Dd operator+(Dd a, Dd b) {
  const Dd high = two_sum(a.hi, b.hi);
  const Dd low = two_sum(a.lo, b.lo);
  const Dd carried = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(carried.hi, carried.lo + low.lo);
}

constexpr Dd operator-(Dd a, Dd b) {
  return a + (-b);
}

constexpr Dd operator*(Dd a, Dd b) {
  const Dd product = two_product(a.hi, b.hi);
  return quick_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

constexpr Dd operator/(Dd a, Dd b) {
  const double first = a.hi / b.hi;
  Dd rest = a - b * first;
  const double second = rest.hi / b.hi;
  rest = rest - b * second;
  return quick_two_sum(first, second) + rest.hi / b.hi;
}

constexpr bool operator<(Dd a, Dd b) {
  return a.hi < b.hi || (a.hi == b.hi && a.lo < b.lo);
}

inline Dd abs(Dd a) {
  return a.hi < 0 ? -a : a;
}

// a >= 0. One step of Newton's iteration from the rounded root.
inline Dd sqrt(Dd a) {
  if (!(a.hi > 0)) return {};
  const double root = std::sqrt(a.hi);
  return quick_two_sum(root, (a - two_product(root, root)).hi / (2 * root));
}

// sqrt(a^2 + b^2), a and b >= 0; squares of tiny values do not underflow.
inline Dd hypot(Dd a, Dd b) {
  if (a < b) return hypot(b, a);
  if (!(a.hi > 0)) return {};
  const Dd ratio = b / a;
  return a * sqrt(ratio * ratio + 1.0);
}

// Arithmetic-geometric mean of 1 and 0 < b <= 1: the complete integral K(k) is pi / (2 agm(1, k')) (DLMF 19.8.5).
inline Dd agm(Dd b) {
  Dd a = 1.0;
  while (std::abs(a.hi - b.hi) > 1e-15 * a.hi) {
    const Dd mean = (a + b) * 0.5;
    b = sqrt(a * b);
    a = mean;
  }
  return (a + b) * 0.5;  // quadratic convergence: the last mean is exact to 1e-31
}

// Arc tangent of 0 <= v <= 1: three halvings of the angle, then Taylor, in double where its terms are below 1e-16.
inline Dd atan(Dd v) {
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

}  // namespace bookspin
