// Symmetric compositions: a symmetric step of order 2, taken with the fractions below one after the other, has a higher
// order.
//
// The fractions are palindromic and add up to 1; some are negative, so a step must also be able to run backwards.
// Source: Hairer, Lubich & Wanner, Geometric Numerical Integration, 2nd ed., II.4 (Suzuki, order 4) and V.3.2
// (Kahan & Li, order 8).
#pragma once

#include <array>

namespace bookspin {

inline constexpr std::array<double, 5> suzuki_order_4{0.41449077179437573714, 0.41449077179437573714,
                                                      -0.65796308717750294857, 0.41449077179437573714,
                                                      0.41449077179437573714};

inline constexpr std::array<double, 17> kahan_li_order_8{
    0.13020248308889008087881763,  0.56116298177510838456196441,  -0.38947496264484728640807860,
    0.15884190655515560089621075,  -0.39590389413323757733623154, 0.18453964097831570709183254,
    0.25837438768632204729397911,  0.29501172360931029887096624,  -0.60550853383003451169892108,
    0.29501172360931029887096624,  0.25837438768632204729397911,  0.18453964097831570709183254,
    -0.39590389413323757733623154, 0.15884190655515560089621075,  -0.38947496264484728640807860,
    0.56116298177510838456196441,  0.13020248308889008087881763};

}  // namespace bookspin
