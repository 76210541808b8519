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
#include <functional>
#include <utility>

namespace bookspin {

template <class State, class System>
class OdeintFixed {
 public:
  OdeintFixed(const State& x, const System& system, double interval, int steps)
      : x_(x), system_(system), h_(interval / steps), steps_(steps) {}
  bool to(int /*sample*/) {
    for (int i = 0; i < steps_; ++i)
      stepper_.do_step(std::cref(system_), x_, 0.0, h_);  // the systems here do not depend on t
    return true;
  }
  [[nodiscard]] const State& x() const { return x_; }

 private:
  boost::numeric::odeint::runge_kutta4<State> stepper_;
  State x_;
  System system_;
  double h_;
  int steps_;
};

template <class Stepper, class State, class System>
class OdeintControlled {
 public:
  OdeintControlled(Stepper stepper, const State& x, const System& system, double interval, double first_step)
      : stepper_(std::move(stepper)), x_(x), system_(system), interval_(interval), step_(first_step) {}
  bool to(int sample) {
    const double end = (sample + 1) * interval_;
    long tries = 0;
    try {
      while (end - t_ > 1e-14 * end) {
        const double wanted = step_;
        double step = std::min(wanted, end - t_);
        const bool cut = step < wanted;
        const auto result = stepper_.try_step(std::cref(system_), x_, t_, step);
        step_ = result == boost::numeric::odeint::success && cut ? std::max(step, wanted) : step;
        if (++tries > most_tries || !(step_ > 0.0)) return false;
      }
    } catch (const std::exception&) {
      return false;
    }
    return true;
  }
  [[nodiscard]] const State& x() const { return x_; }

 private:
  static constexpr long most_tries = 50000;
  Stepper stepper_;
  State x_;
  System system_;
  double interval_;
  double step_;
  double t_ = 0.0;
};

// Calls visit(name, make) for each controlled method: make(tolerance) starts a run.
template <class State, class System, class Visit>
void for_each_controlled(const State& x, const System& system, double interval, double first_step, Visit&& visit) {
  namespace odeint = boost::numeric::odeint;
  visit("odeint dopri5", [&](double tolerance) {
    return OdeintControlled(odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_dopri5<State>()), x,
                            system, interval, first_step);
  });
  visit("odeint fehlberg78", [&](double tolerance) {
    return OdeintControlled(odeint::make_controlled(tolerance, tolerance, odeint::runge_kutta_fehlberg78<State>()), x,
                            system, interval, first_step);
  });
  visit("odeint bulirsch_stoer", [&](double tolerance) {
    return OdeintControlled(odeint::bulirsch_stoer<State>(tolerance, tolerance), x, system, interval, first_step);
  });
}

}  // namespace bookspin
