// The hard cases, for every method and integrator that a script can name: finite or reported, never a crash, and never
// a wrong motion that passes for a right one.
#include <gtest/gtest.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/any_book.h"
#include "scene/scene_file.h"
#include "scene/simulate.h"
#include "tolerance.h"

namespace bookspin {
namespace {

struct Way {
  std::string_view method;
  std::string_view integrator;  // empty: the exact motion
  bool damped = false;
  [[nodiscard]] bool rigid() const { return method != "springs"; }
  [[nodiscard]] bool euler() const { return integrator.find("euler") != std::string::npos; }
  [[nodiscard]] bool accurate() const { return rigid() && !euler(); }
  [[nodiscard]] std::string name() const { return fmt::format("{} {}{}", method, integrator, damped ? " damped" : ""); }
  [[nodiscard]] std::string text() const {
    return fmt::format("method = '{}'\ndamping = {}\n{}", method, damped,
                       integrator.empty() ? "" : fmt::format("integrator = '{}'\n", integrator));
  }
};

Scene scene_of(const std::string& clip, const std::string& book) {
  return parse_scene("title = 'T'\nclip = { " + clip + " }\n[[book]]\n" + book, "s.toml");
}

constexpr std::array methods{Method::springs, Method::matrix, Method::quaternion, Method::exact};

const std::vector<Way>& ways() {
  static const auto found = [] {
    std::vector<Way> list;
    for (const Method method : methods) {
      for (const bool damped : {false, true}) {
        if (damped && method != Method::springs) continue;
        for (const IntegratorInfo& integrator : integrators) {
          if (takes(method, damped, integrator)) list.push_back({name_of(method), integrator.name, damped});
        }
      }
    }
    list.push_back({name_of(Method::exact), ""});
    return list;
  }();
  return found;
}

std::string error_of(const std::string& book) {
  try {
    static_cast<void>(scene_of("frames = 2", book));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no error";
}

TEST(Ways, AScriptMayNameWhatTheMethodTakesAndNothingElse) {
  for (const Method method : methods) {
    for (const bool damped : {false, true}) {
      std::vector<std::string_view> allowed;
      for (const IntegratorInfo& integrator : integrators) {
        if (takes(method, damped, integrator)) allowed.push_back(integrator.name);
      }
      for (const IntegratorInfo& integrator : integrators) {
        const Way way{name_of(method), integrator.name, damped};
        SCOPED_TRACE(way.name());
        if (takes(method, damped, integrator)) {
          EXPECT_EQ(scene_of("frames = 2", way.text()).books[0].options.integrator, integrator.id);
        } else if (method != Method::exact) {
          EXPECT_THAT(error_of(way.text()), testing::HasSubstr(fmt::format("one of {}", fmt::join(allowed, ", "))));
        }
      }
    }
  }
}

TEST(Ways, AWrongOneIsAnErrorThatSaysWhatIsAllowed) {
  EXPECT_EQ(error_of("method = 'matrix'\nintegrator = 'rk4'"),
            "s.toml:5:14: book.0.integrator: found 'rk4'; allowed: for matrix one of explicit_euler");
  EXPECT_EQ(error_of("method = 'quaternion'\nintegrator = 'rk5'"),
            "s.toml:5:14: book.0.integrator: found 'rk5'; allowed: for quaternion one of explicit_euler, rk4, "
            "dmv; did you mean \"rk4\"?");
  EXPECT_EQ(error_of("damping = 0.5\nintegrator = 'velocity_verlet'"),
            "s.toml:5:14: book.0.integrator: found 'velocity_verlet'; allowed: for springs with damping one of "
            "explicit_euler, semi_implicit_euler, rk4; velocity_verlet, rkn6, stoermer10 need damping = false");
  EXPECT_EQ(error_of("method = 'exact'\nintegrator = 'explicit_euler'"),
            "s.toml:5:14: book.0.integrator: found 'explicit_euler'; allowed: none: the exact motion takes no steps");
}

TEST(Ways, ABookIsNotMadeWithAnIntegratorThatItsMethodDoesNotTake) {
  const auto error = [](Method method, Integrator integrator, double damping) -> std::string {
    try {
      static_cast<void>(make_book(method, {.integrator = integrator, .damping = damping}));
    } catch (const std::invalid_argument& wrong) {
      return wrong.what();
    }
    return "no error";
  };
  EXPECT_EQ(error(Method::matrix, Integrator::rk4, 1.0), "matrix does not take rk4");
  EXPECT_EQ(error(Method::quaternion, Integrator::velocity_verlet, 0.0), "quaternion does not take velocity_verlet");
  EXPECT_EQ(error(Method::springs, Integrator::velocity_verlet, 1.0), "springs does not take velocity_verlet");
  EXPECT_EQ(error(Method::springs, Integrator::velocity_verlet, 0.0), "no error");
}

// Finite, or NaN and said to have exploded from that frame on; the frame that a film shows is finite.
void expect_honest(const BookTrack& track) {
  for (std::size_t n = 0; n < track.frames.size(); ++n) {
    const BookFrame& f = track.frames[n];
    if (!f.exploded()) {
      ASSERT_TRUE(f.corners_W.allFinite() && f.q_WB.coeffs().allFinite() && f.L_W.allFinite()) << "frame " << n;
      ASSERT_TRUE(std::isfinite(f[Q::angle_error]) && std::isfinite(f[Q::kinetic_energy]) &&
                  std::isfinite(f[Q::elastic_energy]))
          << "frame " << n;
      ASSERT_LE(f[Q::extent], largest_extent);
    }
    ASSERT_EQ(f.exploded(), track.exploded_frame.has_value() && static_cast<int>(n) >= *track.exploded_frame);
  }
}

double largest_error(const BookTrack& track) {
  double largest = 0.0;
  for (const BookFrame& f : track.frames) {
    if (!(f[Q::angle_error] <= largest)) largest = f[Q::angle_error];  // NaN too
  }
  return largest;
}

BookTrack run(const Way& way, const std::string& clip, const std::string& book) {
  BookTrack track = simulate(scene_of(clip, way.text() + book)).books[0];
  expect_honest(track);
  return track;
}

std::string omega(double x, double y, double z) {
  return fmt::format("angular_velocity = [{:.17g}, {:.17g}, {:.17g}]\n", x, y, z);
}

// Both sides of the separatrix and on it: a kick about y alone, about z alone, about both so that 2 E I_x = L^2.
TEST(HardCases, Separatrix) {
  const Eigen::Vector3d I = body_of(BookOptions{}).I_B;
  const double on = std::sqrt((I.x() - I.y()) * I.y() / ((I.z() - I.x()) * I.z()));  // omega_z / omega_y
  // On it, rounding alone decides when the book leaves the axis again, after some 60 units of time: look at 35.
  double worst_off = 0.0;
  double worst_on = 0.0;
  for (double kick = 1e-3; kick > 1e-16; kick *= 1e-3) {
    for (const bool is_on : {false, true}) {
      const std::string clip = fmt::format("frames = {}, time_per_frame = 0.7, substeps = 10", is_on ? 51 : 101);
      for (const std::string& start : is_on ? std::vector{omega(-1, -kick, on * kick), omega(1, kick, on * kick)}
                                            : std::vector{omega(1, kick, 0), omega(1, 0, kick)}) {
        for (const Way& way : ways()) {
          SCOPED_TRACE(way.name() + ' ' + start);
          const BookTrack track = run(way, clip, start);
          if (way.integrator == "dmv" || way.method == "exact") {
            double& worst = is_on ? worst_on : worst_off;
            worst = std::max(worst, largest_error(track));
          }
        }
      }
    }
  }
  EXPECT_LE(worst_off, tolerance(5e-4));  // measured: 2.3e-4 (splitting4)
  EXPECT_LE(worst_on, tolerance(3e-7));   // measured: 5.3e-8
}

// Without a kick the intermediate axis is a steady rotation; no rigid method may leave it, and springs at most by
// rounding.
TEST(HardCases, ZeroKick) {
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name());
    const BookTrack track = run(way, "frames = 301, time_per_frame = 0.1, substeps = 20", omega(0.5, 0, 0));
    if (way.rigid()) {
      EXPECT_LE(track.frames.back()[Q::tilt], tolerance(1e-16));  // measured: 8.8e-18 (exact), 0 for all others
    }
  }
}

TEST(HardCases, NoSpinAtAll) {
  for (const Way& way : ways()) {
    SCOPED_TRACE(way.name());
    const BookTrack track = run(way, "frames = 11, time_per_frame = 0.1, substeps = 2", omega(0, 0, 0));
    EXPECT_LE(largest_error(track), tolerance(1e-15));  // measured: 0
  }
}

// Nearly symmetric, symmetric, cube, flat plate, rod, plate of aspect 1 : 1 : 1e-6, in a general tumble.
TEST(HardCases, SpecialShapes) {
  for (const char* size : {"[1, 1.00000001, 2]", "[1, 1, 2]", "[1, 1, 1]", "[2, 3, 1e-6]", "[1, 1, 1e-6]",
                           "[1e-6, 1e-6, 1]", "[1e6, 1e6, 1]"}) {
    for (const Way& way : ways()) {
      SCOPED_TRACE(way.name() + ' ' + size);
      const BookTrack track = run(way, "frames = 101, time_per_frame = 0.2, substeps = 10",
                                  omega(0.6, -0.5, 0.4) + "size = " + size + "\n");
      if (way.accurate() && !track.exploded_frame) {
        EXPECT_LE(largest_error(track), tolerance(1e-8));  // measured: 1.7e-9
      }
    }
  }
}

// h |omega| from near 1 past pi. A rigid method either explodes, or keeps what it promises to keep, or shows that it
// does not.
TEST(HardCases, HighSpin) {
  for (const double h_omega : {0.9, 1.3, 1.5, 2.0, 3.0, 3.15, 7.0, 1000.0}) {
    for (const Eigen::Vector3d& axis :
         {Eigen::Vector3d(1, 1e-3, 1e-3), Eigen::Vector3d(0, 1, 0.1), Eigen::Vector3d(0.6, 0, 0.8)}) {
      for (const Way& way : ways()) {
        SCOPED_TRACE(fmt::format("{} {}", way.name(), h_omega));
        const Eigen::Vector3d w = h_omega / 0.1 * axis.normalized();
        const BookTrack track = run(way, "frames = 31, time_per_frame = 0.1, substeps = 1", omega(w.x(), w.y(), w.z()));
        const BookFrame& last = track.frames.back();
        if (way.integrator.starts_with("dmv") && h_omega > 1.6) {
          EXPECT_EQ(track.exploded_frame, 1);
        } else if (way.integrator.starts_with("dmv") && !track.exploded_frame) {
          EXPECT_NEAR(last[Q::energy_ratio], 1.0, tolerance(2e-14));  // measured: 7e-16
        }
        if ((way.integrator.starts_with("dmv") && !track.exploded_frame) || way.method == "exact") {
          EXPECT_NEAR(last[Q::angular_momentum_ratio], 1.0, tolerance(2e-14));  // measured: 1.8e-15
        }
        if (way.method == "exact") {
          EXPECT_LE(last[Q::angle_error], tolerance(1e-15));  // measured: 1.3e-16
        }
        if (way.integrator == "rk4" && way.rigid() && h_omega > 2.0 && axis.y() < 0.5) {
          EXPECT_TRUE(last.exploded() || std::abs(last[Q::angular_momentum_ratio] - 1.0) > 0.1)
              << last[Q::angular_momentum_ratio];
        }
      }
    }
  }
}

// Steps from far below to far above what explicit Euler bears; softest and stiffest springs.
TEST(HardCases, SpringsAcrossTheExplicitLimit) {
  for (const double stiffness : {1e-3, 10.0, 1e6}) {
    for (const double h : {1e-3, 0.02, 0.05, 0.5, 5.0}) {
      for (const bool normalize : {false, true}) {
        for (const Way& way : ways()) {
          if (way.rigid()) continue;
          SCOPED_TRACE(fmt::format("{} k {} h {}", way.name(), stiffness, h));
          const BookTrack track =
              run(way, fmt::format("frames = 301, time_per_frame = {}, substeps = 1", h),
                  omega(1, 0.001, 0.001) + fmt::format("stiffness = {}\nnormalize = {}\n", stiffness, normalize));
          if (stiffness > 1.0 && h > 4.0 && !normalize) {
            EXPECT_TRUE(track.exploded_frame.has_value());
          }
        }
      }
    }
  }
}

// So soft that, with steps so large, the springs come to hold more than the energy there was: the floor bites, and is
// counted. Two of the undamped methods keep the energy too well for that.
TEST(HardCases, PotentialAboveTheTotalEnergy) {
  for (const Way& way : ways()) {
    if (way.rigid()) continue;
    SCOPED_TRACE(way.name());
    const BookTrack track = run(way, "frames = 2001, time_per_frame = 0.5, substeps = 1",
                                omega(3, 0.1, 0.1) + "stiffness = 1\nnormalize = true\n");
    if (way.damped || (way.integrator != "rk4" && way.integrator != "rkn6" && way.integrator != "stoermer10")) {
      EXPECT_GT(track.frames.back()[Q::floor_hits], 0);
    }
  }
}

// Particles in one place have no direction to be pulled in.
TEST(HardCases, CoincidentParticles) {
  const SpringBook book{BookOptions{}};
  const SpringForces f = book.forces(Corners::Zero(), Corners::Ones());
  EXPECT_EQ(f.F_W, Corners(Corners::Zero()));
  EXPECT_GT(f.elastic_energy, 0.0);
}

// Without normalization: products of unit quaternions stay so to rounding, the others' norm is measured.
TEST(HardCases, QuaternionNormDrift) {
  for (const Way& way : ways()) {
    if (way.method != "quaternion") continue;
    SCOPED_TRACE(way.name());
    const BookTrack track =
        run(way, "frames = 101, time_per_frame = 5, substeps = 50", omega(1, 0.2, 0.3) + "normalize = false\n");
    if (way.euler()) {
      EXPECT_TRUE(track.exploded_frame.has_value());
    } else {
      const bool exact_turns = way.integrator != "rk4";
      EXPECT_NEAR(track.frames.back()[Q::norm], 1.0,
                  tolerance(exact_turns ? 1e-11 : 6e-6));  // measured: 1.1e-12 (splitting4), 1.8e-6
      EXPECT_NE(track.frames.back()[Q::norm], 1.0);
    }
  }
}

// Extremes of mass, which the motion does not depend on.
TEST(HardCases, TinyAndHugeMasses) {
  for (const char* mass : {"5e-324", "1e-300", "1e6"}) {
    for (const Way& way : ways()) {
      SCOPED_TRACE(way.name() + ' ' + mass);
      run(way, "frames = 11, time_per_frame = 0.1, substeps = 10",
          omega(0.6, -0.5, 0.4) + "particle_mass = " + mass + "\n");
    }
  }
}

// The exact motion is the same however the film cuts its time, to the last bit.
TEST(ExactMethod, DoesNotAccumulate) {
  const Way exact{"exact", "", false};
  const BookTrack fine = run(exact, "frames = 1001, time_per_frame = 0.125, substeps = 6", omega(1, 1e-3, 0));
  const BookTrack coarse = run(exact, "frames = 101, time_per_frame = 1.25, substeps = 1", omega(1, 1e-3, 0));
  for (std::size_t n = 0; n < 101; ++n) EXPECT_EQ(coarse.frames[n].corners_W, fine.frames[10 * n].corners_W);
  EXPECT_LE(largest_error(fine), tolerance(1e-15));  // measured: 2.5e-16
}

// The springs' angle to the rigid motion: model and integration error together, and small while the springs are stiff.
TEST(AngleError, OfSpringsFallsWithTheirStiffness) {
  const auto error = [](double stiffness) {
    return largest_error(run(Way{"springs", "rk4", true}, "frames = 51, time_per_frame = 0.1, substeps = 20",
                             omega(0.5, 0.2, 0.1) + fmt::format("normalize = false\nstiffness = {}\n", stiffness)));
  };
  const double soft = error(10.0);
  EXPECT_LE(soft, tolerance(0.1));                         // measured: 0.033
  EXPECT_NEAR(soft / error(100.0), 10.0, tolerance(2.0));  // measured: 8.6
}

}  // namespace
}  // namespace bookspin
