// What of a picture is to be drawn again: in each band of rows, from which column to which. So of a book that lies
// askew much less than the rectangle about it.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "image/rect.h"

namespace bookspin {

class Area {
 public:
  explicit Area(const Rect& frame);

  void add(const Rect& rect);
  void add(std::span<const Eigen::Vector2d> points, double margin_px);  // their convex hull, so much larger
  // Of whole tiles, one a band at most, from top to bottom; empty ones are left out.
  [[nodiscard]] std::vector<Rect> rects() const;

 private:
  struct Columns {
    int first, end;
  };
  void widen(std::size_t band, double left, double right);

  Rect frame_;
  std::vector<Columns> bands_;
};

}  // namespace bookspin
