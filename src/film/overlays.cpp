#include "film/overlays.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "dynamics/shape.h"
#include "image/color.h"

namespace bookspin {
namespace {

constexpr std::array axis_colors{palette::orange, palette::sky, palette::green};
constexpr std::size_t trace_frames = 240;  // how long the trace stays, fading
constexpr double trace_length = 1.1;       // all lengths in those of half the book's diagonal
constexpr double arrow_length = 1.25;
constexpr double polhode_length = 1.25;  // of the ellipsoid's longest half axis: then it holds a book
constexpr std::size_t polhode_frames = 600;
constexpr double axis_beyond_cover = 0.42;
constexpr double full_strain = 0.05;  // a spring longer by this share has the full color
constexpr double exploded_brightness = 0.33;
constexpr double dimming = 0.2;  // seconds

void add_axes(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  const BookFrame& now = track.frames[frame];
  const double unit = body_of(setup.options).reach;
  const Eigen::Matrix3d F_WB = deformation(now.corners_W, body_of(setup.options).corners_B);
  for (int d = 0; d < 3; ++d) {
    const Color& color = axis_colors[static_cast<std::size_t>(d)];
    const Eigen::Vector3d surface_W = F_WB.col(d) * (0.5 * setup.options.size(d));
    const Eigen::Vector3d out_W = F_WB.col(d).normalized();
    const Eigen::Vector3d tip_W = surface_W + out_W * (axis_beyond_cover * unit);
    shot.arrows.push_back({Eigen::Vector3d::Zero(), tip_W, color, 0.022 * unit});
    Label name = make_label(std::string(1, "xyz"[d]), 0.07, color, {0.0, 0.02});
    name.weight = Weight::semibold;
    name.anchor_W = tip_W + out_W * (0.14 * unit);
    shot.labels.push_back(name);
  }
}

// The arrow, and as a line how long it was at the start.
void add_arrow(Shot& shot, const BookSetup& setup, const Eigen::Vector3d& vector, const Eigen::Vector3d& start,
               const Color& color, const char* name, double beside) {
  if (!(start.norm() > 0.0)) return;
  const double unit = body_of(setup.options).reach;
  const Eigen::Vector3d tip_W = vector * (arrow_length * unit / start.norm());
  shot.arrows.push_back({Eigen::Vector3d::Zero(), tip_W, color, 0.02 * unit});
  Color pale = color;
  pale.a = 130;
  shot.lines.push_back({Eigen::Vector3d::Zero(), start.normalized() * (arrow_length * unit), pale, 2.0});
  Label label = make_label(name, 0.05, color, {beside, 0.015});
  label.weight = Weight::semibold;
  label.anchor_W = tip_W;
  shot.labels.push_back(label);
}

// The two arrows often point the same way: one name stands left of its tip, one right.
void add_angular_velocity(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  add_arrow(shot, setup, track.frames[frame].omega_W, track.frames.front().omega_W, palette::sky, "ω", -0.04);
}

void add_angular_momentum(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  add_arrow(shot, setup, track.frames[frame].L_W, track.frames.front().L_W, palette::purple, "L", 0.04);
}

// The spin axis as an arrow, and the way of its tip.
void add_trace(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  const double unit = body_of(setup.options).reach;
  const Eigen::Vector3d axis_B = setup.options.omega_W.normalized() * (trace_length * unit);
  const auto tip_W = [&](std::size_t n) { return Eigen::Vector3d(track.frames[n].q_WB * axis_B); };
  shot.arrows.push_back({Eigen::Vector3d::Zero(), tip_W(frame), palette::yellow, 0.016 * unit});
  for (std::size_t n = frame - std::min(frame, trace_frames); n < frame; ++n) {
    Color color = palette::yellow;
    color.a = static_cast<std::uint8_t>(255 * (n + 1 + trace_frames - frame) / trace_frames);
    shot.lines.push_back({tip_W(n), tip_W(n + 1), color, 2.5});
  }
}

std::uint8_t mix(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

void add_springs(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  const BookFrame& now = track.frames[frame];
  const Corners corners_B = body_of(setup.options).corners_B;
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      const double rest = (corners_B.col(i) - corners_B.col(j)).norm();
      const double strain = (now.corners_W.col(i) - now.corners_W.col(j)).norm() / rest - 1.0;
      const Color& full = strain > 0.0 ? palette::vermilion : palette::sky;
      const double share = std::min(1.0, std::abs(strain) / full_strain);
      const Color color{mix(palette::light.r, full.r, share), mix(palette::light.g, full.g, share),
                        mix(palette::light.b, full.b, share), 255};
      shot.lines.push_back({now.corners_W.col(i), now.corners_W.col(j), color, 3.0});
    }
  }
}

void add_ghost(Shot& shot, const BookSetup& setup, const Eigen::Quaterniond& q_WB) {
  const Corners corners_W = q_WB.toRotationMatrix() * body_of(setup.options).corners_B;
  shot.books.push_back({as_bound(setup, corners_W), BookStyle::ghost});
}

void add_exact(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  add_ghost(shot, setup, track.frames[frame].exact_q_WB);
}

void add_unrotated(Shot& shot, const BookSetup& setup, const BookTrack&, std::size_t) {
  add_ghost(shot, setup, setup.q_WB0.value_or(Eigen::Quaterniond::Identity()));
}

// In the book's frame, and in units in which the ellipsoid is sum I_i w_i^2 = 1. What lies behind is drawn paler.
void add_polhode(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame) {
  const Body body = body_of(setup.options);
  const Eigen::Array3d I = body.I_B;
  const BookFrame& now = track.frames[frame];
  const double twice_energy = track.frames.front().L_W.cwiseProduct(track.frames.front().omega_W).sum();
  if (!(twice_energy > 0.0)) return;
  const Eigen::Matrix3d R_WB = polhode_length * body.reach * std::sqrt(I.minCoeff()) * now.q_WB.toRotationMatrix();
  const auto draw = [&](const std::vector<Eigen::Vector3d>& curve_B, const Color& color, double width) {
    for (std::size_t i = 1; i < curve_B.size(); ++i) {
      Line line{R_WB * curve_B[i - 1], R_WB * curve_B[i], color, width};
      const Eigen::Vector3d outwards_W = R_WB * (I * curve_B[i].array()).matrix();
      const bool behind = outwards_W.cwiseProduct(shot.camera.eye_W - line.to_W).sum() < 0.0;
      if (behind) line.color.a /= 4;
      shot.lines.push_back(line);
    }
  };
  const auto around = [](const auto& point_B) {
    constexpr int points = 72;
    std::vector<Eigen::Vector3d> curve_B;
    for (int i = 0; i <= points; ++i) curve_B.push_back(point_B(2.0 * std::numbers::pi * i / points));
    return curve_B;
  };
  std::array<int, 3> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(), [&](int a, int b) { return I(a) < I(b); });
  const int middle = axes[1];
  // Rings about the two outer axes: L^2 / 2E from the axis's own moment to the middle one, the separatrix.
  constexpr int rings = 4;
  for (const auto& [axis, other] : {std::pair(axes[0], axes[2]), std::pair(axes[2], axes[0])}) {
    const double gap = std::abs(I(axis) - I(other));
    const double flat = gap > 0.0 ? std::abs(I(axis) - I(middle)) / gap : 1.0;
    for (int k = 1; k <= (axis == axes[0] ? rings : rings - 1); ++k) {
      for (const double side : {-1.0, 1.0}) {
        const auto ring = around([&, along = axis, across = other](double phase) {
          Eigen::Vector3d w_B;
          w_B(middle) = std::sin(phase) * k / rings / std::sqrt(I(middle));
          w_B(across) = std::cos(phase) * k / rings * std::sqrt(flat / I(across));
          w_B(along) = 0.0;
          const double rest = 1.0 - (I * w_B.array().square()).sum();
          w_B(along) = side * std::sqrt(std::max(0.0, rest) / I(along));
          return w_B;
        });
        if (k == rings) {
          draw(ring, palette::vermilion, 2.0);
        } else {
          draw(ring, {236, 239, 244, 120}, 1.2);
        }
      }
    }
  }
  // The outline, where the lines of sight touch: a circle, once the ellipsoid is drawn out to a sphere.
  const Eigen::Vector3d eye = I.sqrt() * (R_WB.inverse() * shot.camera.eye_W).array();
  const Eigen::Vector3d u = eye.unitOrthogonal();
  const Eigen::Vector3d v = eye.normalized().cross(u);
  const double distance2 = eye.squaredNorm();
  draw(around([&](double phase) -> Eigen::Vector3d {
         const double radius = std::sqrt(std::max(0.0, 1.0 - 1.0 / distance2));
         const Eigen::Vector3d touched = eye / distance2 + radius * (std::cos(phase) * u + std::sin(phase) * v);
         return 0.999 * touched.array() / I.sqrt();  // on this side
       }),
       {236, 239, 244, 150}, 1.5);

