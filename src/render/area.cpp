#include "render/area.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bookspin {
namespace {

constexpr int tile = 16;       // pixels: the software renderer works in tiles, and a part of one costs all of it
constexpr int band_rows = 64;  // of a band: fewer hold less, but each has its own calls

}  // namespace

Area::Area(const Rect& frame)
    : frame_(frame), bands_(static_cast<std::size_t>((frame.height + band_rows - 1) / band_rows), {frame.width, 0}) {}

void Area::widen(std::size_t band, double left, double right) {
  // Clamped before the conversion: a point far outside the frame does not fit into an int.
  const auto column = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, double(frame_.width))); };
  Columns& columns = bands_[band];
  columns.first = std::min(columns.first, column(std::floor(left)));
  columns.end = std::max(columns.end, column(std::ceil(right)));
}

void Area::add(const Rect& rect) {
  const Rect part = intersection(rect, frame_);
  if (part.empty()) return;
  for (int band = part.y / band_rows; band <= (part.y + part.height - 1) / band_rows; ++band) {
    widen(static_cast<std::size_t>(band), part.x, part.x + part.width);
  }
}

void Area::add(std::span<const Eigen::Vector2d> points, double margin_px) {
  // In a band the hull is as wide as the widest of the lines between its points are there.
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const bool down = points[j].y() < points[i].y();
      const Eigen::Vector2d &a = points[down ? j : i], &b = points[down ? i : j];
      const double slope = b.y() > a.y() ? (b.x() - a.x()) / (b.y() - a.y()) : 0;
      for (std::size_t band = 0; band < bands_.size(); ++band) {
        const double top = static_cast<double>(band_rows * band) - margin_px, bottom = top + band_rows + 2 * margin_px;
        if (b.y() < top || a.y() > bottom) continue;
        const double from = a.y() < top ? a.x() + slope * (top - a.y()) : a.x();
        const double to = b.y() > bottom ? b.x() - slope * (b.y() - bottom) : b.x();
        widen(band, std::min(from, to) - margin_px, std::max(from, to) + margin_px);
      }
    }
  }
}

std::vector<Rect> Area::rects() const {
  std::vector<Rect> result;
  for (std::size_t band = 0; band < bands_.size(); ++band) {
    const int first = bands_[band].first / tile * tile, end = (bands_[band].end + tile - 1) / tile * tile;
    const Rect rect = intersection({first, band_rows * static_cast<int>(band), end - first, band_rows}, frame_);
    if (end > first && !rect.empty()) result.push_back(rect);
  }
  return result;
}

}  // namespace bookspin
