// Boost.Odeint's methods, carried from sample to sample: rk4 by fixed steps, the others by step-size control.
//
// State: a std::array of doubles; System: a function object (x, dxdt, t). A control that tries more than `most_tries`
// steps from one sample to the next, or throws, has stalled. Source: Boost.Numeric.Odeint's documentation, "Steppers".
#pragma once

#include <algorithm>
#include <boost/numeric/odeint/stepper/bulirsch_stoer.hpp>
#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/generation.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta4.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_fehlberg78.hpp>
#include <exception>
#include <type_traits>

#include "report/measure.h"

namespace bookspin {

template <class System>
struct Counted {
  const System& system;
  long& evaluations;

  template <class State>
  void operator()(const State& x, State& dxdt, double t) const {
    ++evaluations;
    system(x, dxdt, t);
  }
};

template <class State, class System>
class OdeintFixed {
 public:
  OdeintFixed(const State& x, const System& system, double interval, long steps)
      : x_(x), system_(system), h_(interval / static_cast<double>(steps)), steps_(steps) {}
  bool to(int /*sample*/) {
    const Counted<System> counted{system_, evaluations_};
    for (long i = 0; i < steps_; ++i) stepper_.do_step(counted, x_, 0.0, h_);  // the systems here do not depend on t
    return true;
  }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] const State& state() const { return x_; }

 private:
  boost::numeric::odeint::runge_kutta4<State> stepper_;
  State x_;
  System system_;
  double h_;
  long steps_;
  long evaluations_ = 0;
};

template <class Make, class State, class System>
class OdeintControlled {
 public:
  OdeintControlled(const Make& make, const State& x, const System& system, double interval, double first_step)
      : stepper_(make()), x_(x), system_(system), interval_(interval), step_(first_step) {}
  bool to(int sample) {
    const double end = (sample + 1) * interval_;
    const Counted<System> counted{system_, evaluations_};
    long tries = 0;
    try {
      while (end - t_ > 1e-14 * end) {
        const double wanted = step_;
        double step = std::min(wanted, end - t_);
        const bool cut = step < wanted;
        const auto result = stepper_.try_step(counted, x_, t_, step);
        step_ = result == boost::numeric::odeint::success && cut ? std::max(step, wanted) : step;
        if (++tries > most_tries || !(step_ > 0.0)) return false;
      }
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }
  [[nodiscard]] long evaluations() const { return evaluations_; }
  [[nodiscard]] const State& state() const { return x_; }

 private:
  static constexpr long most_tries = 50000;
  std::invoke_result_t<Make> stepper_;
  State x_;
  System system_;
  double interval_;
  double step_;
  double t_ = 0.0;
  long evaluations_ = 0;
};

// The ladders of all four methods: rk4 by `fewest` steps a sample and more, the others at ever tighter tolerances. The
// methods are copied from objects of static storage, whose buffers are zero: a copy of a buffer not yet written to would
// be read.
template <class State, class System, class Error>
void climb_odeint(Problem problem, Method method, const State& x, const System& system, const Course& course,
                  double fewest, double first_step, const Effort& effort, Runs& runs, Error&& error) {
  namespace odeint = boost::numeric::odeint;
  const auto run = [&](Odeint which, double setting, auto&& start) {
    return measure({problem, {method, Integrator::explicit_euler, which}, setting}, course, effort, start, error);
  };
  climb(effort, step_ladder(fewest, effort.ladder), runs, [&](long steps) {
    return run(Odeint::rk4, course.interval() / static_cast<double>(steps),
               [&] { return OdeintFixed<State, System>(x, system, course.interval(), steps); });
  });
  const auto controlled = [&](Odeint which, auto&& make) {
    climb(effort, tolerance_ladder(effort.ladder), runs, [&](double tolerance) {
      const auto stepper = [&] { return make(tolerance); };
      return run(which, tolerance, [&] { return OdeintControlled(stepper, x, system, course.interval(), first_step); });
    });
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
