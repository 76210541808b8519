#include "scene/book_run.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <type_traits>

#include "dynamics/shape.h"
#include "scene/any_book.h"
#include "scene/counters.h"

namespace bookspin {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double unit_norm = 4.0 * std::numeric_limits<double>::epsilon();  // a quaternion this near to 1 has norm 1

// Where numbers have ended: the counts of the frame before, and the exact book.
BookFrame non_finite_frame(const BookFrame& before, const Eigen::Quaterniond& exact_q_WB) {
  BookFrame f;
  f.corners_W.setConstant(nan);
  f.q_WB.coeffs().setConstant(nan);
  f.L_W.setConstant(nan);
  f.omega_W.setConstant(nan);
  for (const Quantity& q : quantities) f[q.id] = q.count ? before[q.id] : nan;
  f[Q::exploded] = 1.0;
  f.exact_q_WB = exact_q_WB;
  return f;
}

// Squares overflow long before the corners do: then the corners are still numbers, but what is measured on them is not.
bool overflown(const BookFrame& f, const BookFrame& start) {
  for (const Quantity& q : quantities) {
    if (std::isinf(f[q.id]) || (std::isnan(f[q.id]) && !std::isnan(start[q.id]))) return true;
  }
  return !f.L_W.allFinite() || !f.omega_W.allFinite();
}

// A quaternion of unit norm is the orientation, to the last digit. A book whose quaternion is not is deformed, as
// springs and matrices are: then the rotation that is nearest to the deformation.
template <class Book>
Eigen::Quaterniond orientation(const Book& book, const Corners& corners_W, const Corners& corners_B) {
  if constexpr (requires { book.q_WB(); }) {
    if (std::abs(book.q_WB().norm() - 1.0) <= unit_norm) return book.q_WB().normalized();
  }
  return best_fit_orientation(corners_W, corners_B);
}

// Measures one book, frame after frame.
class Recorder {
 public:
  // `options`: those of the setup, with the jiggle in omega_W.
  Recorder(const BookSetup& setup, const BookOptions& options, std::size_t frames)
      : body_(body_of(options)),
        exact_(exact_motion(options)),
        spin_axis_(setup.options.omega_W.normalized()),
        q_WB0_(setup.q_WB0) {
    track_.frames.reserve(frames);
  }

  template <class Book>
  void record(const Book& book, double t) {
    const bool first = track_.frames.empty();
    BookFrame f;
    f.corners_W = book.corners_W();
    f.exact_q_WB = exact_.at(t).q_WB;
    f[Q::extent] = extent(f.corners_W, body_.corners_B);
    if (!first && (!std::isfinite(f[Q::extent]) || !last_.corners_W.allFinite())) {
      push(non_finite_frame(last_, f.exact_q_WB));
      return;
    }
    f[Q::exploded] = f[Q::extent] > largest_extent || track_.exploded_frame ? 1.0 : 0.0;
    f.q_WB = orientation(book, f.corners_W, body_.corners_B);
    if (!first && f.q_WB.dot(last_.q_WB) < 0.0) f.q_WB.coeffs() = -f.q_WB.coeffs();
    f[Q::angle_error] = geodesic_angle(f.q_WB, f.exact_q_WB);
    f[Q::tilt] = tilt(f.q_WB);
    f[Q::exact_tilt] = tilt(f.exact_q_WB);
    f[Q::exact_flips] = exact_flips_.count(f[Q::exact_tilt]);
    measure_shape(f, book);
    f[Q::flips] = f.exploded() && !first ? last_[Q::flips] : flips_.count(f[Q::tilt]);
    f[Q::pulsations] = f.exploded() && !first ? last_[Q::pulsations] : pulsations_.count(f[Q::largest_singular_value]);
    measure_motion(f, book);
    push(!first && overflown(f, start_) ? non_finite_frame(last_, f.exact_q_WB) : f);
  }

  [[nodiscard]] BookTrack& track() { return track_; }
  [[nodiscard]] const BookTrack& track() const { return track_; }

 private:
  [[nodiscard]] double tilt(const Eigen::Quaterniond& q_WB) const {  // degrees
    return angle_between(q_WB * spin_axis_, spin_axis_) * 180.0 / std::numbers::pi;
  }

