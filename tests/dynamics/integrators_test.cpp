// The integrators beyond the paper's: order, conserved quantities, agreement.
//
// Rigid: against the exact motion; springs: against data/reference/ref_springs.txt (undamped, 60 samples to T =
// 200, 24 positions then 24 velocities, good to 2e-12). A measured value holds for both compilers unless it says
// otherwise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "dynamics/integrators.h"
#include "dynamics/random_starts.h"
#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using Eigen::Vector3d;

struct RigidErrors {
  double angle = 0.0, L_W = 0.0,
         energy = 0.0;  // the largest of 60 samples; of L_W and the energy relative to the start
};

RigidErrors errors_of(const BookOptions& o, double T, int steps) {
  const TorqueFree exact = exact_motion(o);
  FreeBook book(o);
  const Vector3d L_W = book.angular_momentum_W();
  const double energy = book.kinetic_energy();
  RigidErrors worst;
  for (int sample = 1; sample <= 60; ++sample) {
    for (int n = 0; n < steps / 60; ++n) book.step(T / steps);
    worst.angle = std::max(worst.angle, geodesic_angle(book.q_WB(), exact.at(T * sample / 60).q_WB));
    worst.L_W = std::max(worst.L_W, (book.angular_momentum_W() - L_W).norm() / L_W.norm());
    worst.energy = std::max(worst.energy, std::abs(book.kinetic_energy() / energy - 1.0));
  }
  return worst;
}

struct OrderCase {
  Integrator integrator;
  int steps;        // coarse; the fine run takes twice as many
  double accuracy;  // of the order, which the table promises
  double error;     // of the fine run: radians, or lengths over time
};

std::string name_of_case(const testing::TestParamInfo<OrderCase>& info) {
  return std::string(info_of(info.param.integrator).name);
}

// Measured: order 4.046, error 2.7e-7.
constexpr OrderCase rigid_cases[] = {{Integrator::rk4, 480, 0.1, 1e-6}};

// Measured: orders 0.998, 0.992, 2.004, 3.979, 6.01, 9.69; errors 2.7e-3, 2.8e-4, 3.9e-4, 6.5e-8, 1.5e-9, 2.0e-11.
constexpr OrderCase spring_cases[] = {{Integrator::explicit_euler, 40000, 0.02, 1e-2},
                                      {Integrator::semi_implicit_euler, 8000, 0.02, 6e-4},
                                      {Integrator::velocity_verlet, 500, 0.01, 8e-4},
                                      {Integrator::rk4, 500, 0.05, 2e-7},
                                      {Integrator::rkn6, 40, 0.05, 5e-9},
                                      {Integrator::stoermer10, 160, 0.6, 1e-10}};

// Explicit Euler of the matrix and of the quaternion: convergence_test.cpp. Of all orders: below.
TEST(Integrators, EveryStepOfTheTableHasItsOrderTested) {
  const auto is_in = [](const auto& cases, const IntegratorInfo& row) {
    return std::any_of(std::begin(cases), std::end(cases),
                       [&row](const OrderCase& c) { return c.integrator == row.id; });
  };
  for (const IntegratorInfo& row : integrators) {
    EXPECT_EQ(is_in(rigid_cases, row), row.rigid_steps != nullptr && row.order != all_orders) << row.name;
    EXPECT_EQ(is_in(spring_cases, row), row.spring_steps != nullptr) << row.name;
    EXPECT_EQ(row.quaternion, row.rigid_steps != nullptr || row.id == Integrator::explicit_euler) << row.name;
    EXPECT_TRUE(row.spring_steps != nullptr || !row.damped) << row.name;
  }
}

TEST(Integrators, ABookWithoutSuchAStepIsNotMade) {
  BookOptions o;
  o.integrator = Integrator::dmv;
  EXPECT_THROW(SpringBook{o}, std::invalid_argument);
  o.integrator = Integrator::velocity_verlet;
  EXPECT_THROW(FreeBook{o}, std::invalid_argument);
}

class RigidOrder : public testing::TestWithParam<OrderCase> {};

