#include "film/storyboard.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "dynamics/shape.h"

namespace bookspin {
namespace {

constexpr double vertical_fov = 0.5235987755982988;  // 30 degrees, as in the original program
constexpr double margin = 1.06;                      // free space about the motion
constexpr double name_offset = 1.16;                 // of a name below its book, in lengths of its half diagonal

// Okabe and Ito's colours, told apart by every kind of colour vision.
constexpr Color axis_colors[3] = {{230, 159, 0, 255}, {86, 180, 233, 255}, {0, 158, 115, 255}};
constexpr Color name_color{236, 239, 244, 255};
constexpr Color notice_color{240, 228, 66, 255};

struct Sphere {
  Eigen::Vector3d center_W;
  double radius;
};

// The camera from which all spheres lie inside the four side planes of the picture.
Camera camera_that_frames(const std::vector<Sphere>& spheres, const Eigen::Vector3d& from_W, double aspect) {
  Eigen::AlignedBox3d box;
  for (const Sphere& s : spheres) box.extend(s.center_W);
  Camera camera;
  camera.vertical_fov = vertical_fov;
  camera.target_W = box.center();
  const Eigen::Vector3d back_W = from_W.normalized();
  const Eigen::Vector3d right_W = Eigen::Vector3d::UnitY().cross(back_W).normalized();
  const Eigen::Vector3d up_W = back_W.cross(right_W);
  const double half_height = vertical_fov / 2.0;
  const double half_width = std::atan(aspect * std::tan(half_height));
  double distance = 0.0;
  for (const Sphere& s : spheres) {
    const Eigen::Vector3d p_W = s.center_W - camera.target_W;
    for (const auto& [side_W, half] : {std::pair{right_W, half_width}, std::pair{Eigen::Vector3d(-right_W), half_width},
                                       std::pair{up_W, half_height}, std::pair{Eigen::Vector3d(-up_W), half_height}}) {
      const Eigen::Vector3d outward_W = std::cos(half) * side_W + std::sin(half) * back_W;
      distance = std::max(distance, (outward_W.dot(p_W) + margin * s.radius) / std::sin(half));
    }
  }
  camera.eye_W = camera.target_W + distance * back_W;
  return camera;
}

Label centred_label(const std::string& text, double height, const Color& color, const Eigen::Vector2d& position) {
  Label label;
  label.text = text;
  label.position = position;
  label.height = height;
  label.color = color;
  label.align = Align::center;
  return label;
}

double half_diagonal(const BookSetup& setup) { return 0.5 * setup.options.size.norm(); }

}  // namespace

Storyboard::Storyboard(const Scene& scene, const Trajectory& trajectory, double aspect)
    : scene_(&scene), trajectory_(&trajectory) {
  std::vector<Sphere> spheres;
  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const BookSetup& setup = scene.books[b];
    double farthest = setup.show_axes ? 1.45 : 1.0;  // the axes reach beyond the book
    for (int n = 0; n < scene.clip.frames; ++n) farthest = std::max(farthest, trajectory.books[b].shown(n).extent);
    spheres.push_back({setup.position_W, farthest * half_diagonal(setup)});
    if (!setup.name.empty()) {
      spheres.push_back({setup.position_W - Eigen::Vector3d(0.0, name_offset * farthest * half_diagonal(setup), 0.0), 0.0});
    }
  }
  camera_ = camera_that_frames(spheres, scene.view.from, aspect);
}

Shot Storyboard::shot(int frame) const {
  Shot shot;
  shot.camera = camera_;
  std::string notice;
  for (std::size_t b = 0; b < scene_->books.size(); ++b) {
    const BookSetup& setup = scene_->books[b];
    const BookTrack& track = trajectory_->books[b];
    const BookFrame& now = track.shown(frame);
    shot.books.push_back({now.corners_W.colwise() + setup.position_W,
                          setup.style == Style::ghost ? BookStyle::ghost : BookStyle::solid});
    if (setup.show_axes) add_axes(shot, setup, now);
    if (!setup.name.empty()) {
      Label name = centred_label(setup.name, 0.042, name_color, {0.0, 0.0});
      name.anchor_W = setup.position_W - Eigen::Vector3d(0.0, name_offset * half_diagonal(setup), 0.0);
      shot.labels.push_back(name);
    }
    if (track.exploded_frame && frame >= *track.exploded_frame) {
      notice += fmt::format("{}{}exploded at t = {:.4g}", notice.empty() ? "" : "   ",
                            setup.name.empty() ? "" : setup.name + " ", *track.exploded_frame * scene_->clip.time_per_frame);
    }
  }
  if (!notice.empty()) {
    shot.labels.push_back(centred_label(notice + ": the last frame before", 0.045, notice_color, {0.5, 0.94}));
  }
  return shot;
}

void Storyboard::add_axes(Shot& shot, const BookSetup& setup, const BookFrame& now) const {
  const Eigen::Matrix3d F_WB = deformation(now.corners_W, corners_at_rest(setup.options.size));
  const double reach = 0.55 * half_diagonal(setup);
  constexpr std::array names{"x", "y", "z"};
  for (int d = 0; d < 3; ++d) {
    const Eigen::Vector3d surface_W = F_WB.col(d) * (0.5 * setup.options.size(d));
    const Eigen::Vector3d tip_W = surface_W + F_WB.col(d).normalized() * reach;
    shot.arrows.push_back({setup.position_W - surface_W, setup.position_W + tip_W, axis_colors[d], 0.022 * half_diagonal(setup)});
    Label name = centred_label(names[static_cast<std::size_t>(d)], 0.07, axis_colors[d], {0.0, 0.02});
    name.weight = Weight::semibold;
    name.anchor_W = setup.position_W + tip_W + F_WB.col(d).normalized() * (0.14 * half_diagonal(setup));
    shot.labels.push_back(name);
  }
}

}  // namespace bookspin
