#include "film/storyboard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "film/framing.h"
#include "film/overlays.h"
#include "image/color.h"
#include "render/camera.h"
#include "render/text.h"

namespace bookspin {
namespace {

constexpr double middle_band = 0.88;  // of the height: above it stands the title, below it the figures
constexpr double lowest_line = 0.98;  // base line of the figures, frame heights; a smaller band heeds it
constexpr double name_offset = 0.16;  // of a name below its book's lowest, in lengths of its half diagonal
constexpr double left_edge = 0.03;    // of the title and what stands below it, in frame widths
constexpr double title_y = 0.07;      // base line; this and all below in frame heights
constexpr double title_height = 0.04;
constexpr double name_height = 0.042;
constexpr double figure_height = 0.035;
constexpr double line_height = 0.05;
constexpr double rim_px = 1.5;     // of the smallest text, beyond either end of its line
constexpr double name_gap = 0.06;  // between texts below two books in a row, in those of their distance

// Below the book in the picture: along the camera's down, not the world's.
Eigen::Vector3d name_anchor_W(const Scene& scene, const BookSetup& setup) {
  const Eigen::Vector3d up_W = camera_axes(scene.view.from).row(1).transpose();
  return -up_W * (reach_below(setup) + name_offset * body_of(setup.options).reach);
}

// "E/E₀ 1.003"
std::string head_up_text(const Quantity& q, double value) {
  return fmt::format("{} {}", q.symbol, std::isfinite(value) ? fmt::format(fmt::runtime(q.format), value) : "–");
}

}  // namespace

Storyboard::Storyboard(const Scene& scene, const Trajectory& trajectory, int width, int height)
    : scene_(&scene),
      trajectory_(&trajectory),
      last_frames_(scene.books.size(), scene.clip.frames - 1),
      doubts_(doubts_about(scene, trajectory)) {
  const Eigen::Matrix3d R_CW = camera_axes(scene.view.from);
  std::vector<Stand> stands;
  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const BookSetup& setup = scene.books[b];
    const BookTrack& track = trajectory.books[b];
    const double unit = body_of(setup.options).reach;
    double farthest = 1.0;
    for (const BookFrame& f : track.frames) farthest = std::max(farthest, f[Q::extent]);
    if (track.exploded_frame) farthest = std::min(farthest, healthy_extent);
    stands.push_back({(R_CW * setup.position_W).head<2>(), overlay_reach(setup, track)});
    stands.back().spheres.push_back({Eigen::Vector3d::Zero(), farthest * unit});
    if (!setup.name.empty()) stands.back().spheres.push_back({name_anchor_W(scene, setup), 0.1 * unit});
  }

  const double aspect = static_cast<double>(width) / height;
  camera_.vertical_fov = film_fov;
  double lowest = 1.0;
  for (double band = middle_band; lowest > lowest_line && band > 0.3; band -= 0.02) {
    const double distance = distance_that_frames(stands, R_CW, aspect, band);
    camera_.eye_W = distance * R_CW.row(2).transpose();
    const Eigen::Vector2d middle = picture_of(stands, R_CW, distance).center();
    shifts_.clear();
    for (const Stand& stand : stands) shifts_.push_back(shift_of(stand, distance, middle));
    lowest = 0.0;
    for (const Label& label : text(0)) {
      if (!label.anchor_W) continue;
      lowest = std::max(lowest, View(camera_, width, height).project(*label.anchor_W).y / height + label.position.y());
    }
  }

  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const std::vector<BookFrame>& frames = trajectory.books[b].frames;
    const double too_near = camera_.eye_W.norm() / body_of(scene.books[b].options).reach;
    const auto gone = [&](const BookFrame& f) { return is_gone(f, too_near); };
    last_frames_[b] = static_cast<int>(std::find_if(frames.begin(), frames.end(), gone) - frames.begin()) - 1;
  }
  fit_text(width, height);
}

int Storyboard::frames() const {
  const int last = *std::max_element(last_frames_.begin(), last_frames_.end());
  return std::min(scene_->clip.frames, last + 1 + scene_->clip.fps);
}

void Storyboard::fit_text(int width, int height) {
  TextPainter painter;
  const View view(camera_, width, height);
  // Below a book: to the picture's nearer edge, and half way to the next book of the row.
  const auto place = [&](const Eigen::Vector3d& anchor_W, const Eigen::Vector2d& shift) {
    const PixelPoint p = view.project(anchor_W);
    return Eigen::Vector2d(p.x + shift.x() * height, p.y + shift.y() * height);
  };
  const auto room = [&](const Label& label) {
    if (!label.anchor_W) return (1.0 - 2.0 * left_edge) * width;
    const Eigen::Vector2d here = place(*label.anchor_W, label.position);
    double half = std::min(here.x(), width - here.x());
    for (std::size_t b = 0; b < shifts_.size(); ++b) {
      const Eigen::Vector2d there = place(name_anchor_W(*scene_, scene_->books[b]), shifts_[b]);
      const double apart = std::abs(there.x() - here.x());
      const bool in_row = std::abs(there.y() - here.y()) < 3.0 * line_height * height;
      if (in_row && apart > 0.5 * line_height * height) half = std::min(half, 0.5 * apart);
    }
    return 2.0 * ((1.0 - name_gap) * half - rim_px);
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
    add_book(shot, scene_->books[b], trajectory_->books[b], frame, scene_->clip.fps, frame > last_frames_[b],
             shifts_[b]);
  }
  for (Label& label : text(frame)) {
    label.height = set_height_.at(label.height);
    shot.labels.push_back(std::move(label));
  }
  return shot;
}

// From the top left down: title, explosions, the time and the figures that the script names; of several books below
// each, with its name; and how far off a book is that nothing else would say it of. Never at the bottom left, where a
// browser's controls lie over them.
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
    labels.push_back(make_label(line, size, palette::light, shifts_[b] + Eigen::Vector2d(0.0, used * line_height)));
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
    add(fmt::format("t {:.1f}", frame * scene_->clip.time_per_frame), figure_height, palette::light);
    for (const Doubt& doubt : doubts_) {
      if (frame < doubt.frame) continue;
      const std::string& name = books[doubt.book].name;
      const BookFrame& now = trajectory_->books[doubt.book].frames[static_cast<std::size_t>(frame)];
      add(fmt::format("{}{}{}", name, name.empty() ? "" : " ",
                      head_up_text(quantity(Q::angle_error), now[Q::angle_error])),
          figure_height, palette::yellow);
    }
  }
  const bool one =
      std::count_if(books.begin(), books.end(), [](const BookSetup& book) { return book.style == Style::solid; }) <= 1;
  for (std::size_t b = 0; b < books.size(); ++b) {
    if (!books[b].name.empty()) add_below(b, books[b].name, name_height);
    if (books[b].style == Style::ghost && books.size() > 1) continue;
    const BookFrame& now = trajectory_->books[b].frames[static_cast<std::size_t>(std::min(frame, last_frames_[b]))];
    for (const Q q : scene_->view.head_up) {
      const std::string figure = head_up_text(quantity(q), now[q]);
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