  std::vector<Eigen::Vector3d> path_B;
  for (std::size_t n = frame - std::min(frame, polhode_frames); n <= frame; ++n) {
    path_B.emplace_back(track.frames[n].q_WB.conjugate() * track.frames[n].omega_W / std::sqrt(twice_energy));
  }
  draw(path_B, palette::yellow, 4.0);
  const Eigen::Vector3d tip_W = R_WB * path_B.back();
  shot.arrows.push_back({Eigen::Vector3d::Zero(), tip_W, palette::sky, 0.02 * body.reach});
}

struct Drawing {
  Overlay id;
  void (*add)(Shot& shot, const BookSetup& setup, const BookTrack& track, std::size_t frame);
  double reach;  // from the book's center in any frame, its label too; as_its_labels: as far as those, frame by frame
  bool around = false;  // it may stand below the book, where names do
};

constexpr double as_its_labels = -1.0;

constexpr std::array drawings{Drawing{Overlay::axes, add_axes, as_its_labels},
                              Drawing{Overlay::angular_velocity, add_angular_velocity, arrow_length + 0.1},
                              Drawing{Overlay::angular_momentum, add_angular_momentum, arrow_length + 0.1},
                              Drawing{Overlay::trace, add_trace, trace_length + 0.02, true},
                              Drawing{Overlay::springs, add_springs, 0.0},
                              Drawing{Overlay::exact, add_exact, 1.0},
                              Drawing{Overlay::unrotated, add_unrotated, 1.0},
                              Drawing{Overlay::polhode, add_polhode, polhode_length + 0.02, true}};

