// The exact torque-free solution at every elementary limit and branch, against Taylor series in 50 digits.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "dynamics/torque_free.h"
#include "dynamics/torque_free_taylor.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d book(8.70937225, 3.776884, 11.98625625);
const Quaterniond tilted(0.5, -0.3, 0.7, 0.2);  // not normalized

struct Errors {
  double angle = 0;   // geodesic, radians
  double L_B = 0;     // over |L|
  double energy = 0;  // relative
  double L = 0;       // |L|, relative
  double norm = 0;    // | |q| - 1 |

  void widen(const Errors& other) {
    angle = std::max(angle, other.angle);
    L_B = std::max(L_B, other.L_B);
    energy = std::max(energy, other.energy);
    L = std::max(L, other.L);
    norm = std::max(norm, other.norm);
  }
};

// Largest errors over equally spaced times up to T (which may be negative).
Errors errors(const TorqueFree& exact, TaylorBody reference, double T, int samples) {
  Wide start = 0;
  Wide energy = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    start += reference.L_B()[i] * reference.L_B()[i];
    energy += reference.L_B()[i] * reference.L_B()[i] * reference.inverse_I()[i];
  }
  const Wide L = sqrt(start);
  Errors worst;
  for (int sample = 0; sample <= samples; ++sample) {
    const double t = T * sample / samples;
    const RigidState state = exact.at(t);
    reference.advance_to(t);
    Errors now;
    now.angle = geodesic_angle(state.q_WB, reference.q_WB());
    Wide square = 0;
    Wide twice_energy = 0;
    Wide difference = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const Wide l = state.L_B[static_cast<int>(i)];
      difference += (l - reference.L_B()[i]) * (l - reference.L_B()[i]);
      square += l * l;
      twice_energy += l * l * reference.inverse_I()[i];
    }
    now.L_B = static_cast<double>(sqrt(difference) / L);
    now.L = static_cast<double>(abs(sqrt(square) / L - 1));
    now.energy = static_cast<double>(abs(twice_energy / energy - 1));
    now.norm = std::abs(state.q_WB.norm() - 1);
    worst.widen(now);
  }
  return worst;
}

Errors errors(const Vector3d& I_B, const Quaterniond& q_WB0, const Vector3d& L_W, double T, int samples = 12) {
  return errors(TorqueFree(I_B, q_WB0, L_W), TaylorBody(I_B, q_WB0, L_W), T, samples);
}

Errors book_errors(const Vector3d& size, const Vector3d& omega, double T, int samples = 12) {
  return errors(TorqueFree::of_book(size, omega), TaylorBody::of_book(size, omega), T, samples);
}

// Measured over all tests here: angle 7.7e-16, L_B 4.7e-16, |L| 4.7e-16, energy 9.4e-16, |q| 4.4e-16.
void expect_exact(const char* name, const Errors& worst) {
  std::printf("%-28s angle %.1e  L_B %.1e  |L| %.1e  energy %.1e  |q| %.1e\n", name, worst.angle, worst.L_B, worst.L,
              worst.energy, worst.norm);
  EXPECT_LE(worst.angle, tolerance(1.5e-15)) << name;
  EXPECT_LE(worst.L_B, tolerance(1e-15)) << name;
  EXPECT_LE(worst.L, tolerance(1e-15)) << name;
  EXPECT_LE(worst.energy, tolerance(2e-15)) << name;
  EXPECT_LE(worst.norm, tolerance(1e-15)) << name;
}

TEST(TorqueFreeLimits, SeparatrixFromBothSides) {
  Errors worst;
  for (const double kick : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const double T = 3 * std::log(10 / kick) / intermediate_axis_growth_rate(book, 1);
    for (const Vector3d& L : {Vector3d(1, kick, 0), Vector3d(1, 0, kick), Vector3d(-1, kick, -kick / 2)}) {
      worst.widen(errors(book, Quaterniond::Identity(), L, T));
    }
  }
  expect_exact("kicks 1e-3 to 1e-15", worst);
}

