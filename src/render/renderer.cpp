#include "render/renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cstddef>
#include <exception>
#include <optional>
#include <vector>

#include "render/area.h"
#include "render/arrows_and_lines.h"
#include "render/bend.h"
#include "render/books.h"
#include "render/camera.h"
#include "render/context.h"
#include "render/frame_buffer.h"
#include "render/strokes.h"
#include "render/text.h"

namespace bookspin {
namespace {

constexpr double margin_px = 2;  // what rounding in single precision may move, and a pixel's samples reach

// Which pixels each item of a shot may touch; empty for an item that is not drawn.
struct Footprint {
  std::vector<Rect> books, arrows, lines;
  std::vector<std::vector<Eigen::Vector2d>> outlines;  // of the books: points whose hull it is, or none
  std::vector<TextLayout> labels;
  bool needs_depth = false;  // something may hide something else
};

void copy(const Image& from, const Rect& area, Image& to) {
  for (int y = area.y; y < area.y + area.height; ++y) {
    std::copy_n(from.pixel(area.x, y), 4 * static_cast<std::size_t>(area.width), to.pixel(area.x, y));
  }
}

}  // namespace

struct Renderer::Parts {
  // In this order: everything below needs the context.
  Context context;
  FrameBuffer frame_buffer;
  BookPainter books;
  ArrowAndLinePainter arrows_and_lines;
  TextPainter text;
  Image scene;    // without labels
  Image picture;  // with them
  std::optional<Shot> shot;
  Footprint footprint;
  std::vector<Rect> changed;

  Parts(int width, int height, const std::filesystem::path& assets, ContextKind kind)
      : context(kind),
        frame_buffer(context.gl(), width, height),
        books(context.gl(), assets),
        arrows_and_lines(context.gl(), assets),
        scene(width, height),
        picture(width, height) {}

