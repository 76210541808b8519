// The exact torque-free solution against the committed references, and what it promises besides.
#include "dynamics/torque_free.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "dynamics/torque_free_taylor.h"
#include "tolerance.h"

namespace bookspin {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

const Vector3d book(8.70937225, 3.776884, 11.98625625);

struct Case {
  std::string letter;
  Vector3d I_B, L_W;
};

std::vector<double> hexadecimal(std::istringstream& words, int count) {
  std::vector<double> numbers;
  std::string word;
  while (count-- > 0 && words >> word) numbers.push_back(std::strtod(word.c_str(), nullptr));
  return numbers;
}

std::vector<Case> cases() {
  std::ifstream file(BOOKSPIN_SOURCE_DIR "/data/reference/cases.txt");
  std::vector<Case> result;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string letter;
    std::string name;
    words >> letter >> name;
    const std::vector<double> v = hexadecimal(words, 6);
    result.push_back({letter, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}});
  }
  return result;
}

double energy(const Vector3d& I_B, const Vector3d& L_B) {
  return 0.5 * L_B.dot(L_B.cwiseQuotient(I_B));
}

// However many, and in whatever lanes: the same bits. Tumbling by both forms, on the separatrix, steady.
TEST(TorqueFree, ManyTimesAtOnceGiveTheBitsOfOneByOne) {
  std::vector<TorqueFree> motions{{book, Quaterniond::Identity(), {0, 2, 0}},
                                  {{1, 2, 3}, Quaterniond::Identity(), {0.3, 2, 0.1}},
                                  TorqueFree::of_book({4, 2, 1}, {0.5, 0, 0.5})};
  for (const Case& one : cases()) motions.emplace_back(one.I_B, Quaterniond::Identity(), one.L_W);
  std::vector<double> t;
  for (int i = -30; i < 71; ++i) t.push_back(i < 60 ? 7.7 * i : std::ldexp(1.1, i));
  for (const TorqueFree& motion : motions) {
    for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{8}, std::size_t{21}, t.size()}) {
      std::vector<RigidState> states(count + 1, {Quaterniond(7, 7, 7, 7), {7, 7, 7}});
      motion.at(count, t.data(), states.data());
      for (std::size_t i = 0; i < count; ++i) {
        const RigidState alone = motion.at(t[i]);
        EXPECT_EQ(states[i].q_WB.coeffs(), alone.q_WB.coeffs()) << t[i];
        EXPECT_EQ(states[i].L_B, alone.L_B) << t[i];
      }
      EXPECT_EQ(states[count].L_B.x(), 7.0);  // and nothing beyond
    }
  }
}

TEST(TorqueFree, MatchesTheReferences) {
  int samples = 0;
  for (const Case& one : cases()) {
    const TorqueFree exact(one.I_B, Quaterniond::Identity(), one.L_W);
    std::ifstream file(BOOKSPIN_SOURCE_DIR "/data/reference/ref_" + one.letter + ".txt");
    double angle = 0;
    double E = 0;
    double L = 0;
    double L_W = 0;
    for (std::string line; std::getline(file, line);) {
      if (line[0] == '#') continue;
      std::istringstream words(line);
      std::string t, w, x, y, z;
      words >> t >> w >> x >> y >> z;
      const RigidState state = exact.at(std::stod(t));
      angle = std::max(angle, geodesic_angle(state.q_WB, {Wide(w), Wide(x), Wide(y), Wide(z)}));
      E = std::max(E, std::abs(energy(one.I_B, state.L_B) / energy(one.I_B, one.L_W) - 1));
      L = std::max(L, std::abs(state.L_B.norm() / one.L_W.norm() - 1));
      L_W = std::max(L_W, (state.q_WB * state.L_B - one.L_W).norm() / one.L_W.norm());
      ++samples;
    }
    std::printf("case %s: angle %.2e, energy %.1e, |L| %.1e, L_W %.1e\n", one.letter.c_str(), angle, E, L, L_W);
    EXPECT_LE(angle, tolerance(1e-15)) << one.letter;  // measured 5.1e-16, 4.8e-16, 5.3e-16, 5.0e-16
    EXPECT_LE(E, tolerance(2e-15)) << one.letter;      // measured at most 7.8e-16 (d)
    EXPECT_LE(L, tolerance(1e-15)) << one.letter;      // measured at most 4.4e-16 (d)
    EXPECT_LE(L_W, tolerance(4e-15)) << one.letter;    // measured at most 1.6e-15: rounding of R L_B in double
  }
  EXPECT_EQ(samples, 240);
}