TEST(TorqueFreeLimits, KickBelowTheSquareRootOfTheSmallestDouble) {
  // One flip, near t = 5710. After it the reference's own 1e-45 grows by e^(sigma t): at t = 7000 it is wrong by 2e-13.
  const Vector3d L(1, 1e-170, 5e-171);
  expect_exact("kick 1e-170", errors(book, Quaterniond::Identity(), L, 6000, 40));
  EXPECT_NEAR(TorqueFree(book, Quaterniond::Identity(), L).first_flip(), 5709.95812444136317,
              tolerance(2e-12));  // u0 / lambda in 60 digits; measured 0
}

// Squares of the kick are zero.
TEST(TorqueFreeLimits, KicksOfTheStableAxes) {
  Errors worst;
  const Vector3d size(1.878, 2.9085, 0.5);
  for (const double kick : {1e-100, 1e-150, 1e-162, 1e-170, 1e-200, 1e-280, 1e-300, 5e-324}) {
    for (const Vector3d& omega : {Vector3d(0, 1, kick), Vector3d(kick, 1, 0), Vector3d(kick, -kick, 1),
                                  Vector3d(0, kick, 1), Vector3d(kick, 0, -1)}) {
      worst.widen(book_errors(size, omega, 100, 3));
      worst.widen(errors(book, tilted, tilted.normalized() * omega, 100, 3));
    }
  }
  expect_exact("kicks 1e-100 to 5e-324", worst);
}

// Whatever a script may say: never a NaN, and never a refusal.
TEST(TorqueFreeLimits, AnyBookAndAnySpinIsFinite) {
  std::mt19937_64 random(11);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  };
  for (int trial = 0; trial < 20000; ++trial) {
    Vector3d size;
    Vector3d omega;
    for (int i = 0; i < 3; ++i) {
      size[i] = std::pow(10, uniform(-6, 6));
      omega[i] = trial % (i + 4) == 0 ? 0 : std::pow(10, trial % (i + 2) == 0 ? uniform(-323, 6) : uniform(-2, 2));
    }
    if (trial % 5 == 0) size[trial % 3] = size[(trial + 1) % 3];
    const TorqueFree motion = TorqueFree::of_book(size, omega);
    for (const double angle : {0.0, -3.7, 1e5, 1e14}) {
      const RigidState state = motion.at(angle / std::max(omega.stableNorm(), 1e-250));
      ASSERT_NEAR(state.q_WB.norm(), 1, tolerance(2e-15)) << size.transpose() << ", " << omega.transpose();
      ASSERT_TRUE(state.L_B.allFinite()) << size.transpose() << ", " << omega.transpose();  // measured 6.7e-16
    }
    ASSERT_FALSE(std::isnan(motion.flip_period()) || std::isnan(motion.first_flip()));
  }
}

TEST(TorqueFreeLimits, ExactlyOnTheSeparatrix) {
  const Vector3d I(2, 3, 6);  // 1 / I is equally spaced: the separatrix is |L_x| = |L_z|
  Errors worst;
  for (const double x : {1.0, -1.0}) {
    for (const double z : {1.0, -1.0}) {
      for (const double T : {30.0, -30.0}) worst.widen(errors(I, Quaterniond::Identity(), {x, 0.5, z}, T));
      const TorqueFree exact(I, Quaterniond::Identity(), {x, 0.5, z});
      EXPECT_TRUE(std::isinf(exact.flip_period()));
      const RigidState far = exact.at(1e6);
      EXPECT_NEAR(std::abs(far.L_B.y()), 1.5, tolerance(1e-15));  // measured 0
    }
  }
  expect_exact("on the separatrix", worst);
}

