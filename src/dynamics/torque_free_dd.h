// Extended precision for the setup of TorqueFree: what its phases need to keep 16 digits after 1e15 turns.
//
// Dd: double-double, an unevaluated sum hi + lo with |lo| <= ulp(hi) / 2, about 31 decimal digits.
// Expansion: an exact sum of doubles. Exact sum: Knuth; exact product: Dekker's splitting, which rounds as a fused
// multiply-add would. Only + - * / and the square root of IEEE doubles: every machine gets the same bits.
// Preconditions: finite values, magnitudes below 1e290; below 1e-290 the low parts fade to zero.
// Sources: Dekker, Numer. Math. 18 (1971) 224; Hida, Li & Bailey, ARITH-15 (2001) 155, algorithms 3 to 14; Shewchuk,
// Discrete Comput. Geom. 18 (1997) 305, theorem 10.
#pragma once

#include <cfloat>
#include <cmath>
#include <vector>

namespace bookspin {

static_assert(FLT_EVAL_METHOD == 0, "doubles must be rounded after every operation");

struct Dd {
  double hi = 0;  // the value, rounded
  double lo = 0;  // what the rounding lost

  constexpr Dd() = default;
  constexpr Dd(double hi_, double lo_ = 0) : hi(hi_), lo(lo_) {}  // NOLINT(*-explicit-*): a double is a Dd
  constexpr explicit operator double() const { return hi; }
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
  const double quotient = a.hi / b.hi;
  const Dd product = two_product(quotient, b.hi);
  return quick_two_sum(quotient, ((a.hi - product.hi - product.lo) + a.lo - quotient * b.lo) / b.hi);
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

// Exact as long as no product falls below 1e-290.
class Expansion {
 public:
  Expansion(double value = 0) { add(value); }  // NOLINT(*-explicit-*): a double is an Expansion
  explicit Expansion(Dd value) {
    add(value.lo);
    add(value.hi);
  }

  friend Expansion operator+(Expansion a, const Expansion& b) {
    for (const double term : b.terms_) a.add(term);
    return a;
  }
  friend Expansion operator-(Expansion a, const Expansion& b) {
    for (const double term : b.terms_) a.add(-term);
    return a;
  }
  friend Expansion operator*(const Expansion& a, const Expansion& b) {
    Expansion product;
    for (const double x : a.terms_) {
      for (const double y : b.terms_) {
        const Dd exact = two_product(x, y);
        product.add(exact.lo);
        product.add(exact.hi);
      }
    }
    return product;
  }

  [[nodiscard]] Dd rounded() const {
    Dd sum;
    for (const double term : terms_) sum = sum + term;
    return sum;
  }

 private:
  void add(double term) {
    std::size_t kept = 0;
    for (const double part : terms_) {
      const Dd sum = two_sum(part, term);
      if (sum.lo != 0) terms_[kept++] = sum.lo;
      term = sum.hi;
    }
    terms_.resize(kept);
    if (term != 0) terms_.push_back(term);
  }

  std::vector<double> terms_;  // none zero, from the smallest to the largest, no two overlapping
};

}  // namespace bookspin
