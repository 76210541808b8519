// Scene -> trajectory: explosions, tilt, flips and pulsations.
#include "scene/simulate.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
#include "scene/counters.h"
#include "scene/scene_file.h"
#include "tolerance.h"

namespace bookspin {
namespace {

constexpr double pi = std::numbers::pi;

BookTrack run(const std::string& book, int frames, double time_per_frame, int substeps) {
  const std::string clip = "clip = { frames = " + std::to_string(frames) +
                           ", time_per_frame = " + std::to_string(time_per_frame) +
                           ", substeps = " + std::to_string(substeps) + " }\n";
  return simulate(parse_scene("title = 'T'\n" + clip + "[[book]]\n" + book, "s.toml")).books[0];
}

// Each frame is `substeps` steps of h = time_per_frame / substeps after the one before; the first is the start.
TEST(Simulate, TakesItsSteps) {
  BookOptions o;
  o.omega_W = Eigen::Vector3d(0.2, 0.3, 0.1);
  const std::string omega = "angular_velocity = [0.2, 0.3, 0.1]\n";
  const BookTrack springs = run("method = 'springs'\n" + omega, 20, 0.5, 30);
  const BookTrack matrix = run("method = 'matrix'\n" + omega, 20, 0.5, 30);
  const BookTrack quaternion = run("method = 'quaternion'\n" + omega, 20, 0.5, 30);
  SpringBook spring_book(o);
  MatrixBook matrix_book(o);
  QuaternionBook quaternion_book(o);
  for (std::size_t n = 0; n < 20; ++n) {
    EXPECT_EQ(springs.frames[n].corners_W, spring_book.corners_W());
    EXPECT_EQ(springs.frames[n][Q::elastic_energy], spring_book.elastic_energy());
    EXPECT_EQ(springs.frames[n][Q::floor_hits], spring_book.floor_hits());
    EXPECT_EQ(matrix.frames[n].corners_W, matrix_book.corners_W());
    EXPECT_EQ(quaternion.frames[n].corners_W, quaternion_book.corners_W());
    EXPECT_EQ(quaternion.frames[n][Q::norm], quaternion_book.q_WB().norm());
    EXPECT_TRUE(std::isnan(springs.frames[n][Q::norm]));
    EXPECT_TRUE(std::isnan(matrix.frames[n][Q::blend_defect]));
    for (int i = 0; i < 30; ++i) {
      spring_book.step(0.5 / 30);
      matrix_book.step(0.5 / 30);
      quaternion_book.step(0.5 / 30);
    }
  }
}

// A frame of a million steps takes seconds: whoever stops it does not wait for its end.
TEST(Simulate, StopsWithinAFrame) {
  const Scene scene = parse_scene(
      "title = 'T'\nclip = { frames = 2, substeps = 1000000 }\n"
      "[[book]]\nmethod = 'springs'\nangular_velocity = [0.1, 0, 0]\n",
      "s.toml");
  std::stop_source source;
  std::atomic<long> frames_done = 0;
  const std::jthread stopper([&] {
    while (frames_done == 0) std::this_thread::yield();
    source.request_stop();
  });
  EXPECT_THROW((void)simulate(scene, source.get_token(), &frames_done), Stopped);
  EXPECT_EQ(frames_done, 1);
}

TEST(Simulate, CountsTheFramesOfEveryBook) {
  std::atomic<long> frames_done = 0;
  (void)simulate(parse_scene("title = 'T'\nclip.frames = 7\nbook = [{}, { method = 'exact' }]\n", "s.toml"), {},
                 &frames_done);
  EXPECT_EQ(frames_done, 14);
}

TEST(Simulate, SameSceneTwiceGivesTheSameBits) {
  const std::string book = "method = 'springs'\nangular_velocity = [0.9, 0.3, 0.1]\njiggle = 0.1\ndamping = 0\n";
  const BookTrack a = run(book, 200, 0.1, 6);
  const BookTrack b = run(book, 200, 0.1, 6);
  for (std::size_t n = 0; n < a.frames.size(); ++n) {
    EXPECT_EQ(a.frames[n].corners_W, b.frames[n].corners_W);
    EXPECT_EQ(a.frames[n].q_WB.coeffs(), b.frames[n].q_WB.coeffs());
    EXPECT_EQ(a.frames[n].L_W, b.frames[n].L_W);
  }
}

// Where a book is drawn is no part of its motion.
TEST(Simulate, PositionDoesNotEnterTheMotion) {
  const std::string book = "angular_velocity = [0.9, 0.3, 0.1]\n";
  EXPECT_EQ(run(book, 20, 0.1, 6).frames[19].corners_W,
            run(book + "position = [3, 4, 5]\n", 20, 0.1, 6).frames[19].corners_W);
}

// Spun about y, the tilt of the spin axis of a steady spin is 0; the book's own orientation turns with omega t.
// A motion of the same book from another orientation is the same motion, turned as a whole.
TEST(Orientation, AtTheStartTurnsTheWholeMotion) {
  for (const std::string method : {"springs", "matrix", "quaternion", "exact"}) {
    const std::string book = "method = '" + method + "'\nangular_velocity = [0.115, 0.01, 0.02]\n";
    const BookTrack plain = run(book, 40, 3.0, 100);
    const BookTrack turned = run(book + "orientation = [2, 0, 2, 0]\n", 40, 3.0, 100);
    const Eigen::Quaterniond quarter(Eigen::AngleAxisd(pi / 2, Eigen::Vector3d::UnitY()));
    const Eigen::Matrix3d R = quarter.toRotationMatrix();
    for (std::size_t n = 0; n < 40; ++n) {
      const BookFrame &a = plain.frames[n], &b = turned.frames[n];
      EXPECT_LE((R * a.corners_W - b.corners_W).norm(), tolerance(1e-14));    // measured 1.1e-15
      EXPECT_LE((R * a.omega_W - b.omega_W).norm(), tolerance(1e-15));        // measured 3.1e-17
      EXPECT_LE(geodesic_angle(quarter * a.q_WB, b.q_WB), tolerance(1e-14));  // measured 4.6e-16
      EXPECT_LE(geodesic_angle(quarter * a.exact_q_WB, b.exact_q_WB), tolerance(1e-14));
      EXPECT_EQ(a.value[0], b.value[0]);  // the tilt, and all that is measured
    }
  }
}

// A plate has I3 = I1 + I2, by its size or by its moments, also where these are sums only but for rounding.
TEST(Plate, MovesAlikeBySizeByMomentsAndByRungeKutta) {
  ASSERT_NE(0.1 + 0.2, 0.3);
  const std::string rest = "angular_velocity = [0.3, 1, 0.2]\nmethod = ";
  const BookTrack plate = run("size = [1, 0.7071067811865476, 0]\n" + rest + "'exact'\n", 50, 1.0, 1);
  const BookTrack moments = run("moments = [0.1, 0.2, 0.3]\n" + rest + "'exact'\n", 50, 1.0, 1);
  const BookTrack stepped =
      run("size = [1, 0.7071067811865476, 0]\n" + rest + "'quaternion'\nintegrator = 'rk4'\n", 50, 1.0, 500);
  for (std::size_t n = 0; n < 50; ++n) {
    EXPECT_LE(geodesic_angle(plate.frames[n].q_WB, moments.frames[n].q_WB), tolerance(1e-13));  // measured 1.1e-14
    EXPECT_LE(stepped.frames[n][Q::angle_error], tolerance(1e-11));                             // measured 1.3e-12
    EXPECT_LE(plate.frames[n][Q::stretch], tolerance(1e-13));                                   // measured 6.7e-15
  }
  EXPECT_EQ(body_of({.size = {1, 0, 2}}).corners_B(1, 7), 0.01);  // drawn thin: 0.02, half to each side
}

TEST(Moments, AreThoseOfTheirBook) {
  const Eigen::Vector3d moments(62.2, 210.5, 171.5);
  const Eigen::Vector3d of_size = body_of({.size = *size_of(moments)}).I_B;
  EXPECT_LE((of_size - moments).cwiseAbs().maxCoeff(), tolerance(6e-14));  // measured 2.8e-14
  EXPECT_EQ(body_of({.particle_mass = 3.0, .moments = moments}).I_B, 3.0 * moments);
  EXPECT_FALSE(size_of({3, 5, 9}).has_value());
  EXPECT_EQ(size_of({1, 1, 2})->z(), 0.0);
}

TEST(Tilt, OfASteadySpinIs0) {
  const BookTrack track = run("method = 'quaternion'\nangular_velocity = [0, 0.5, 0]\n", 100, 0.1, 100);
  for (std::size_t n = 0; n < 100; ++n) {
    const BookFrame& f = track.frames[n];
    EXPECT_LE(f[Q::tilt], tolerance(1e-12));  // measured: 0
    const double t = 0.1 * static_cast<double>(n);
    const Eigen::Quaterniond exact(Eigen::AngleAxisd(0.5 * t, Eigen::Vector3d::UnitY()));
    EXPECT_LE(geodesic_angle(f.q_WB, exact), tolerance(1e-6));  // measured: 1.0e-7
    EXPECT_EQ(f[Q::flips], 0);
  }
}

// The sign of q is continuous: after one turn q has gone to -q.
TEST(Orientation, IsContinuousInSign) {
  const BookTrack track = run("method = 'matrix'\nangular_velocity = [0, 0, 1]\n", 127, 0.1, 20);  // 2 turns
  for (std::size_t n = 1; n < track.frames.size(); ++n) {
    EXPECT_GT(track.frames[n].q_WB.dot(track.frames[n - 1].q_WB), 0.99);
    EXPECT_NEAR(track.frames[n].q_WB.norm(), 1.0, tolerance(1e-14));  // measured: 0
  }
  EXPECT_LT(track.frames[63].q_WB.w(), -0.99);
}

// What counting gives, value by value.
template <class Counter>
std::vector<int> counts(Counter counter, const std::vector<double>& values) {
  std::vector<int> result;
  for (const double value : values) result.push_back(counter.count(value));
  return result;
}

TEST(Passages, AreCountedOnceEachWay) {
  EXPECT_EQ(counts(Passages(10, 170), {5, 175, 5}), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(counts(Passages(10, 170), {100, 170, 171, 120, 175, 10, 9, 11, 5, 180}),
            (std::vector<int>{0, 0, 1, 1, 1, 1, 2, 2, 2, 3}));
  EXPECT_EQ(counts(Passages(10, 170), {175, std::nan(""), 5, 5}), (std::vector<int>{1, 1, 2, 2}));
}

TEST(Pulsations, AreATenthUpAndATenthDown) {
  EXPECT_EQ(counts(Pulsations(), {1, 1.2, 1}), (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(counts(Pulsations(), {1, 1.09, 1, 1.09, 1.01}), (std::vector<int>{0, 0, 0, 0, 0}));
  // Down to 1.3 / 1.1 = 1.1818, then up to 1.1 times 1.18 = 1.298, down to 1.31 / 1.1 = 1.1909.
  EXPECT_EQ(counts(Pulsations(), {1.05, 1.3, 1.19, 1.18, 1.29, 1.19, 1.31, 1.2, 1.19}),
            (std::vector<int>{0, 0, 0, 1, 1, 1, 1, 1, 2}));
  EXPECT_EQ(counts(Pulsations(), {0.8, 0.9, 0.8}), (std::vector<int>{0, 0, 1}));  // smaller than at rest, too
}

TEST(Flips, AreCountedWhereTheTiltHasPassed30Or150Degrees) {
  const BookTrack track = run("method = 'matrix'\nangular_velocity = [0.11482, 0, 0]\njiggle = 0.01\n", 1500, 1.0, 60);
  double flips = 0;
  for (const BookFrame& f : track.frames) {
    if (f[Q::flips] != flips) {
      EXPECT_EQ(f[Q::flips], ++flips);
      EXPECT_TRUE(std::fmod(flips, 2.0) == 1.0 ? f[Q::tilt] > 150.0 : f[Q::tilt] < 30.0) << f[Q::tilt];
    }
    const Eigen::Vector3d axis = f.q_WB * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(f[Q::tilt], std::acos(std::clamp(axis.x(), -1.0, 1.0)) * 180.0 / pi,
                1e-5);  // acos: 1e-8 radians near 0 and 180
  }
  EXPECT_GE(flips, 4);
}

// The exact book's numbers are those that the exact method has from the same start, and they go on when the book's end.
TEST(ExactBook, IsMeasuredBesideEveryBook) {
  const std::string start = "angular_velocity = [0.11482, 0, 0]\njiggle = 0.01\nnormalize = false\n";
  const BookTrack exact = run("method = 'exact'\n" + start, 800, 0.5, 1);
  EXPECT_EQ(exact.frames.back()[Q::flips], 2);
  for (const char* method : {"method = 'springs'\n", "method = 'matrix'\n"}) {
    const BookTrack track = run(method + start, 800, 0.5, 1);
    ASSERT_TRUE(track.exploded_frame.has_value());
    EXPECT_FALSE(track.frames.back().corners_W.allFinite());
    for (std::size_t n = 0; n < 800; ++n) {
      const BookFrame& f = track.frames[n];
      EXPECT_LE(geodesic_angle(f.exact_q_WB, exact.frames[n].q_WB), tolerance(1e-15));  // measured: 3e-16
      if (!f.corners_W.allFinite()) continue;
      EXPECT_NEAR(f[Q::exact_tilt], exact.frames[n][Q::tilt], tolerance(1e-13));  // degrees; measured: 3e-14
      EXPECT_EQ(f[Q::exact_flips], exact.frames[n][Q::flips]);
    }
  }
}

// Pulsations of a quaternion of norm s in a turn of phi: the largest singular value is |1 - s^2 + s^2 e^(i phi)|, a
// swelling and a shrinking each turn once (2 s^2 - 1) > 1.1.
TEST(Pulsations, AreOneATurnOnceTheNormHasGrown) {
  const BookTrack track =
      run("method = 'quaternion'\nangular_velocity = [0, 0, 0.12]\nnormalize = false\n", 660, 0.5, 2);
  double turned = 0.0;
  double turned_grown = 0.0;
  double pulsations = 0.0;
  for (std::size_t n = 1; n < track.frames.size() && !track.frames[n].exploded(); ++n) {
    const BookFrame& f = track.frames[n];
    const double s2 = f[Q::norm] * f[Q::norm];
    const double turn = geodesic_angle(f.q_WB, track.frames[n - 1].q_WB);
    turned += turn;
    if (2.0 * s2 - 1.0 > 1.1) turned_grown += turn;
    EXPECT_LE(f[Q::blend_defect], tolerance(1e-13));  // measured: 8.9e-16
    EXPECT_LE(f[Q::largest_singular_value], 2.0 * s2 - 1.0 + 1e-12);
    EXPECT_GE(f[Q::pulsations], pulsations);
    pulsations = f[Q::pulsations];
  }
  EXPECT_GE(pulsations, 3);
  EXPECT_GE(pulsations, turned_grown / (2.0 * pi) - 1.0);
  EXPECT_LE(pulsations, turned / (2.0 * pi) + 1.0);
}

// What the book itself would measure: omega and L in its own frame, whatever its orientation at the start.
TEST(BodyRates, AreThoseOfTheExactMotion) {
  const std::string book = "method = 'exact'\nmoments = [2, 3, 4]\nangular_momentum = [1, -2, 3]\n";
  const BookTrack track = run(book + "orientation = [1, 2, 3, 4]\n", 30, 0.3, 1);
  const TorqueFree exact({2, 3, 4}, Eigen::Quaterniond::Identity(), {1, -2, 3});
  for (std::size_t n = 0; n < 30; ++n) {
    const BookFrame& f = track.frames[n];
    const Eigen::Vector3d L_B(f[Q::L_Bx], f[Q::L_By], f[Q::L_Bz]);
    EXPECT_LE((L_B - exact.at(static_cast<double>(n) * 0.3).L_B).norm(), tolerance(1e-14));  // measured 2.3e-15
    EXPECT_EQ(Eigen::Vector3d(f[Q::omega_Bx], f[Q::omega_By], f[Q::omega_Bz]),
              L_B.cwiseQuotient(Eigen::Vector3d(2, 3, 4)));
    EXPECT_LE((f.q_WB * L_B - f.L_W).norm(), tolerance(1e-14));  // measured 3.2e-15
  }
}

// A method that keeps a quaternion of unit norm knows its orientation to the last digit, where the eight corners of a
// needle hardly tell how it is turned about itself.
TEST(Orientation, OfANeedleIsExact) {
  const std::string needle = "size = [1, 1e-6, 1e-6]\nangular_velocity = [0.6, -0.5, 0.4]\n";
  BookOptions o;
  o.size = {1.0, 1e-6, 1e-6};
  o.omega_W = {0.6, -0.5, 0.4};
  const TorqueFree exact = exact_motion(o);
  const BookTrack track = run("method = 'exact'\n" + needle, 301, 0.2, 1);
  double worst = 0.0;
  for (std::size_t n = 0; n < track.frames.size(); ++n) {
    worst = std::max({worst, geodesic_angle(track.frames[n].q_WB, exact.at(0.2 * static_cast<double>(n)).q_WB),
                      track.frames[n][Q::angle_error]});
  }
  EXPECT_LE(worst, tolerance(1e-15));  // measured: 3.4e-16; by the corners alone: 5.0e-11
  // A quaternion of another norm is no orientation: then it is the rotation nearest to the corners.
  const BookFrame grown =
      run("method = 'quaternion'\nangular_velocity = [0, 0, 0.1]\nnormalize = false\n", 120, 0.5, 2).frames.back();
  EXPECT_GT(grown[Q::norm], 1.01);
  const Eigen::Quaterniond fit = best_fit_orientation(grown.corners_W, body_of(BookOptions{}).corners_B);
  const Eigen::Vector4d up_to_sign = fit.coeffs() * (fit.dot(grown.q_WB) < 0.0 ? -1.0 : 1.0);
  EXPECT_EQ(Eigen::Vector4d(grown.q_WB.coeffs()), up_to_sign);
}

// At the start the angular velocity is the script's; of a free book it goes with the angular momentum as
// L_B = I_B omega_B, whatever the mass.
TEST(AngularVelocity, IsThatOfTheAngularMomentum) {
  const Eigen::Vector3d omega_W(0.3, 0.2, 0.1);
  BookOptions o;
  o.particle_mass = 3.0;
  const Eigen::Vector3d I_B = body_of(o).I_B;
  for (const char* method : {"springs", "matrix", "quaternion", "exact"}) {
    const BookTrack track = run(
        std::string("method = '") + method + "'\nparticle_mass = 3\ndamping = 0\nangular_velocity = [0.3, 0.2, 0.1]\n",
        50, 0.1, 10);
    EXPECT_LE((track.frames[0].omega_W - omega_W).norm(), tolerance(1e-15)) << method;  // measured: 6.4e-17
    for (const BookFrame& f : track.frames) {
      const Eigen::Vector3d omega_B = f.q_WB.conjugate() * f.omega_W;
      const Eigen::Vector3d L_B = f.q_WB.conjugate() * f.L_W;
      EXPECT_LE((I_B.cwiseProduct(omega_B) - L_B).norm(), tolerance(1e-13)) << method;  // measured: 1.1e-14
    }
  }
}

TEST(Ratios, AreRelativeToFrame0) {
  const BookTrack track =
      run("method = 'springs'\nangular_velocity = [0.6, 0.2, 0.6]\nnormalize = false\n", 100, 0.1, 4);
  const double E0 = track.frames[0][Q::kinetic_energy];
  for (const BookFrame& f : track.frames) {
    EXPECT_EQ(f[Q::energy_ratio], (f[Q::kinetic_energy] + f[Q::elastic_energy]) / E0);
    EXPECT_EQ(f[Q::angular_momentum_ratio], f.L_W.norm() / track.frames[0].L_W.norm());
  }
  EXPECT_GT(track.frames.back()[Q::energy_ratio], 1.1);
}

TEST(Explosion, FreezesTheCounters) {
  for (const char* book : {"method = 'springs'\nangular_velocity = [0.7, 0.1, 0.1]\nnormalize = false\ndamping = 0\n",
                           "method = 'springs'\nangular_velocity = [0.7, 0.1, 0.1]\nnormalize = false\n",
                           "method = 'matrix'\nangular_velocity = [0.7, 0.1, 0.1]\nnormalize = false\n",
                           "method = 'quaternion'\nangular_velocity = [0.7, 0.1, 0.1]\nnormalize = false\n"}) {
    const BookTrack track = run(book, 3000, 0.5, 1);
    ASSERT_TRUE(track.exploded_frame.has_value()) << book;
    const auto at = static_cast<std::size_t>(*track.exploded_frame);
    ASSERT_GT(at, 0U);
    bool finite = true;
    for (std::size_t n = 0; n < track.frames.size(); ++n) {
      const BookFrame& f = track.frames[n];
      EXPECT_EQ(f.exploded(), n >= at) << n;
      if (n < at) {
        EXPECT_LE(f[Q::extent], largest_extent);
      } else {
        EXPECT_EQ(f[Q::flips], track.frames[at - 1][Q::flips]);
        EXPECT_EQ(f[Q::pulsations], track.frames[at - 1][Q::pulsations]);
      }
      const bool now_finite = f.corners_W.allFinite();
      EXPECT_TRUE(finite || !now_finite) << "finite again in frame " << n;
      finite = now_finite;
      for (const Quantity& q : quantities) {
        const double value = f[q.id];
        const bool lost = !finite && !q.count;
        EXPECT_EQ(std::isnan(value), lost || std::isnan(track.frames[0][q.id])) << "frame " << n << ": " << q.name;
        EXPECT_FALSE(std::isinf(value)) << "frame " << n << ": " << q.name;
      }
      for (const Eigen::Vector3d& vector : {f.L_W, f.omega_W, Eigen::Vector3d(f.q_WB.vec())}) {
        EXPECT_EQ(vector.allFinite(), finite) << "frame " << n;
      }
    }
    EXPECT_FALSE(finite) << book;
    EXPECT_FALSE(track.frames[at][Q::extent] <= largest_extent);
  }
}

TEST(Explosion, NeverComesToABookAtRest) {
  const BookTrack track = run("method = 'quaternion'\n", 3, 0.5, 1);
  EXPECT_FALSE(track.exploded_frame.has_value());
  EXPECT_EQ(track.frames[2][Q::tilt], 0.0);
  EXPECT_EQ(track.frames[2][Q::stretch], 0.0);
}

}  // namespace
}  // namespace bookspin
