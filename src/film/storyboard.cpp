#include "film/storyboard.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "film/overlays.h"
#include "image/color.h"
#include "render/camera.h"

namespace bookspin {
namespace {

constexpr double vertical_fov = 0.5235987755982988;  // 30 degrees, as in the original program
constexpr double margin = 1.04;                      // free space about the motion
constexpr double middle_band = 0.88;                 // of the height: above it stands the title, below it the figures
constexpr double name_offset = 1.16;                 // of a name below its book, in lengths of its half diagonal
constexpr double left_edge = 0.03;                   // of the title and what stands below it, in frame widths
constexpr double title_y = 0.07;                     // base line; this and all below in frame heights
constexpr double title_height = 0.04;
constexpr double figure_height = 0.035;
constexpr double line_height = 0.05;

// The camera from which all spheres lie inside the four side planes of the picture.
Camera camera_that_frames(const std::vector<Sphere>& spheres, const Eigen::Vector3d& from_W, double aspect) {
  Eigen::AlignedBox3d box;
  for (const Sphere& s : spheres) box.extend(s.center_W);
  Camera camera;
  camera.vertical_fov = vertical_fov;
  camera.target_W = box.center();
  const Eigen::Matrix3d R_CW = camera_axes(from_W);
  const Eigen::Vector3d back_W = R_CW.row(2).transpose();
  const double tan_half = std::tan(vertical_fov / 2.0);
  double distance = 0.0;
  // Per direction: how far the spheres reach towards the two side planes that face along +-axis, were the eye at the
  // target.
  const auto frame_along = [&](const Eigen::Vector3d& axis_W, double half) {
    const auto reach = [&](double sign) {
      const Eigen::Vector3d outward_W = sign * std::cos(half) * axis_W + std::sin(half) * back_W;
      double farthest = -std::numeric_limits<double>::infinity();
      for (const Sphere& s : spheres) {
        farthest = std::max(farthest, outward_W.dot(s.center_W - camera.target_W) + margin * s.radius);
      }
      return farthest;
    };
    const double plus = reach(1.0);
    const double minus = reach(-1.0);
    camera.target_W += axis_W * ((plus - minus) / (2.0 * std::cos(half)));  // as much room on one side as on the other
    distance = std::max(distance, (plus + minus) / (2.0 * std::sin(half)));
  };
  frame_along(R_CW.row(0).transpose(), std::atan(aspect * tan_half));
  frame_along(R_CW.row(1).transpose(), std::atan(middle_band * tan_half));
  camera.eye_W = camera.target_W + distance * back_W;
  return camera;
}

// Below the book in the picture: along the camera's down, not the world's.
Eigen::Vector3d name_anchor_W(const Scene& scene, const BookSetup& setup) {
  const Eigen::Vector3d up_W = camera_axes(scene.view.from).row(1).transpose();
  return setup.position_W - up_W * (name_offset * body_of(setup.options).reach);
}

// "E/E₀ 1.003"
std::string head_up_text(const Quantity& q, double value) {
  return fmt::format("{} {}", q.symbol, std::isfinite(value) ? fmt::format(fmt::runtime(q.format), value) : "–");
}

}  // namespace

Storyboard::Storyboard(const Scene& scene, const Trajectory& trajectory, double aspect)
    : scene_(&scene), trajectory_(&trajectory) {
  std::vector<Sphere> spheres;
  last_moving_frame_ = 0;
  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const BookSetup& setup = scene.books[b];
    const BookTrack& track = trajectory.books[b];
    const double unit = body_of(setup.options).reach;
    last_moving_frame_ = std::max(last_moving_frame_, track.exploded_frame.value_or(scene.clip.frames));
    double farthest = 1.0;
    for (int n = 0; n < scene.clip.frames; ++n) farthest = std::max(farthest, track.shown(n)[Q::extent]);
    spheres.push_back({setup.position_W, farthest * unit});
    if (!setup.name.empty()) spheres.push_back({name_anchor_W(scene, setup), 0.1 * unit});
    const std::vector<Sphere> overlays = overlay_reach(setup, track);
    spheres.insert(spheres.end(), overlays.begin(), overlays.end());
  }
  camera_ = camera_that_frames(spheres, scene.view.from, aspect);
}

Shot Storyboard::shot(int frame) const {
  Shot shot;
  shot.camera = camera_;
  shot.labels.push_back(make_label(scene_->title, title_height, palette::gray, {left_edge, title_y}, Align::left));
  std::string notice;
  for (std::size_t b = 0; b < scene_->books.size(); ++b) {
    const BookSetup& setup = scene_->books[b];
    const BookTrack& track = trajectory_->books[b];
    const BookFrame& now = track.shown(frame);
    shot.books.push_back({now.corners_W.colwise() + setup.position_W,
                          setup.style == Style::ghost ? BookStyle::ghost : BookStyle::solid});
    add_overlays(shot, setup, track, frame);
    if (!setup.name.empty()) {
      Label name = make_label(setup.name, 0.042, palette::light, {0.0, 0.0});
      name.anchor_W = name_anchor_W(*scene_, setup);
      shot.labels.push_back(name);
    }
    if (track.exploded_frame && frame >= *track.exploded_frame) {
      notice +=
          fmt::format("{}{}exploded at t = {:.4g}", notice.empty() ? "" : "   ",
                      setup.name.empty() ? "" : setup.name + " ", *track.exploded_frame * scene_->clip.time_per_frame);
    }
  }
  double y = title_y + 1.2 * line_height;
  if (!notice.empty()) {
    shot.labels.push_back(make_label(notice, title_height, palette::yellow, {left_edge, y}, Align::left));
    y += line_height;
  }
  add_head_up(shot, frame, y);
  return shot;
}

// Below the title, the time and the figures that the script names; for several books below each book's name. Never at
// the bottom left, where a browser's controls lie over them.
void Storyboard::add_head_up(Shot& shot, int frame, double y) const {
  if (scene_->view.head_up.empty()) return;
  const auto add = [&shot](const std::string& text, const Eigen::Vector2d& position, Align align) -> Label& {
    shot.labels.push_back(make_label(text, figure_height, palette::light, position, align));
    shot.labels.back().tabular = true;
    return shot.labels.back();
  };
  add(fmt::format("t {:.1f}", std::min(frame, last_moving_frame_) * scene_->clip.time_per_frame), {left_edge, y},
      Align::left);
  const bool one = std::count_if(scene_->books.begin(), scene_->books.end(),
                                 [](const BookSetup& book) { return book.style == Style::solid; }) <= 1;
  for (std::size_t b = 0; b < scene_->books.size(); ++b) {
    const BookSetup& setup = scene_->books[b];
    if (setup.style == Style::ghost && scene_->books.size() > 1) continue;
    const BookFrame& now = trajectory_->books[b].shown(frame);
    double below_name = 0.0;
    for (const Q q : scene_->view.head_up) {
      const std::string text = head_up_text(quantity(q), now[q]);
      if (one) {
        add(text, {left_edge, y += line_height}, Align::left);
      } else {
        add(text, {0.0, below_name += line_height}, Align::center).anchor_W = name_anchor_W(*scene_, setup);
      }
    }
  }
}

}  // namespace bookspin
