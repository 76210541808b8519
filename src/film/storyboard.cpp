#include "film/storyboard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "film/overlays.h"
#include "image/color.h"
#include "render/camera.h"
#include "render/text.h"

namespace bookspin {
namespace {

constexpr double vertical_fov = 0.5235987755982988;  // 30 degrees, as in the original program
constexpr double margin = 1.04;                      // free space about the motion
constexpr double middle_band = 0.88;                 // of the height: above it stands the title, below it the figures
constexpr double lowest_line = 0.98;                 // base line of the figures, frame heights; a smaller band heeds it
constexpr double name_offset = 1.16;                 // of a name below its book, in lengths of its half diagonal
constexpr double left_edge = 0.03;                   // of the title and what stands below it, in frame widths
constexpr double title_y = 0.07;                     // base line; this and all below in frame heights
constexpr double title_height = 0.04;
constexpr double name_height = 0.042;
constexpr double figure_height = 0.035;
constexpr double line_height = 0.05;
constexpr double name_gap = 0.06;  // between texts below two books in a row, in those of their distance

// The camera from which all spheres lie inside the four side planes of the picture.
Camera camera_that_frames(const std::vector<Sphere>& spheres, const Eigen::Vector3d& from_W, double aspect,
                          double band) {
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
  frame_along(R_CW.row(1).transpose(), std::atan(band * tan_half));
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

Storyboard::Storyboard(const Scene& scene, const Trajectory& trajectory, int width, int height)
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
  double lowest = 1.0;
  for (double band = middle_band; lowest > lowest_line && band > 0.3; band -= 0.02) {
    camera_ = camera_that_frames(spheres, scene.view.from, static_cast<double>(width) / height, band);
    lowest = 0.0;
    for (const Label& label : text(0)) {
      if (!label.anchor_W) continue;
      lowest = std::max(lowest, View(camera_, width, height).project(*label.anchor_W).y / height + label.position.y());
    }
  }
  fit_text(width, height);
}

void Storyboard::fit_text(int width, int height) {
  TextPainter painter;
  const View view(camera_, width, height);
  // Below a book: to the picture's nearer edge, and half way to the next book of the row.
  const auto room = [&](const Label& label) {
    if (!label.anchor_W) return (1.0 - 2.0 * left_edge) * width;
    const PixelPoint here = view.project(*label.anchor_W);
    double half = std::min(here.x, width - here.x);
    for (const BookSetup& other : scene_->books) {
      const PixelPoint there = view.project(name_anchor_W(*scene_, other));
      const double apart = std::abs(there.x - here.x);
      const bool in_row = std::abs(there.y - here.y) < 3.0 * line_height * height;
      if (in_row && apart > 0.5 * line_height * height) half = std::min(half, 0.5 * apart);
    }
    return 2.0 * (1.0 - name_gap) * half;
  };
  for (int frame = 0; frame < scene_->clip.frames; ++frame) {
    for (Label& label : text(frame)) {
      double& set = set_height_.try_emplace(label.height, label.height).first->second;
      for (label.height = set; set * height > 1.5; label.height = set) {
        if (painter.lay_out(label, view, width, height).length <= room(label)) break;
        set = (std::round(set * height) - 1.0) / height;
      }
    }
  }
}

Shot Storyboard::shot(int frame) const {
  Shot shot;
  shot.camera = camera_;
  for (std::size_t b = 0; b < scene_->books.size(); ++b) {
    const BookSetup& setup = scene_->books[b];
    const BookTrack& track = trajectory_->books[b];
    shot.books.push_back({track.shown(frame).corners_W.colwise() + setup.position_W,
                          setup.style == Style::ghost ? BookStyle::ghost : BookStyle::solid});
    add_overlays(shot, setup, track, frame);
  }
  for (Label& label : text(frame)) {
    label.height = set_height_.at(label.height);
    shot.labels.push_back(std::move(label));
  }
  return shot;
}

// From the top left down: title, explosions, the time and the figures that the script names; of several books below
// each, with its name. Never at the bottom left, where a browser's controls lie over them.
std::vector<Label> Storyboard::text(int frame) const {
  const std::vector<BookSetup>& books = scene_->books;
  std::vector<Label> labels{make_label(scene_->title, title_height, palette::gray, {left_edge, title_y}, Align::left)};
  double y = title_y + 0.2 * line_height;
  const auto add = [&](const std::string& line, double size, const Color& color) {
    labels.push_back(make_label(line, size, color, {left_edge, y += line_height}, Align::left));
    labels.back().tabular = size == figure_height;
  };
  std::vector<int> lines(books.size());  // used, below the first book of each place
  const auto add_below = [&](std::size_t b, const std::string& line, double size) {
    const auto first = std::find_if(books.begin(), books.end(),
                                    [&](const BookSetup& other) { return other.position_W == books[b].position_W; });
    const int used = lines[static_cast<std::size_t>(first - books.begin())]++;
    labels.push_back(make_label(line, size, palette::light, {0.0, used * line_height}));
    labels.back().anchor_W = name_anchor_W(*scene_, books[b]);
    labels.back().tabular = size == figure_height;
  };

  for (std::size_t b = 0; b < books.size(); ++b) {
    const std::optional<int>& exploded = trajectory_->books[b].exploded_frame;
    if (!exploded || frame < *exploded) continue;
    add(fmt::format("{}{}exploded at t = {:.4g}", books[b].name, books[b].name.empty() ? "" : " ",
                    *exploded * scene_->clip.time_per_frame),
        title_height, palette::yellow);
  }
  if (!scene_->view.head_up.empty()) {
    add(fmt::format("t {:.1f}", std::min(frame, last_moving_frame_) * scene_->clip.time_per_frame), figure_height,
        palette::light);
  }
  const bool one =
      std::count_if(books.begin(), books.end(), [](const BookSetup& book) { return book.style == Style::solid; }) <= 1;
  for (std::size_t b = 0; b < books.size(); ++b) {
    if (!books[b].name.empty()) add_below(b, books[b].name, name_height);
    if (books[b].style == Style::ghost && books.size() > 1) continue;
    for (const Q q : scene_->view.head_up) {
      const std::string figure = head_up_text(quantity(q), trajectory_->books[b].shown(frame)[q]);
      if (one) {
        add(figure, figure_height, palette::light);
      } else {
        add_below(b, figure, figure_height);
      }
    }
  }
  return labels;
}

std::vector<std::string> lacking_characters(const Scene& scene) {
  const TextPainter painter;
  std::vector<std::string> result;
  const auto look = [&](const std::string& place, const std::string& text) {
    const std::vector<std::string> lacking = painter.lacks(text);
    if (!lacking.empty()) result.push_back(fmt::format("{}: '{}'", place, fmt::join(lacking, "', '")));
  };
  look("title", scene.title);
  for (std::size_t b = 0; b < scene.books.size(); ++b) look(fmt::format("book.{}.name", b), scene.books[b].name);
  return result;
}

}  // namespace bookspin
