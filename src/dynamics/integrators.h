// The table of integrators: everything that is to be known of one stands in its row. A new one is a function and a row.
//
//   order               halving the step divides the error by 2^order; all_orders: rounding alone is left
//   matrix, quaternion  whether the method takes it; the springs take each that has a step of theirs
//   damped              whether springs with damping take it, too
//   rigid_steps         its steps of (q_WB, L_B), or null: explicit Euler has books of its own (rigid_book.h)
//   spring_steps        its steps of the eight particles, or null
#pragma once

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

#include "dynamics/book.h"
#include "dynamics/rigid_steps.h"
#include "dynamics/spring_book.h"

namespace bookspin {

struct IntegratorInfo {
  Integrator id;
  std::string_view name;  // in scripts
  int order;
  bool matrix, quaternion, damped;
  RigidSteps rigid_steps;
  SpringBook::Steps spring_steps;
};

inline constexpr int all_orders = 99;

inline constexpr auto integrators = [] {
  using enum Integrator;
  using S = SpringBook;
  constexpr bool yes = true;
  constexpr bool no = false;
  // clang-format off
  return std::array<IntegratorInfo, 7>{{
    //                                             order matrix quat. damped
    {explicit_euler,      "explicit_euler",              1, yes, yes, yes, nullptr,   &S::explicit_euler_steps},
    {semi_implicit_euler, "semi_implicit_euler",         1, no,  no,  yes, nullptr,   &S::semi_implicit_euler_steps},
    {velocity_verlet,     "velocity_verlet",             2, no,  no,  no,  nullptr,   &S::verlet_steps},
    {rk4,                 "rk4",                         4, no,  yes, yes, rk4_steps, &S::rk4_steps},
    {rkn6,                "rkn6",                        6, no,  no,  no,  nullptr,   &S::rkn6_steps},
    {stoermer10,          "stoermer10",                 10, no,  no,  no,  nullptr,   &S::stoermer10_steps},
    {dmv,                 "dmv",                all_orders, no,  yes, no,  dmv_steps, nullptr},
  }};
  // clang-format on
}();

static_assert(
    [] {
      for (std::size_t i = 0; i < integrators.size(); ++i) {
        if (static_cast<std::size_t>(integrators[i].id) != i) return false;
      }
      return true;
    }(),
    "each row stands at its id");

[[nodiscard]] constexpr const IntegratorInfo& info_of(Integrator id) {
  return integrators.at(static_cast<std::size_t>(id));
}

// The step in one column of the integrator's row. Throws std::invalid_argument when there is none.
template <class Step>
[[nodiscard]] Step step_of(Integrator id, Step IntegratorInfo::*column) {
  const Step step = info_of(id).*column;
  if (step == nullptr) throw std::invalid_argument(std::string(info_of(id).name) + ": not an integrator of this book");
  return step;
}

}  // namespace bookspin
