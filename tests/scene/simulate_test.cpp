// Scene -> trajectory: explosions, held frames, tilt, flips and pulsations.
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
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
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
TEST(Simulate, takes_its_steps) {
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
    EXPECT_EQ(springs.frames[n].elastic_energy, spring_book.elastic_energy());
    EXPECT_EQ(springs.frames[n].floor_hits, spring_book.floor_hits());
    EXPECT_EQ(matrix.frames[n].corners_W, matrix_book.corners_W());
    EXPECT_EQ(quaternion.frames[n].corners_W, quaternion_book.corners_W());
    EXPECT_EQ(quaternion.frames[n].norm, quaternion_book.q_WB().norm());
    EXPECT_TRUE(std::isnan(springs.frames[n].norm));
    EXPECT_TRUE(std::isnan(matrix.frames[n].blend_defect));
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

TEST(Simulate, same_scene_twice_gives_the_same_bits) {
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
TEST(Simulate, position_does_not_enter_the_motion) {
  const std::string book = "angular_velocity = [0.9, 0.3, 0.1]\n";
  EXPECT_EQ(run(book, 20, 0.1, 6).frames[19].corners_W,
            run(book + "position = [3, 4, 5]\n", 20, 0.1, 6).frames[19].corners_W);
}

// Spun about y, the tilt of the spin axis of a steady spin is 0; the book's own orientation turns with omega t.
TEST(Tilt, of_a_steady_spin_is_0) {
  const BookTrack track = run("method = 'quaternion'\nangular_velocity = [0, 0.5, 0]\n", 100, 0.1, 100);
  for (std::size_t n = 0; n < 100; ++n) {
    const BookFrame& f = track.frames[n];
    EXPECT_LE(f.tilt, tolerance(1e-12));  // measured: 0
    const double t = 0.1 * static_cast<double>(n);
    const Eigen::Quaterniond exact(Eigen::AngleAxisd(0.5 * t, Eigen::Vector3d::UnitY()));
    EXPECT_LE(geodesic_angle(f.q_WB, exact), tolerance(1e-6));  // measured: 1.0e-7
    EXPECT_EQ(f.flips, 0);
  }
}

// The sign of q is continuous: after one turn q has gone to -q.
TEST(Orientation, is_continuous_in_sign) {
  const BookTrack track = run("method = 'matrix'\nangular_velocity = [0, 0, 1]\n", 127, 0.1, 20);  // 2 turns
  for (std::size_t n = 1; n < track.frames.size(); ++n) {
    EXPECT_GT(track.frames[n].q_WB.dot(track.frames[n - 1].q_WB), 0.99);
    EXPECT_NEAR(track.frames[n].q_WB.norm(), 1.0, tolerance(1e-14));  // measured: 0
  }
  EXPECT_LT(track.frames[63].q_WB.w(), -0.99);
}

// Flips counted anew from the tilt: below 10, then above 170, then below 10 again.
TEST(Flips, are_passages_of_the_tilt) {
  const BookTrack track = run("method = 'matrix'\nangular_velocity = [0.11482, 0, 0]\njiggle = 0.01\n", 1500, 1.0, 60);
  int flips = 0;
  bool over = false;
  double largest = 0.0;
  for (const BookFrame& f : track.frames) {
    if (over ? f.tilt < 10.0 : f.tilt > 170.0) {
      over = !over;
      ++flips;
    }
    EXPECT_EQ(f.flips, flips);
    const Eigen::Vector3d axis = f.q_WB * Eigen::Vector3d::UnitX();
    EXPECT_NEAR(f.tilt, std::acos(std::clamp(axis.x(), -1.0, 1.0)) * 180.0 / pi,
                1e-5);  // acos: 1e-8 radians near 0 and 180
    largest = std::max(largest, f.tilt);
  }
  EXPECT_GE(flips, 4);
  EXPECT_GT(largest, 170.0);
}

// Pulsations of a quaternion of norm s in a turn of phi: the largest singular value is |1 - s^2 + s^2 e^(i phi)|, a
// swelling and a shrinking each turn once (2 s^2 - 1) > 1.1.
TEST(Pulsations, are_one_a_turn_once_the_norm_has_grown) {
  const BookTrack track =
      run("method = 'quaternion'\nangular_velocity = [0, 0, 0.12]\nnormalize = false\n", 660, 0.5, 2);
  int counted = 0;
  double least = 1.0;
  double largest = 1.0;
  bool swollen = false;
  double turned = 0.0;
  for (std::size_t n = 0; n < track.frames.size(); ++n) {
    const BookFrame& f = track.frames[n];
    const double s2 = f.norm * f.norm;
    if (n > 0) turned += geodesic_angle(f.q_WB, track.frames[n - 1].q_WB);
    EXPECT_LE(f.blend_defect, tolerance(1e-13));  // measured: 8.9e-16
    EXPECT_LE(f.largest_singular_value, 2.0 * s2 - 1.0 + 1e-12);
    if (f.exploded) break;
    least = std::min(least, f.largest_singular_value);
    largest = std::max(largest, f.largest_singular_value);
    if (!swollen && f.largest_singular_value >= 1.1 * least) {
      swollen = true;
      largest = f.largest_singular_value;
    } else if (swollen && f.largest_singular_value <= largest / 1.1) {
      swollen = false;
      least = f.largest_singular_value;
      ++counted;
    }
    EXPECT_EQ(f.pulsations, counted) << n;
  }
  EXPECT_GE(counted, 3);
  EXPECT_LE(counted, turned / (2.0 * pi) + 1.0);
}

TEST(Ratios, are_relative_to_frame_0) {
  const BookTrack track =
      run("method = 'springs'\nangular_velocity = [0.6, 0.2, 0.6]\nnormalize = false\n", 100, 0.1, 4);
  const double E0 = track.frames[0].kinetic_energy;
  for (const BookFrame& f : track.frames) {
    EXPECT_EQ(f.energy_ratio, (f.kinetic_energy + f.elastic_energy) / E0);
    EXPECT_EQ(f.angular_momentum_ratio, f.L_W.norm() / track.frames[0].L_W.norm());
  }
  EXPECT_GT(track.frames.back().energy_ratio, 1.1);
}

TEST(Explosion, holds_the_last_frame_before_and_freezes_the_counters) {
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
      EXPECT_EQ(f.exploded, n >= at) << n;
      EXPECT_EQ(&track.shown(static_cast<int>(n)), &track.frames[std::min(n, at - 1)]) << n;
      if (n < at) {
        EXPECT_LE(f.extent, largest_extent);
      } else {
        EXPECT_EQ(f.flips, track.frames[at - 1].flips);
        EXPECT_EQ(f.pulsations, track.frames[at - 1].pulsations);
      }
      const bool now_finite = f.corners_W.allFinite();
      EXPECT_TRUE(finite || !now_finite) << "finite again in frame " << n;
      finite = now_finite;
      for (const double value :
           {f.kinetic_energy, f.elastic_energy, f.stretch, f.extent, f.tilt, f.largest_singular_value,
            f.orthogonality_defect, f.q_WB.w(), f.L_W.x(), f.energy_ratio, f.angular_momentum_ratio}) {
        EXPECT_EQ(std::isfinite(value), finite) << "frame " << n << ": " << value;
        EXPECT_FALSE(std::isinf(value));
      }
    }
    EXPECT_FALSE(finite) << book;
    EXPECT_FALSE(track.frames[at].extent <= largest_extent);
  }
}

TEST(Explosion, never_comes_to_a_book_at_rest) {
  const BookTrack track = run("method = 'quaternion'\n", 3, 0.5, 1);
  EXPECT_FALSE(track.exploded_frame.has_value());
  for (int n = 0; n < 3; ++n) EXPECT_EQ(&track.shown(n), &track.frames[static_cast<std::size_t>(n)]);
  EXPECT_EQ(track.frames[2].tilt, 0.0);
  EXPECT_EQ(track.frames[2].stretch, 0.0);
}

}  // namespace
}  // namespace bookspin
