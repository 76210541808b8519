#include "scene/simulate.h"

#include <Eigen/SVD>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include "dynamics/shape.h"
#include "scene/any_book.h"

namespace bookspin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Counts the passages of a value between two levels: up through `high` after having been below `low`, and back.
class Passages {
 public:
  int count(double value, double low, double high) {
    if (!upper_ && value > high) {
      upper_ = true;
      ++count_;
    } else if (upper_ && value < low) {
      upper_ = false;
      ++count_;
    }
    return count_;
  }

 private:
  bool upper_ = false;
  int count_ = 0;
};

// Counts swellings: a rise to 1.1 times the least value since the last one, then a fall to 1 / 1.1 of the largest.
class Pulsations {
 public:
  int count(double size) {
    least_ = std::fmin(least_, size);
    largest_ = std::fmax(largest_, size);
    if (!swollen_ && size >= 1.1 * least_) {
      swollen_ = true;
      largest_ = size;
    } else if (swollen_ && size <= largest_ / 1.1) {
      swollen_ = false;
      least_ = size;
      ++count_;
    }
    return count_;
  }

 private:
  double least_ = 1.0;
  double largest_ = 1.0;
  bool swollen_ = false;
  int count_ = 0;
};

BookFrame non_finite_frame(const BookFrame& before) {
  BookFrame f = before;
  f.corners_W.setConstant(nan);
  f.q_WB.coeffs().setConstant(nan);
  f.L_W.setConstant(nan);
  for (double* value :
       {&f.kinetic_energy, &f.elastic_energy, &f.energy_ratio, &f.angular_momentum_ratio, &f.stretch, &f.extent,
        &f.tilt, &f.norm, &f.largest_singular_value, &f.orthogonality_defect, &f.blend_defect, &f.angle_error}) {
    *value = nan;
  }
  f.exploded = true;
  return f;
}

// Squares overflow long before the corners do: then the corners are still numbers, but what is measured on them is not.
bool overflown(const BookFrame& f) {
  for (const double value : {f.kinetic_energy, f.elastic_energy, f.L_W.x(), f.L_W.y(), f.L_W.z(), f.stretch,
                             f.largest_singular_value, f.orthogonality_defect}) {
    if (!std::isfinite(value)) return true;
  }
  return std::isinf(f.energy_ratio) || std::isinf(f.angular_momentum_ratio);  // 0 / 0 for a book that does not turn
}

// Measures one book, frame after frame.
class Recorder {
 public:
  // `options`: those of the setup, with the jiggle in omega_W.
  Recorder(const BookSetup& setup, const BookOptions& options, std::size_t frames)
      : corners_B_(body_of(options).corners_B), exact_(exact_motion(options)) {
    const double speed = setup.options.omega_W.norm();
    if (speed > 0.0) spin_axis_ = setup.options.omega_W / speed;
    track_.frames.reserve(frames);
  }