TEST_P(RigidOrder, IsAsPromised) {
  const OrderCase& c = GetParam();
  const BookOptions o = tumbling(c.integrator);
  const double coarse = errors_of(o, 60.0, c.steps).angle;
  const double fine = errors_of(o, 60.0, 2 * c.steps).angle;
  EXPECT_NEAR(std::log2(coarse / fine), info_of(c.integrator).order, tolerance(c.accuracy));
  EXPECT_LE(fine, tolerance(c.error));
}

INSTANTIATE_TEST_SUITE_P(Methods, RigidOrder, testing::ValuesIn(rigid_cases), name_of_case);

TEST(RigidInvariants, AngularMomentumAndEnergy) {
  struct Kept {
    Integrator integrator;
    double L_W, energy;
  };
  for (const Kept& kept : {Kept{Integrator::dmv, 3e-13, 3e-14},   // measured: 1.2e-14, 1.3e-14
                           Kept{Integrator::rk4, 3e-7, 2e-7}}) {  // measured: 1.5e-7, 7.7e-8
    const RigidErrors e = errors_of(tumbling(kept.integrator), 600.0, 6000);
    EXPECT_LE(e.L_W, tolerance(kept.L_W)) << static_cast<int>(kept.integrator);
    EXPECT_LE(e.energy, tolerance(kept.energy)) << static_cast<int>(kept.integrator);
  }
}

// dmv's energy swings by rounding alone; RK4's drifts.
TEST(RigidInvariants, EnergyOfRk4Drifts) {
  const double rk4_once = errors_of(tumbling(Integrator::rk4), 60.0, 300).energy;
  const double rk4_long_after = errors_of(tumbling(Integrator::rk4), 600.0, 3000).energy;
  EXPECT_GE(rk4_long_after / rk4_once, 1.0 / tolerance(0.2));  // measured: 9.9
}

// A kick of 1e-15 keeps its digits: the flip comes when it should.
TEST(FreeBookState, RemembersAKickBelowRounding) {
  for (const Integrator i : {Integrator::rk4, Integrator::dmv}) {
    BookOptions o;
    o.integrator = i;
    o.omega_W = {1.0, 1e-15, 0.0};
    const TorqueFree exact = exact_motion(o);
    const double middle = exact.first_flip() > 1.0 ? exact.first_flip() : exact.flip_period();
    FreeBook book(o);
    const int steps = static_cast<int>(middle / 0.1);
    for (int n = 0; n < steps; ++n) book.step(middle / steps);
    EXPECT_LE(geodesic_angle(book.q_WB(), exact.at(middle).q_WB),
              tolerance(2e-5));  // measured: 4.8e-6 (rk4), 5.7e-14
    EXPECT_GT(middle, 50.0);
  }
}

const std::vector<std::vector<double>>& spring_samples() {
  static const auto samples = [] {
    std::ifstream in(BOOKSPIN_SOURCE_DIR "/data/reference/ref_springs.txt");
    std::vector<std::vector<double>> rows;
    double value = 0.0;
    for (std::size_t n = 0; in >> value; ++n) {
      if (n % 48 == 0) rows.emplace_back();
      rows.back().push_back(value);
    }
    return rows;
  }();
  return samples;
}

BookOptions reference_springs(Integrator integrator) {
  BookOptions o;
  const Vector3d I = body_of(o).I_B;
  o.omega_W = Vector3d(1.0, 1e-3 * I.x() / I.y(), 5e-4 * I.x() / I.z());
  o.integrator = integrator;
  o.normalize_every = 0;
  o.damping = 0.0;
  return o;
}

struct SpringErrors {
  double x = 0.0, v = 0.0;
};

// Over the first `samples` of 10 / 3 each.
SpringErrors spring_errors(Integrator integrator, std::size_t samples, int steps_per_sample) {
  SpringBook book(reference_springs(integrator));
  SpringErrors worst;
  for (std::size_t k = 0; k < samples; ++k) {
    for (int n = 0; n < steps_per_sample; ++n) book.step(10.0 / 3.0 / steps_per_sample);
    const Eigen::Map<const Corners> x(spring_samples().at(k).data());
    const Eigen::Map<const Corners> v(spring_samples().at(k).data() + 24);
    worst.x = std::max(worst.x, (book.corners_W() - x).cwiseAbs().maxCoeff());
    worst.v = std::max(worst.v, (book.velocities_W() - v).cwiseAbs().maxCoeff());
  }
  return worst;
}