  ~Parts() {
    try {
      context.make_current();  // the handles delete their objects in it
    } catch (const std::exception&) {
      return;  // then the objects go with the context
    }
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  Footprint find_footprint(const Shot& next, const View& view);
  void draw_scene(const Shot& next, const Footprint& next_footprint, const View& view, const std::vector<Rect>& areas);
  void compose(const Footprint& next_footprint, const Rect& area);
  void draw(const Shot& next);
};

Footprint Renderer::Parts::find_footprint(const Shot& next, const View& view) {
  Footprint result;
  const auto bounds = [&](auto&& points, const Eigen::Vector2d& shift, double margin) {
    const bool drawable = std::ranges::all_of(points, [&](const auto& p) { return view.drawable(p); });
    return drawable ? view.shifted(shift).bounds(points, margin) : Rect{};
  };
  for (const BookPose& book : next.books) {
    std::array<Eigen::Vector3d, 8> corners;
    for (int i = 0; i < 8; ++i) corners[static_cast<std::size_t>(i)] = book.corners_W.col(i);
    result.books.push_back(bounds(corners, book.shift, margin_px));
    std::vector<Eigen::Vector2d>& outline = result.outlines.emplace_back();
    for (const Eigen::Vector3d& corner : corners) {
      const PixelPoint p = view.shifted(book.shift).project(corner);
      if (p.depth > view.near()) outline.emplace_back(p.x, p.y);
    }
    if (outline.size() < corners.size() || result.books.back().empty()) outline.clear();
  }
  for (const Arrow& arrow : next.arrows) result.arrows.push_back(bounds(arrow_hull(arrow), arrow.shift, margin_px));
  for (const Line& line : next.lines) {
    result.lines.push_back(bounds(std::array{line.from_W, line.to_W}, line.shift, margin_px + line.width_px));
  }
  result.needs_depth = !next.arrows.empty() || !next.lines.empty();
  for (std::size_t i = 0; i < next.books.size(); ++i) {
    if (result.books[i].empty()) continue;
    if (next.books[i].style == BookStyle::ghost || !is_unbent(next.books[i].corners_W)) result.needs_depth = true;
    for (std::size_t j = 0; j < i; ++j) {
      if (!intersection(result.books[i], result.books[j]).empty()) result.needs_depth = true;
    }
  }
  for (const Label& label : next.labels) result.labels.push_back(text.lay_out(label, view, scene.width, scene.height));
  return result;
}

void Renderer::Parts::draw_scene(const Shot& next, const Footprint& next_footprint, const View& view,
                                 const std::vector<Rect>& areas) {
  const auto touched = [&](const Rect& rect) {
    return std::ranges::any_of(areas, [&](const Rect& area) { return !intersection(rect, area).empty(); });
  };
  frame_buffer.begin(areas, next.background, next_footprint.needs_depth);
  for (std::size_t i = 0; i < next.books.size(); ++i) {
    const bool solid = next.books[i].style == BookStyle::solid;
    if (solid && touched(next_footprint.books[i]))
      books.draw_solid(view.shifted(next.books[i].shift), next.books[i], next_footprint.needs_depth);
  }
  for (std::size_t i = 0; i < next.arrows.size(); ++i) {
    if (touched(next_footprint.arrows[i])) arrows_and_lines.draw_arrow(view, next.arrows[i]);
  }
  std::vector<Line> lines;
  for (std::size_t i = 0; i < next.lines.size(); ++i) {
    if (touched(next_footprint.lines[i])) lines.push_back(next.lines[i]);
  }
  arrows_and_lines.draw_lines(view, lines);
  for (std::size_t i = 0; i < next.books.size(); ++i) {
    const bool ghost = next.books[i].style == BookStyle::ghost;
    if (ghost && touched(next_footprint.books[i]))
      books.draw_ghost(view.shifted(next.books[i].shift), next.books[i].corners_W);
  }
  frame_buffer.read(areas, scene);
}

void Renderer::Parts::compose(const Footprint& next_footprint, const Rect& area) {
  copy(scene, area, picture);
  for (const TextLayout& label : next_footprint.labels) TextPainter::draw(label, area, picture);
  if (!area.empty()) changed.push_back(area);
}

void Renderer::Parts::draw(const Shot& next) {
  changed = {};
  if (shot == next) return;
  const View view(next.camera, scene.width, scene.height);
  Footprint next_footprint = find_footprint(next, view);
  // With or without depth, an edge's samples may fall out differently.
  const bool first = !shot || shot->camera != next.camera || shot->background != next.background ||
                     footprint.needs_depth != next_footprint.needs_depth;

  Area area(scene.bounds());
  if (first) {
    area.add(scene.bounds());
  } else {
    // Where an item was, or is, that is not the same as before.
    const auto add_changes = [&](const auto& old_items, const auto& items, auto&& add) {
      for (std::size_t i = 0; i < std::max(old_items.size(), items.size()); ++i) {
        if (i < old_items.size() && i < items.size() && old_items[i] == items[i]) continue;
        if (i < old_items.size()) add(footprint, i);
        if (i < items.size()) add(next_footprint, i);
      }
    };
    add_changes(shot->books, next.books, [&](const Footprint& f, std::size_t i) {
      if (f.outlines[i].empty()) area.add(f.books[i]);
      area.add(f.outlines[i], margin_px);
    });
    add_changes(shot->arrows, next.arrows, [&](const Footprint& f, std::size_t i) { area.add(f.arrows[i]); });
    add_changes(shot->lines, next.lines, [&](const Footprint& f, std::size_t i) { area.add(f.lines[i]); });
  }
  const std::vector<Rect> areas = area.rects();
  if (!areas.empty()) {
    context.make_current();
    draw_scene(next, next_footprint, view, areas);
    for (const Rect& rect : areas) compose(next_footprint, rect);
  }
  if (!first) {
    for (std::size_t i = 0; i < std::max(shot->labels.size(), next.labels.size()); ++i) {
      if (i < shot->labels.size() && i < next.labels.size() && shot->labels[i] == next.labels[i]) continue;
      if (i < shot->labels.size()) compose(next_footprint, footprint.labels[i].bounds);
      if (i < next.labels.size()) compose(next_footprint, next_footprint.labels[i].bounds);
    }
  }
  footprint = std::move(next_footprint);
  shot = next;
}

Renderer::Renderer(int width, int height, const std::filesystem::path& assets, ContextKind kind) {
  assert(width > 0 && height > 0);
  parts_ = std::make_unique<Parts>(width, height, assets, kind);
}

Renderer::~Renderer() = default;

const Image& Renderer::draw(const Shot& shot) {
  parts_->draw(shot);
  return parts_->picture;
}

const std::vector<Rect>& Renderer::changed() const {
  return parts_->changed;
}

const std::string& Renderer::description() const {
  return parts_->context.description();
}

std::vector<std::filesystem::path> files_drawn_from(const std::filesystem::path& assets) {
  std::vector<std::filesystem::path> files;
  for (const char* folder : {"shaders", "textures"}) {
    for (const auto& entry : std::filesystem::directory_iterator(assets / folder)) {
      const std::filesystem::path extension = entry.path().extension();
      if (extension == ".vert" || extension == ".frag" || extension == ".png") files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  for (const std::string& font : font_files()) files.emplace_back(font);
  return files;
}

}  // namespace bookspin