// k'^2 by its definition, and from it the flip period 2 K / lambda; moments a circled, b middle, c other.
double flip_period(const std::array<Wide, 3>& I, const std::array<Wide, 3>& L) {
  const auto& [I_a, I_b, I_c] = I;
  const Wide G_a = abs(I_b - I_a) * I_c;
  const Wide G_c = abs(I_c - I_b) * I_a;
  const Wide A_a2 = L[0] * L[0] + G_c / (abs(I_c - I_a) * I_b) * L[1] * L[1];
  Wide mean = 1;
  Wide other = sqrt((G_a * L[0] * L[0] - G_c * L[2] * L[2]) / (G_a * A_a2));
  while (mean - other > 1e-45) {
    const Wide next = (mean + other) / 2;
    other = sqrt(mean * other);
    mean = next;
  }
  const Wide lambda = sqrt(A_a2 * abs(I_b - I_a) * abs(I_c - I_a) / (I_a * I_a * I_b * I_c));
  return static_cast<double>(acos(Wide(-1)) / mean / lambda);
}

// k'^2 of 2^-99.6 and 2^-77: 31 digits do not tell on which side of the separatrix the motion is, or how far off.
TEST(TorqueFreeLimits, AllButOnTheSeparatrix) {
  struct Start {
    Vector3d omega;
    double period;
  };
  for (const Start& start : {Start{{0.5535585319904754, 0, 0.691394384855375}, 187.20311964973126},
                             Start{{0.9076765854260884, 0, 1.133687691835803}, 89.287440960757086}}) {
    const Vector3d I(26, 20, 10);  // exactly, of the book of edges 1, 2, 3
    const Vector3d L = I.cwiseProduct(start.omega);
    Errors worst = errors(I, Quaterniond::Identity(), L, 400, 40);
    worst.widen(book_errors({1, 2, 3}, start.omega, 400, 40));
    expect_exact("all but on the separatrix", worst);
    EXPECT_NEAR(flip_period({10, 20, 26}, {L[2], L[1], L[0]}), start.period, tolerance(1e-13));
    for (const TorqueFree& exact :
         {TorqueFree(I, Quaterniond::Identity(), L), TorqueFree::of_book({1, 2, 3}, start.omega)}) {
      EXPECT_NEAR(exact.flip_period(), start.period, tolerance(1e-13));  // measured 0
    }
  }
}

// Moments in doubles would lose 1e-12 of a rod's I_y - I_z, and the phase with it.
TEST(TorqueFreeLimits, MomentsOfABookAreNotRounded) {
  const Vector3d rod(1, 2e-6, 1e-6);
  expect_exact("rod", book_errors(rod, {0.5, 1, 1}, 200, 3));
}

TEST(TorqueFreeLimits, PrincipalAxes) {
  Errors worst;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double L : {1.0, -2.5}) {
      worst.widen(errors(book, Quaterniond::Identity(), L * Vector3d::Unit(axis), 100));
      worst.widen(errors(book, Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 2, Vector3d::UnitZ())),
                         L * Vector3d::Unit(axis), 100));
    }
  }
  expect_exact("principal axes", worst);
}

TEST(TorqueFreeLimits, EqualMoments) {
  Errors worst;
  for (const Vector3d& I : {Vector3d(2, 2, 3), Vector3d(3, 2, 2), Vector3d(2, 3, 2), Vector3d(3, 3, 2),
                            Vector3d(2, 3, 3), Vector3d(3, 2, 3), Vector3d(2, 2, 2)}) {
    for (const Vector3d& L : {Vector3d(1, 0.5, -0.25), Vector3d(1, 2, 0), Vector3d(0, 2, -1), Vector3d(1, 0, 1),
                              Vector3d(-1, 1e-9, 1e-9)}) {
      worst.widen(errors(I, tilted, L, 60, 4));
    }
  }
  expect_exact("two and three equal moments", worst);
}