// One full period (two flips, 4 K / lambda) from Taylor series: L_B comes back, and the body has turned about L by an
// angle. Both in 40 digits; 1e6 turns later the exact orientation is that turn to a power, and a remainder shorter than
// a period.
TEST(TorqueFree, ErrorDoesNotGrowInAMillionTurns) {
  struct Start {
    Vector3d I_B, L_W;
  };
  for (const Start& start : {Start{book, {1, 0.3, 0.2}}, Start{book, {1, 0.01, 0.02}}, Start{book, {0.3, 0.1, 1}}}) {
    const TorqueFree exact(start.I_B, Quaterniond::Identity(), start.L_W);
    TaylorBody reference(start.I_B, Quaterniond::Identity(), start.L_W);
    const std::array<Wide, 3> L_B = reference.L_B();
    reference.advance_to(2 * exact.flip_period());
    for (int newton = 0; newton < 3; ++newton) {
      const auto& L = reference.L_B();
      const Wide rate = L[2] * L[0] * (1 / Wide(start.I_B[0]) - 1 / Wide(start.I_B[2]));  // of L_y
      reference.advance_to(reference.time() - (L[1] - L_B[1]) / rate);
    }
    const Wide period = reference.time();
    EXPECT_LE(static_cast<double>(abs(reference.L_B()[0] - L_B[0])), tolerance(1e-42));       // measured 1.2e-46
    EXPECT_NEAR(static_cast<double>(period / 2) / exact.flip_period(), 1, tolerance(4e-16));  // measured 1.1e-16

    WideQuaternion axis{0, L_B[0], L_B[1], L_B[2]};
    const Wide length = sqrt(axis[1] * axis[1] + axis[2] * axis[2] + axis[3] * axis[3]);
    const WideQuaternion turn = multiply(reference.q_WB(), axis);  // q = cos + sin axis: -q . axis is sin, |L| times
    const Wide half_angle = atan2(Wide(-turn[0] / length), reference.q_WB()[0]);

    double near = 0;
    double far = 0;
    const double turns = 2 * 3.14159265 * start.I_B[0] / start.L_W.norm();  // time of about one turn
    for (const double count : {0.3, 10.7, 1e3 + 0.1, 1e6 + 0.2, -1e6 - 0.4, 1e9 + 0.3}) {
      const double t = count * turns;
      const Wide periods = floor(Wide(t) / period);
      TaylorBody rest(start.I_B, Quaterniond::Identity(), start.L_W);
      rest.advance_to(t - periods * period);
      const Wide angle = periods * half_angle;
      const Wide sine = sin(angle) / length;
      const WideQuaternion expected =
          multiply({cos(angle), sine * axis[1], sine * axis[2], sine * axis[3]}, rest.q_WB());
      const double error = geodesic_angle(exact.at(t).q_WB, expected);
      (std::abs(count) < 1e3 ? near : far) = std::max(std::abs(count) < 1e3 ? near : far, error);
    }
    std::printf("to 10 turns: %.2e, from 1e3 to 1e9 turns: %.2e\n", near, far);
    EXPECT_LE(near, tolerance(1e-15));  // measured 4.5e-16
    EXPECT_LE(far, tolerance(1e-15));   // measured 5.3e-16
  }
}

TEST(TorqueFree, FlipsAreZerosOfTheMiddleComponent) {
  for (const Vector3d& L :
       {Vector3d(1, 1e-3, 5e-4), Vector3d(-1, 1e-3, 5e-4), Vector3d(1, -1e-3, 5e-4), Vector3d(0, 1, 0.2)}) {
    const TorqueFree exact(book, Quaterniond::Identity(), L);
    const double first = exact.first_flip();
    EXPECT_GE(first, 0);
    EXPECT_LE(first, exact.flip_period());
    for (int flip = 0; flip < 3; ++flip) {
      EXPECT_NEAR(exact.at(first + flip * exact.flip_period()).L_B.x(), 0, tolerance(1e-14));  // measured 5.1e-15
    }
  }
  const TorqueFree exact(book, Quaterniond::Identity(), {1, 1e-3, 5e-4});
  EXPECT_NEAR(exact.flip_period(), 217.0035148, tolerance(1e-7));  // ref_a.txt, to 10 digits; measured 2.7e-8
}

TEST(TorqueFree, SmallKicksGrowAtTheTheoreticalRate) {
  const double sigma = intermediate_axis_growth_rate(book, 2);
  EXPECT_NEAR(sigma, 2 / book[0] * std::sqrt((book[0] - book[1]) * (book[2] - book[0]) / (book[1] * book[2])),
              tolerance(1e-16));
  const TorqueFree exact(book, Quaterniond::Identity(), {2, 1e-9, 1e-9});
  const double growth = std::log(exact.at(100).L_B.y() / exact.at(50).L_B.y()) / 50;
  EXPECT_NEAR(growth / sigma, 1, tolerance(1e-6));  // measured 8.3e-8
}