class SpringOrder : public testing::TestWithParam<OrderCase> {};

// Semi-implicit Euler from springs at rest is Verlet with its velocities half a step off: only they are of order 1.
TEST_P(SpringOrder, IsAsPromised) {
  const OrderCase& c = GetParam();
  ASSERT_EQ(spring_samples().size(), 60U);
  const SpringErrors coarse = spring_errors(c.integrator, 3, c.steps);
  const SpringErrors fine = spring_errors(c.integrator, 3, 2 * c.steps);
  EXPECT_NEAR(std::log2(coarse.v / fine.v), info_of(c.integrator).order, tolerance(c.accuracy));
  EXPECT_LE(fine.v, tolerance(c.error));
}

INSTANTIATE_TEST_SUITE_P(Methods, SpringOrder, testing::ValuesIn(spring_cases), name_of_case);

// The mirror image of each corner is another, to the last bit, and forces know it.
TEST(Springs, BeginAsTheirOwnMirrorImage) {
  for (std::uint64_t start = 1; start <= 40; ++start) {
    BookOptions o = random_options(start);
    if (start % 2 == 0) o.damping = 0.0;
    const SpringBook book(o);
    Corners x = book.corners_W();
    Corners v = book.velocities_W();
    EXPECT_EQ(x.leftCols<4>(), -x.rightCols<4>().rowwise().reverse());
    EXPECT_EQ(v.leftCols<4>(), -v.rightCols<4>().rowwise().reverse());
    Dice dice(5000 + start);
    SpringBook::Half half_x{}, half_v{};
    for (int d = 0; d < 3; ++d) {
      for (int i = 0; i < 4; ++i) {
        const auto at = static_cast<std::size_t>(4 * d + i);
        half_x[at] = x(d, i) += 0.1 * dice.vector(1.0).x();
        half_v[at] = v(d, i) += 0.1 * dice.vector(1.0).x();
        x(d, 7 - i) = -x(d, i);
        v(d, 7 - i) = -v(d, i);
      }
    }
    const Corners expected = book.forces(x, v).F_W / o.particle_mass;
    const SpringBook::Half found = book.accelerations(half_x, half_v);
    for (int d = 0; d < 3; ++d) {
      for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(found[static_cast<std::size_t>(4 * d + i)] / expected.cwiseAbs().maxCoeff(),
                    expected(d, i) / expected.cwiseAbs().maxCoeff(), tolerance(4e-14));  // measured: 4.1e-15
      }
    }
  }
}

TEST(Springs, HighOrdersFollowTheReferenceToItsEnd) {
  const SpringErrors rkn6 = spring_errors(Integrator::rkn6, 60, 256);
  EXPECT_LE(rkn6.x, tolerance(1e-7));  // measured: 1.8e-8
  EXPECT_LE(rkn6.v, tolerance(1e-7));  // measured: 1.6e-8
  const SpringErrors stoermer10 = spring_errors(Integrator::stoermer10, 60, 512);
  EXPECT_LE(stoermer10.x, tolerance(1e-8));  // measured: 1.0e-9
  EXPECT_LE(stoermer10.v, tolerance(1e-8));  // measured: 9.2e-10
}

// Whatever the number of steps a call; a step of another size, or after a normalization, starts the multistep anew.
TEST(Springs, StepsAreTheSameOneByOne) {
  for (const IntegratorInfo& row : integrators) {
    if (row.spring_steps == nullptr) continue;
    for (const int normalize_every : {0, 7}) {
      BookOptions o = reference_springs(row.id);
      o.normalize_every = normalize_every;
      SpringBook together(o);
      SpringBook one_by_one(o);
      for (const double h : {0.01, 0.02}) {
        together.step(h, 100);
        for (int n = 0; n < 100; ++n) one_by_one.step(h);
      }
      EXPECT_EQ(together.corners_W(), one_by_one.corners_W()) << row.name;
      EXPECT_EQ(together.velocities_W(), one_by_one.velocities_W()) << row.name;
    }
  }
}