  template <class Book>
  void record(const Book& book, double t) {
    const bool first = track_.frames.empty();
    const Corners& corners_W = book.corners_W();
    const double extent_now = extent(corners_W, corners_B_);
    if (!first && (!std::isfinite(extent_now) || !track_.frames.back().corners_W.allFinite())) {
      push(non_finite_frame(track_.frames.back()));
      return;
    }
    BookFrame f{};
    f.corners_W = corners_W;
    f.extent = extent_now;
    f.exploded = f.extent > largest_extent || track_.exploded_frame.has_value();
    f.q_WB = best_fit_orientation(corners_W, corners_B_);
    if (!first && f.q_WB.dot(track_.frames.back().q_WB) < 0.0) f.q_WB.coeffs() = -f.q_WB.coeffs();
    f.L_W = book.angular_momentum_W();
    f.kinetic_energy = book.kinetic_energy();
    f.norm = nan;
    f.blend_defect = nan;
    const Eigen::Matrix3d F_WB = deformation(corners_W, corners_B_);
    if constexpr (std::is_same_v<Book, SpringBook>) {
      f.elastic_energy = book.elastic_energy();
      f.floor_hits = book.floor_hits();
    }
    if constexpr (std::is_same_v<Book, QuaternionBook> || std::is_same_v<Book, FreeBook>) {
      f.norm = book.q_WB().norm();
      const double s2 = f.norm * f.norm;
      const Eigen::Matrix3d blend =
          (1.0 - s2) * Eigen::Matrix3d::Identity() + s2 * book.q_WB().normalized().toRotationMatrix();
      f.blend_defect = (F_WB - blend).cwiseAbs().maxCoeff();
    }
    f.angle_error = geodesic_angle(f.q_WB, exact_.at(t).q_WB);
    f.stretch = stretch(corners_W, corners_B_);
    f.largest_singular_value = Eigen::JacobiSVD<Eigen::Matrix3d>(F_WB).singularValues()(0);
    f.orthogonality_defect = (F_WB.transpose() * F_WB - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    f.tilt = angle_between(f.q_WB * spin_axis_, spin_axis_) * 180.0 / std::numbers::pi;
    if (f.exploded && !first) {
      f.flips = track_.frames.back().flips;
      f.pulsations = track_.frames.back().pulsations;
    } else {
      f.flips = flips_.count(f.tilt, 10.0, 170.0);
      f.pulsations = pulsations_.count(f.largest_singular_value);
    }
    const BookFrame& start = first ? f : track_.frames.front();
    const double start_energy = start.kinetic_energy + start.elastic_energy;
    f.energy_ratio = (f.kinetic_energy + f.elastic_energy) / start_energy;
    f.angular_momentum_ratio = f.L_W.norm() / start.L_W.norm();
    push(!first && overflown(f) ? non_finite_frame(track_.frames.back()) : f);
  }

  BookTrack take() { return std::move(track_); }

 private:
  void push(const BookFrame& f) {
    if (f.exploded && !track_.exploded_frame) track_.exploded_frame = static_cast<int>(track_.frames.size());
    track_.frames.push_back(f);
  }

  Corners corners_B_;
  TorqueFree exact_;
  Eigen::Vector3d spin_axis_ = Eigen::Vector3d::Zero();  // body = world frame at the start; without the jiggle
  Passages flips_;
  Pulsations pulsations_;
  BookTrack track_;
};

// A step takes about a microsecond: a million of them a frame must not keep anyone waiting who wants to stop.
constexpr int steps_between_looks = 1024;

BookTrack simulate_book(const BookSetup& setup, const Clip& clip, const Eigen::Vector3d& jiggle,
                        const std::stop_token& stop, std::atomic<long>& frames_done) {
  BookOptions options = setup.options;
  options.omega_W += setup.jiggle * options.omega_W.norm() * jiggle;
  const double h = clip.time_per_frame / clip.substeps;
  Recorder recorder(setup, options, static_cast<std::size_t>(clip.frames));
  AnyBook any_book = make_book(setup.method, options);
  std::visit(
      [&](auto& book) {
        recorder.record(book, 0.0);
        ++frames_done;
        for (int frame = 1; frame < clip.frames; ++frame) {
          if (stop.stop_requested()) throw Stopped();
          const double t = frame * clip.time_per_frame;
          if constexpr (std::is_same_v<std::decay_t<decltype(book)>, ExactBook>) {
            book.move_to(t);
          } else {
            for (int i = 0; i < clip.substeps; ++i) {
              if (i % steps_between_looks == steps_between_looks - 1 && stop.stop_requested()) throw Stopped();
              book.step(h);
            }
          }
          recorder.record(book, t);
          ++frames_done;
        }
      },
      any_book);
  return recorder.take();
}

}  // namespace

Eigen::Vector3d jiggle_direction(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11U) * 0x1p-52 - 1.0; };  // [-1, 1)
  while (true) {
    Eigen::Vector3d u;
    for (int d = 0; d < 3; ++d) u(d) = uniform();
    const double n2 = u.x() * u.x() + u.y() * u.y() + u.z() * u.z();
    if (n2 > 1e-4 && n2 <= 1.0) return u / std::sqrt(n2);
  }
}

Trajectory simulate(const Scene& scene, const std::stop_token& stop, std::atomic<long>* frames_done) {
  std::atomic<long> nobody_counts = 0;
  std::atomic<long>& counter = frames_done == nullptr ? nobody_counts : *frames_done;
  const Eigen::Vector3d jiggle = jiggle_direction(scene.seed);
  Trajectory trajectory;
  for (const BookSetup& setup : scene.books) {
    trajectory.books.push_back(simulate_book(setup, scene.clip, jiggle, stop, counter));
  }
  return trajectory;
}

}  // namespace bookspin