TEST(TorqueFree, ReturnsTheStartAndRunsBackwards) {
  const Quaterniond q0(0.5, -0.3, 0.7, 0.2);
  const Vector3d L_W(0.4, -1, 0.3);
  const TorqueFree exact(book, q0, L_W);
  EXPECT_LE(exact.at(0).q_WB.angularDistance(q0.normalized()), tolerance(1e-15));             // measured 2.8e-16
  EXPECT_LE((exact.at(0).L_B - q0.normalized().conjugate() * L_W).norm(), tolerance(1e-15));  // measured 6e-17
  const RigidState late = exact.at(123.5);
  const TorqueFree back(book, late.q_WB, L_W);
  EXPECT_LE(back.at(-123.5).q_WB.angularDistance(q0.normalized()),
            tolerance(4e-15));  // measured 5.4e-16
}

TEST(TorqueFree, StaysFiniteWhereTimeNoLongerResolvesATurn) {
  for (const Vector3d& I : {book, Vector3d(2, 3, 6), Vector3d(2, 2, 2), Vector3d(1e-50, 1, 1e50)}) {
    for (const Vector3d& L :
         {Vector3d(1, 0.5, 1), Vector3d(1, 1e-12, 1e-12), Vector3d(1e-3, 1, 2), Vector3d(0, 0, 1)}) {
      for (const double t : {1e14, 1e17, -1e25, 1e150}) {
        const RigidState state = TorqueFree(I, Quaterniond::Identity(), L).at(t);
        EXPECT_NEAR(state.q_WB.norm(), 1, tolerance(1e-15));
        EXPECT_NEAR(state.L_B.norm() / L.norm(), 1, tolerance(2e-15))
            << I.transpose() << " " << L.transpose() << " " << t;
      }
    }
  }
}

// Every machine gets the same bits: those of 3000 states, of both forms, both steady branches and both constructors.
TEST(TorqueFree, BitsArePinned) {
  std::uint64_t hash = 14695981039346656037u;  // FNV-1a
  const auto add = [&hash](double x) {
    const auto bits = std::bit_cast<std::uint64_t>(x + 0.0);
    for (int byte = 0; byte < 8; ++byte) hash = (hash ^ (bits >> 8 * byte & 0xff)) * 1099511628211u;
  };
  const auto add_motion = [&add](const TorqueFree& motion) {
    for (int sample = -50; sample < 250; ++sample) {
      const RigidState state = motion.at(sample * 0.37 + sample * sample * 1.5);
      for (int i = 0; i < 4; ++i) add(state.q_WB.coeffs()[i]);
      for (int i = 0; i < 3; ++i) add(state.L_B[i]);
    }
    add(motion.flip_period());
    add(motion.first_flip());
  };
  const Quaterniond tilted(0.5, -0.3, 0.7, 0.2);
  for (const Vector3d& L : {Vector3d(1, 1e-3, 5e-4), Vector3d(1, 1e-12, 5e-13), Vector3d(0.2, 1, -0.3),
                            Vector3d(0.1, -0.4, 1), Vector3d(0, 0, -1)}) {
    add_motion(TorqueFree(book, tilted, L));
    add_motion(TorqueFree::of_book({1.878, 2.9085, 0.5}, L));
  }
  EXPECT_EQ(hash, 6169896359174350054u);
}

TEST(TorqueFree, RejectsWhatIsNoBody) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto make = [](const Vector3d& I, const Quaterniond& q, const Vector3d& L) { return TorqueFree(I, q, L); };
  const Vector3d L(1, 2, 3);
  for (const double bad : {0.0, -1.0, nan, infinite}) {
    EXPECT_THROW(make({bad, 1, 1}, Quaterniond::Identity(), L), std::invalid_argument) << bad;
    EXPECT_THROW(make({1, 1, bad}, Quaterniond::Identity(), L), std::invalid_argument) << bad;
  }
  EXPECT_THROW(make(book, Quaterniond(0, 0, 0, 0), L), std::invalid_argument);
  EXPECT_THROW(make(book, Quaterniond(nan, 0, 0, 1), L), std::invalid_argument);
  EXPECT_THROW(make(book, Quaterniond::Identity(), {1, infinite, 0}), std::invalid_argument);
  EXPECT_THROW(make(book, Quaterniond(0, 0, 1, 0), {1.5e308, 1.5e308, 1.5e308}), std::invalid_argument);
  EXPECT_THROW((void)TorqueFree::of_book({1, 0, 0}, L), std::invalid_argument);
  EXPECT_THROW((void)TorqueFree::of_book({1, infinite, 1}, L), std::invalid_argument);
  EXPECT_THROW((void)TorqueFree::of_book({1, 2, 3}, {1, nan, 0}), std::invalid_argument);
  EXPECT_THROW(make(1e-300 * book, Quaterniond::Identity(), 1e300 * L), std::invalid_argument);
}

}  // namespace
}  // namespace bookspin
