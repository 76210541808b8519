#include "film/overlays.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "dynamics/rigid_book.h"
#include "dynamics/shape.h"
#include "scene/quantities.h"

namespace bookspin {
namespace {

constexpr std::array axis_colors{palette::orange, palette::sky, palette::green};
constexpr int trace_frames = 240;     // how long the trace stays, fading
constexpr double trace_reach = 1.25;  // all reaches in lengths of half the book's diagonal
constexpr double arrow_reach = 1.4;
constexpr double axis_beyond_cover = 0.42;
constexpr double full_strain = 0.1;  // a spring longer by this share has the full colour

void add_axes(Shot& shot, const BookSetup& setup, const BookFrame& now) {
  const double unit = body_of(setup.options).reach;
  const Eigen::Matrix3d F_WB = deformation(now.corners_W, body_of(setup.options).corners_B);
  for (int d = 0; d < 3; ++d) {
    const Color& color = axis_colors[static_cast<std::size_t>(d)];
    const Eigen::Vector3d surface_W = F_WB.col(d) * (0.5 * setup.options.size(d));
    const Eigen::Vector3d out_W = F_WB.col(d).normalized();
    const Eigen::Vector3d tip_W = surface_W + out_W * (axis_beyond_cover * unit);
    shot.arrows.push_back({setup.position_W, setup.position_W + tip_W, color, 0.022 * unit});
    Label name = make_label(std::string(1, "xyz"[d]), 0.07, color, {0.0, 0.02});
    name.weight = Weight::semibold;
    name.anchor_W = setup.position_W + tip_W + out_W * (0.14 * unit);
    shot.labels.push_back(name);
  }
}

void add_arrow(Shot& shot, const BookSetup& setup, const Eigen::Vector3d& vector, double full, const Color& color,
               const char* name, double below) {
  const double unit = body_of(setup.options).reach;
  if (!(full > 0.0)) return;
  const Eigen::Vector3d tip_W = vector * (arrow_reach * unit / full);
  shot.arrows.push_back({setup.position_W, setup.position_W + tip_W, color, 0.02 * unit});
  Label label = make_label(name, 0.05, color, {0.0, below});
  label.weight = Weight::semibold;
  label.anchor_W = setup.position_W + tip_W + vector.normalized() * (0.12 * unit);
  shot.labels.push_back(label);
}

Eigen::Vector3d angular_velocity_of(const BookSetup& setup, const BookFrame& now) {
  const Eigen::Vector3d I_B = body_of(setup.options).I_B;
  return angular_velocity_W(now.q_WB.toRotationMatrix(), I_B, now.L_W);
}

void add_trace(Shot& shot, const BookSetup& setup, const BookTrack& track, int frame) {
  const Eigen::Vector3d axis_B = setup.options.omega_W.normalized() * (trace_reach * body_of(setup.options).reach);
  const auto tip_W = [&](int n) { return Eigen::Vector3d(setup.position_W + track.shown(n).q_WB * axis_B); };
  const int first = std::max(0, frame - trace_frames);
  for (int n = first; n < frame; ++n) {
    Color color = palette::yellow;
    color.a = static_cast<std::uint8_t>(std::lround(255.0 * (n + 1 - frame + trace_frames) / trace_frames));
    shot.lines.push_back({tip_W(n), tip_W(n + 1), color, 2.5});
  }
}

std::uint8_t mix(std::uint8_t from, std::uint8_t to, double share) {
  return static_cast<std::uint8_t>(std::lround(from + (to - from) * share));
}

void add_springs(Shot& shot, const BookSetup& setup, const BookFrame& now) {
  const Corners corners_B = body_of(setup.options).corners_B;
  for (int i = 0; i < 8; ++i) {
    for (int j = i + 1; j < 8; ++j) {
      const double rest = (corners_B.col(i) - corners_B.col(j)).norm();
      const double strain = (now.corners_W.col(i) - now.corners_W.col(j)).norm() / rest - 1.0;
      const Color& full = strain > 0.0 ? palette::vermilion : palette::sky;
      const double share = std::min(1.0, std::abs(strain) / full_strain);
      const Color color{mix(palette::light.r, full.r, share), mix(palette::light.g, full.g, share),
                        mix(palette::light.b, full.b, share), 255};
      shot.lines.push_back(
          {setup.position_W + now.corners_W.col(i), setup.position_W + now.corners_W.col(j), color, 2.0});
    }
  }
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

void add_overlays(Shot& shot, const BookSetup& setup, const BookTrack& track, int frame) {
  const BookFrame& now = track.shown(frame);
  const BookFrame& start = track.frames.front();
  if (setup.show.axes) add_axes(shot, setup, now);
  if (setup.show.angular_velocity) {
    add_arrow(shot, setup, angular_velocity_of(setup, now), angular_velocity_of(setup, start).norm(), palette::sky, "ω",
              -0.01);  // the two often point the same way: one name above, one below
  }
  if (setup.show.angular_momentum) add_arrow(shot, setup, now.L_W, start.L_W.norm(), palette::purple, "L", 0.045);
  if (setup.show.trace) add_trace(shot, setup, track, frame);
  if (setup.show.springs) add_springs(shot, setup, now);
}

double overlay_reach(const BookSetup& setup) {
  double reach = 0.0;
  if (setup.show.trace) reach = std::max(reach, trace_reach + 0.02);
  if (setup.show.angular_velocity || setup.show.angular_momentum) reach = std::max(reach, arrow_reach + 0.2);
  return reach * body_of(setup.options).reach;
}

std::string head_up_text(const Quantity& quantity, const BookFrame& frame) {
  const double value = quantity.of(frame);
  return fmt::format("{} {}", quantity.symbol,
                     std::isfinite(value) ? fmt::format(fmt::runtime(quantity.format), value) : "–");
}

}  // namespace bookspin
