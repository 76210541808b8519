// Boost.Odeint's methods, carried from sample to sample: rk4 by fixed steps, the others by step-size control.
//
// State: a std::array of doubles; System: a function object (x, dxdt, t) that does not depend on t. A control that tries
// more than `most_tries` steps from one sample to the next, or throws, has stalled. Source: Boost.Numeric.Odeint's
// documentation, "Steppers".
#pragma once

#include <algorithm>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <exception>

#include "report/measure.h"

namespace bookspin {

template <class State, class System>
struct OdeintRk4 {
  System system;
  State x;
  boost::numeric::odeint::runge_kutta4<State> stepper{};

  void step(double h, long n = 1) {
    for (; n > 0; --n) stepper.do_step(system, x, 0.0, h);
  }
};

template <class Stepper, class State, class System>
struct OdeintControlled {
  static constexpr long most_tries = 50000;
  System system;
  State state;
  Stepper stepper;
  double interval;
  double h;  // wanted next
  double t = 0.0;
  long evaluations = 0;

  bool to(int sample) {
    const double end = (sample + 1) * interval;
    const auto counted = [this](const State& x, State& dxdt, double time) {
      ++evaluations;
      system(x, dxdt, time);
    };
    long tries = 0;
    try {
      while (end - t > 1e-14 * end) {
        double step = std::min(h, end - t);
        const bool cut = step < h;
        const auto result = stepper.try_step(counted, state, t, step);
        h = result == boost::numeric::odeint::success && cut ? std::max(step, h) : step;
        if (++tries > most_tries || !(h > 0.0)) return false;
      }
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }
};

// The ladders of all four methods: rk4 by ever more steps, the others at tolerances 0.1, 0.03, 0.01, ... 1e-16. error:
// of a State. The methods are copied from objects of static storage, whose buffers are zero: a copy of a buffer not yet
// written to would be read.
template <class State, class System, class Error>
void climb_odeint(Method method, const State& x, const System& system, double first_step, const Course& course,
                  const Effort& effort, Ladders& ladders, Error&& error) {
  namespace odeint = boost::numeric::odeint;
  using Rk4 = OdeintRk4<State, System>;
  const auto add = [&](Odeint which, std::vector<Run> runs) {
    ladders.push_back({{method, Integrator::explicit_euler, which}, std::move(runs)});
  };
  add(Odeint::rk4, climb_steps(Rk4{system, x}, 4, course, effort,
                               [&](const Rk4& book, int sample) { return error(book.x, sample); }));
  std::vector<double> tolerances;
  for (double decades = 1.0; decades <= 16.0; decades += 0.5 * effort.ladder)
    tolerances.push_back(std::pow(10.0, -decades));
  const auto controlled = [&](Odeint which, auto&& make) {
    add(which, climb(effort, tolerances, [&](double tolerance) {
          using Runner = OdeintControlled<decltype(make(tolerance)), State, System>;
          const auto start = [&] { return Runner{system, x, make(tolerance), course.interval(), first_step}; };
          return measure(tolerance, course, effort, start, error);
        }));
  };
  controlled(Odeint::dopri5, [](double tolerance) {
    static const odeint::runge_kutta_dopri5<State> dopri5;
    return odeint::make_controlled(tolerance, tolerance, dopri5);
  });
  controlled(Odeint::fehlberg78, [](double tolerance) {
    static const odeint::runge_kutta_fehlberg78<State> fehlberg78;
    return odeint::make_controlled(tolerance, tolerance, fehlberg78);
  });
  controlled(Odeint::bulirsch_stoer,
             [](double tolerance) { return odeint::bulirsch_stoer<State>(tolerance, tolerance); });
}

}  // namespace bookspin