static_assert(drawings.size() == overlay_table.size());
static_assert(std::all_of(drawings.begin(), drawings.end(),
                          [](const Drawing& row) { return row.id == static_cast<Overlay>(&row - drawings.data()); }));

const Drawing& drawing(Overlay overlay) {
  return drawings[static_cast<std::size_t>(overlay)];
}

}  // namespace

Label make_label(const std::string& text, double height, const Color& color, const Eigen::Vector2d& position,
                 Align align) {
  Label label;
  label.text = text;
  label.position = position;
  label.height = height;
  label.color = color;
  label.align = align;
  return label;
}

Corners as_bound(const BookSetup& setup, const Corners& corners_W) {
  std::array<int, 3> axes{2, 0, 1};  // equal edges: as the paper's book
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return setup.options.size(a) < setup.options.size(b); });
  const auto [thickness, width, height] = axes;
  const int left_handed = (width + 1) % 3 == height ? 0 : 1;  // then the spine is on the other side, not a mirror image
  Corners bound_W;
  for (int i = 0; i < 8; ++i) {
    const int u = (i & 1) ^ left_handed, v = (i >> 1) & 1, w = i >> 2;
    bound_W.col(i) = corners_W.col(u << width | v << height | w << thickness);
  }
  return bound_W;
}

void add_book(Shot& shot, const BookSetup& setup, const BookTrack& track, int frame, int fps, bool gone,
              const Eigen::Vector2d& shift) {
  Shot alone;
  alone.camera = shot.camera;
  const auto n = static_cast<std::size_t>(frame);
  if (!gone) {
    alone.books.push_back({as_bound(setup, track.frames[n].corners_W),
                           setup.style == Style::ghost ? BookStyle::ghost : BookStyle::solid});
    if (track.frames[n].exploded()) {
      const double seconds = (frame - *track.exploded_frame + 1.0) / fps;
      alone.books.front().brightness = 1.0 - (1.0 - exploded_brightness) * std::min(1.0, seconds / dimming);
    }
  }
  for (const Overlay overlay : setup.show) {
    const bool ghost = overlay == Overlay::exact || overlay == Overlay::unrotated;
    if (!gone || ghost) drawing(overlay).add(alone, setup, track, n);
  }
  const auto put = [&](auto& from, auto& to, auto place) {
    for (auto& item : from) {
      item.*place += shift;
      to.push_back(item);
    }
  };
  put(alone.books, shot.books, &BookPose::shift);
  put(alone.arrows, shot.arrows, &Arrow::shift);
  put(alone.lines, shot.lines, &Line::shift);
  put(alone.labels, shot.labels, &Label::position);
}

double reach_below(const BookSetup& setup) {
  double reach = 1.0;
  for (const Overlay overlay : setup.show) {
    if (drawing(overlay).around) reach = std::max(reach, drawing(overlay).reach);
  }
  return reach * body_of(setup.options).reach;
}

std::vector<Sphere> overlay_reach(const BookSetup& setup, const BookTrack& track) {
  const double unit = body_of(setup.options).reach;
  std::vector<Sphere> spheres;
  bool labels_decide = false;
  for (const Overlay overlay : setup.show) {
    const double reach = drawing(overlay).reach;
    labels_decide = labels_decide || reach == as_its_labels;
    if (reach > 0.0) spheres.push_back({Eigen::Vector3d::Zero(), reach * unit});
  }
  for (std::size_t n = 0; labels_decide && n < track.frames.size(); ++n) {
    Shot shot;
    for (const Overlay overlay : setup.show) drawing(overlay).add(shot, setup, track, n);
    for (const Label& label : shot.labels) spheres.push_back({*label.anchor_W, 0.12 * unit});
  }
  return spheres;
}

}  // namespace bookspin