TEST(TorqueFreeLimits, NearlyEqualMoments) {
  Errors worst;
  for (const double gap : {1e-8, -1e-8, 1e-13, -1e-13, 4.5e-16, -2.3e-16}) {
    for (const Vector3d& I : {Vector3d(2, 2 + 2 * gap, 3), Vector3d(3, 2, 2 + 2 * gap), Vector3d(2 + 2 * gap, 2, 2),
                              Vector3d(2 + 2 * gap, 2, 2 - 2 * gap)}) {
      worst.widen(errors(I, tilted, {1, 0.5, -0.25}, 60, 4));
      worst.widen(errors(I, Quaterniond::Identity(), {1, 1e-8, 1e-8}, 60, 4));
    }
  }
  expect_exact("nearly equal moments", worst);
}

TEST(TorqueFreeLimits, NoRotation) {
  const TorqueFree exact(book, tilted, Vector3d::Zero());
  for (const double t : {0.0, 1.0, -1e300}) {
    EXPECT_LE(exact.at(t).q_WB.angularDistance(tilted.normalized()), tolerance(1e-15));  // measured 0
    EXPECT_EQ(exact.at(t).L_B, Vector3d::Zero());
  }
  EXPECT_TRUE(std::isinf(exact.flip_period()));
  EXPECT_TRUE(std::isinf(exact.first_flip()));
}

TEST(TorqueFreeLimits, FlatPlateNeedleAndImpossibleBody) {
  Errors worst;
  for (const Vector3d& I : {Vector3d(1, 2, 3), Vector3d(1, 1, 1e-6), Vector3d(1, 1 + 1e-7, 1e-6),
                            Vector3d(1, 1e-6, 2e-6), Vector3d(1, 2, 30), Vector3d(1e-6, 1, 1e6)}) {
    for (const Vector3d& L : {Vector3d(1, 0.5, -0.25), Vector3d(0.02, 1, 0.01), Vector3d(1e-3, 1, 1e-3)}) {
      double omega = 0;
      for (int i = 0; i < 3; ++i) omega = std::max(omega, std::abs(L[i]) / I[i]);
      worst.widen(errors(I, tilted, tilted.normalized() * L, 40 / omega, 4));
    }
  }
  expect_exact("plate, needle, impossible", worst);
}

TEST(TorqueFreeLimits, EverySignAndOrder) {
  Errors worst;
  std::array<int, 3> order{0, 1, 2};
  do {
    const Vector3d I(book[order[0]], book[order[1]], book[order[2]]);
    for (int signs = 0; signs < 8; ++signs) {
      const Vector3d L((signs & 1) != 0 ? -1 : 1, (signs & 2) != 0 ? -0.3 : 0.3, (signs & 4) != 0 ? -0.6 : 0.6);
      worst.widen(errors(I, tilted, L, signs % 3 == 0 ? -60 : 60, 3));
    }
  } while (std::next_permutation(order.begin(), order.end()));
  expect_exact("signs and orders of axes", worst);
}

TEST(TorqueFreeLimits, TinyAndHugeScales) {
  Errors worst;
  for (const double I : {1e-150, 1.0, 1e150}) {
    for (const double L : {1e-150, 1.0, 1e150}) {
      worst.widen(errors(I * book, tilted, L * Vector3d(1, 0.2, 0.1), 100 * (I / L), 4));
      worst.widen(errors(I * book, tilted, L * Vector3d(0, 0, 1), 100 * (I / L), 4));
    }
  }
  expect_exact("scales 1e-150 to 1e150", worst);
}

// Both sides of k' = (sqrt 2 - 1)^2, where the trigonometric form hands over to the hyperbolic one.
TEST(TorqueFreeLimits, BothFormsAtTheirSwitch) {
  const double c = std::sqrt(1 / ((book[2] - book[0]) * book[1] / ((book[0] - book[1]) * book[2])));
  Errors worst;
  for (const double ratio : {0.9, 0.98, 0.985, 0.9852, 0.9855, 0.99, 0.999}) {
    worst.widen(errors(book, tilted, tilted.normalized() * Vector3d(0, 1, c * ratio), 150, 6));
    worst.widen(errors(book, tilted, tilted.normalized() * Vector3d(0.3, ratio, c), 150, 6));
  }
  expect_exact("around the switch of forms", worst);
}