  template <class Book>
  void measure_shape(BookFrame& f, const Book& book) const {
    const Eigen::Matrix3d F_WB = deformation(f.corners_W, body_.corners_B);
    f[Q::stretch] = stretch(f.corners_W, body_.corners_B);
    f[Q::largest_singular_value] = Eigen::JacobiSVD<Eigen::Matrix3d>(F_WB).singularValues()(0);
    f[Q::orthogonality_defect] = (F_WB.transpose() * F_WB - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
    f[Q::norm] = nan;
    f[Q::blend_defect] = nan;
    if constexpr (requires { book.q_WB(); }) {
      f[Q::norm] = book.q_WB().norm();
      const double s2 = f[Q::norm] * f[Q::norm];
      const Eigen::Matrix3d blend =
          (1.0 - s2) * Eigen::Matrix3d::Identity() + s2 * book.q_WB().normalized().toRotationMatrix();
      f[Q::blend_defect] = (F_WB - blend).cwiseAbs().maxCoeff();
    }
  }

  template <class Book>
  void measure_motion(BookFrame& f, const Book& book) const {
    f.L_W = book.angular_momentum_W();
    f.omega_W = angular_velocity_W(f.q_WB.toRotationMatrix(), body_.I_B, f.L_W);
    const Eigen::Vector3d L_B = f.q_WB.conjugate() * f.L_W;
    for (std::size_t d = 0; d < 3; ++d) {
      f.value[static_cast<std::size_t>(Q::L_Bx) + d] = L_B(static_cast<int>(d));
      f.value[static_cast<std::size_t>(Q::omega_Bx) + d] = L_B(static_cast<int>(d)) / body_.I_B(static_cast<int>(d));
    }
    f[Q::kinetic_energy] = book.kinetic_energy();
    if constexpr (requires { book.elastic_energy(); }) {
      f[Q::elastic_energy] = book.elastic_energy();
      f[Q::floor_hits] = static_cast<double>(book.floor_hits());
    }
    const BookFrame& start = track_.frames.empty() ? f : start_;
    const double start_energy = start[Q::kinetic_energy] + start[Q::elastic_energy];
    f[Q::energy_ratio] = (f[Q::kinetic_energy] + f[Q::elastic_energy]) / start_energy;
    f[Q::angular_momentum_ratio] = f.L_W.norm() / start.L_W.norm();
  }

  void push(const BookFrame& f) {
    if (f.exploded() && !track_.exploded_frame) track_.exploded_frame = static_cast<int>(track_.frames.size());
    last_ = f;
    if (track_.frames.empty()) start_ = f;
    track_.frames.push_back(f);
    if (!q_WB0_) return;
    const Eigen::Matrix3d R = q_WB0_->toRotationMatrix();
    BookFrame& turned = track_.frames.back();
    turned.corners_W = R * f.corners_W;
    turned.q_WB = *q_WB0_ * f.q_WB;
    turned.exact_q_WB = *q_WB0_ * f.exact_q_WB;
    turned.L_W = R * f.L_W;
    turned.omega_W = R * f.omega_W;
  }

  Body body_;
  TorqueFree exact_;
  Eigen::Vector3d spin_axis_;  // body = world frame at the start; without the jiggle; 0 for a book at rest
  Passages flips_{30.0, 150.0};
  Passages exact_flips_{30.0, 150.0};
  Pulsations pulsations_;
  std::optional<Eigen::Quaterniond> q_WB0_;
  BookFrame start_, last_;  // not turned by q_WB0
  BookTrack track_;
};

BookOptions with_jiggle(const BookSetup& setup, std::uint64_t seed) {
  BookOptions options = setup.options;
  options.omega_W += setup.jiggle * options.omega_W.norm() * jiggle_direction(seed);
  return options;
}

// A step takes up to a microsecond: a million of them a frame must not keep anyone waiting who wants to stop.
constexpr int steps_between_looks = 1024;

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

struct BookRun::Parts {
  Clip clip;
  AnyBook book;
  Recorder recorder;

  Parts(const BookSetup& setup, const Clip& clip_of_scene, const BookOptions& options)
      : clip(clip_of_scene),
        book(make_book(setup.method, options)),
        recorder(setup, options, static_cast<std::size_t>(clip.frames)) {
    std::visit([this](const auto& one) { recorder.record(one, 0.0); }, book);
  }
};

BookRun::BookRun(const BookSetup& setup, const Clip& clip, std::uint64_t seed)
    : parts_(std::make_unique<Parts>(setup, clip, with_jiggle(setup, seed))) {}

BookRun::~BookRun() = default;
BookRun::BookRun(BookRun&&) noexcept = default;

void BookRun::advance(const std::function<void()>& look) {
  const Clip& clip = parts_->clip;
  const double h = clip.time_per_frame / clip.substeps;
  const double t = static_cast<double>(track().frames.size()) * clip.time_per_frame;
  std::visit(
      [&](auto& book) {
        if constexpr (std::is_same_v<std::decay_t<decltype(book)>, ExactBook>) {
          book.move_to(t);
        } else {
          for (int done = 0; done < clip.substeps; done += steps_between_looks) {
            if (done > 0 && look) look();
            book.step(h, std::min(steps_between_looks, clip.substeps - done));
          }
        }
        parts_->recorder.record(book, t);
      },
      parts_->book);
}

const BookTrack& BookRun::track() const {
  return parts_->recorder.track();
}

BookTrack BookRun::take() && {
  return std::move(parts_->recorder.track());
}

}  // namespace bookspin