TEST(Springs, KeepEnergyAndAngularMomentum) {
  struct Kept {
    Integrator integrator;
    double h, energy, L_W;
  };
  for (const Kept& kept : {Kept{Integrator::velocity_verlet, 0.02, 3e-4, 3e-13},  // measured: 9.4e-5, 1.2e-14
                           Kept{Integrator::rkn6, 0.1, 1e-8, 3e-13},              // measured: 2.6e-9, 6.8e-15
                           Kept{Integrator::stoermer10, 0.02, 3e-7, 1e-8}}) {     // measured: 9.4e-8, 2.7e-9
    SpringBook book(reference_springs(kept.integrator));
    const double energy = book.kinetic_energy();
    const Vector3d L_W = book.angular_momentum_W();
    double worst = 0.0;
    for (int n = 0; n < static_cast<int>(600.0 / kept.h); n += 10) {
      book.step(kept.h, 10);
      worst = std::max(worst, std::abs((book.kinetic_energy() + book.elastic_energy()) / energy - 1.0));
    }
    EXPECT_LE(worst, tolerance(kept.energy)) << info_of(kept.integrator).name;
    EXPECT_LE((book.angular_momentum_W() - L_W).norm() / L_W.norm(), tolerance(kept.L_W))
        << info_of(kept.integrator).name;
  }
}

// With damping, the methods that may have it agree in the limit: the damped book comes to a rigid spin.
TEST(Springs, DampedMethodsAgreeInTheLimit) {
  const auto end_of = [](Integrator integrator, double h) {
    BookOptions o = reference_springs(integrator);
    o.damping = 1.0;
    SpringBook book(o);
    for (int n = 0; n < static_cast<int>(std::lround(5.0 / h)); ++n) book.step(h);
    return Corners(book.corners_W());
  };
  const Corners limit = end_of(Integrator::rk4, 1e-3);
  EXPECT_LE((end_of(Integrator::rk4, 2e-3) - limit).cwiseAbs().maxCoeff(), tolerance(1e-9));  // measured: 1.7e-10
  EXPECT_LE((end_of(Integrator::semi_implicit_euler, 1e-4) - limit).cwiseAbs().maxCoeff(),
            tolerance(1e-3));  // measured: 3.7e-4
  EXPECT_LE((end_of(Integrator::explicit_euler, 1e-4) - limit).cwiseAbs().maxCoeff(),
            tolerance(4e-3));  // measured: 1.3e-3
}

// Whatever the number of steps a call, normalized or not.
TEST(Rigid, StepsAreTheSameOneByOne) {
  for (const Integrator integrator : {Integrator::rk4, Integrator::dmv}) {
    for (const int normalize_every : {0, 1, 7}) {
      BookOptions o = tumbling(integrator);
      o.normalize_every = normalize_every;
      FreeBook together(o);
      FreeBook one_by_one(o);
      together.step(0.1, 100);
      for (int n = 0; n < 100; ++n) one_by_one.step(0.1);
      EXPECT_EQ(together.q_WB().coeffs(), one_by_one.q_WB().coeffs()) << info_of(integrator).name;
      EXPECT_EQ(together.L_B(), one_by_one.L_B()) << info_of(integrator).name;
      EXPECT_NEAR(together.q_WB().norm(), 1.0,
                  tolerance(normalize_every == 1 ? 4e-16 : 1e-7));  // measured: 1.1e-16 or 2.2e-16, 7.6e-9
    }
  }
}

// The paper's explicit Euler and the new methods have one limit.
TEST(Rigid, AllMethodsAgreeInTheLimit) {
  const auto orientation = [](Integrator integrator, double h) {
    FreeBook book(tumbling(integrator));
    for (int n = 0; n < static_cast<int>(std::lround(5.0 / h)); ++n) book.step(h);
    return book.q_WB();
  };
  const Eigen::Quaterniond dmv = orientation(Integrator::dmv, 0.1);
  EXPECT_LE(geodesic_angle(dmv, orientation(Integrator::rk4, 0.002)), tolerance(5e-13));  // measured: 2.1e-14
  QuaternionBook euler(tumbling(Integrator::explicit_euler));
  for (int n = 0; n < 50000; ++n) euler.step(1e-4);
  EXPECT_LE(geodesic_angle(dmv, euler.q_WB()), tolerance(3e-4));  // measured: 9.6e-5
}

}  // namespace
}  // namespace bookspin