TEST(TorqueFreeLimits, NeighborsAgreeAcrossEveryBranch) {
  // Starts a few last bits apart on both sides of a branch; their motions separate by that times the condition e^(sigma
  // t) <= 30.
  struct Pair {
    const char* name;
    Vector3d I_1, L_1, I_2, L_2;
    double T;
  };
  const double e = std::numeric_limits<double>::epsilon();
  const double switch_ = 0.17157287525380990;         // k'
  const double z = std::sqrt(1 - switch_ * switch_);  // I = (2, 3, 6), L = (1, 0, z): k^2 = z^2
  const std::vector<Pair> pairs{
      {"separatrix, one side", {2, 3, 6}, {1, 0.5, 1}, {2, 3, 6}, {1 + e, 0.5, 1}, 15},
      {"separatrix, other side", {2, 3, 6}, {1, 0.5, 1}, {2, 3, 6}, {1, 0.5, 1 + e}, 15},
      {"switch of forms", {2, 3, 6}, {1, 0, z * (1 - 2 * e)}, {2, 3, 6}, {1, 0, z * (1 + 2 * e)}, 15},
      {"steady, middle axis", {2, 3, 6}, {0, 1, 0}, {2, 3, 6}, {e, 1, -e}, 15},
      {"steady, outer axis", {2, 3, 6}, {1, 0, 0}, {2, 3, 6}, {1, e, -e}, 15},
      {"symmetric", {2, 2, 6}, {1, 0.5, 0.3}, {2, 2 + 2 * e, 6}, {1, 0.5, 0.3}, 15},
      {"middle axis changes", {2 - e, 2, 6}, {1, 0.5, 0.3}, {2 + 2 * e, 2, 6}, {1, 0.5, 0.3}, 15},
      {"symmetric, equator", {2, 2, 6}, {1, 0.5, 0}, {2, 2 + 2 * e, 6}, {1, 0.5, e}, 15},
      {"cube", {2, 2, 2}, {1, 0.5, 0.3}, {2, 2 + 2 * e, 2 - e}, {1, 0.5, 0.3}, 15},
      {"sign on the circled axis", {2, 3, 6}, {1, 0.5, 5e-324}, {2, 3, 6}, {1, 0.5, -5e-324}, 15},
      {"no rotation", {2, 3, 6}, {0, 0, 0}, {2, 3, 6}, {e, e, -e}, 15},
  };
  for (const Pair& pair : pairs) {
    const TorqueFree one(pair.I_1, tilted, tilted.normalized() * pair.L_1);
    const TorqueFree other(pair.I_2, tilted, tilted.normalized() * pair.L_2);
    const TorqueFree one_plain(pair.I_1, Quaterniond::Identity(), pair.L_1);
    const TorqueFree other_plain(pair.I_2, Quaterniond::Identity(), pair.L_2);
    double apart = 0;
    for (double t = -pair.T; t <= pair.T; t += 0.37) {
      const RigidState a = one_plain.at(t);
      const RigidState b = other_plain.at(t);
      apart = std::max({apart, a.q_WB.angularDistance(b.q_WB), (a.L_B - b.L_B).norm(),
                        one.at(t).q_WB.angularDistance(other.at(t).q_WB), (one.at(t).L_B - other.at(t).L_B).norm()});
    }
    std::printf("%-28s apart %.1e\n", pair.name, apart);
    EXPECT_LE(apart, tolerance(4e-14)) << pair.name;  // measured 1.3e-14
  }
}

}  // namespace
}  // namespace bookspin
