// The table of integrators: everything that is to be known of one stands in its row. A new one is a function and a row.
//
//   matrix, quaternion  whether the method takes it; the springs take each that has a step of theirs
//   damped              whether springs with damping take it, too
//   rigid_step          its step of (q_WB, L_B), or null: explicit Euler has books of its own (rigid_book.h)
//   spring_step         its step of the eight particles, or null
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
  RigidStep rigid_step;
  SpringBook::Step spring_step;
};

inline constexpr auto integrators = [] {
  using enum Integrator;
  using S = SpringBook;
  constexpr bool yes = true;
  constexpr bool no = false;
  // clang-format off
  return std::array<IntegratorInfo, 10>{{
    //                                     order matrix quat. damped
    {explicit_euler,      "explicit_euler",      1, yes, yes, yes, nullptr,         &S::explicit_euler_step},
    {semi_implicit_euler, "semi_implicit_euler", 1, no,  no,  yes, nullptr,         &S::semi_implicit_euler_step},
    {velocity_verlet,     "velocity_verlet",     2, no,  no,  no,  nullptr,         &S::verlet_step},
    {rk4,                 "rk4",                 4, no,  yes, yes, rk4_step,        &S::rk4_step},
    {composition8,        "composition8",        8, no,  no,  no,  nullptr,         &S::composition8_step},
    {splitting2,          "splitting2",          2, no,  yes, no,  splitting2_step, nullptr},
    {splitting4,          "splitting4",          4, no,  yes, no,  splitting4_step, nullptr},
    {dmv2,                "dmv2",                2, no,  yes, no,  dmv_step,        nullptr},
    {dmv6,                "dmv6",                6, no,  yes, no,  dmv_step,        nullptr},
    {dmv10,               "dmv10",              10, no,  yes, no,  dmv_step,        nullptr},
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
