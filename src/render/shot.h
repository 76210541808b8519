// What one frame shows: plain data, equal shots give equal pictures.
//
// W is the world frame (the scene's unit of length), its +y up in the picture. Colors are sRGB as one would write them
// in a style sheet; alpha is straight. Items are drawn in this order: solid books, arrows, lines, then ghosts
// (translucent), then labels. All hide one another by depth, but for a ghost's edges, which shine through, and labels.
// A book, arrow or line with a coordinate that is not finite, or beyond 1e6 camera distances, is not drawn.
// shift moves an item's picture right and down, in frame heights, to whole pixels: books side by side, each seen by the
// same camera, look alike when their poses are.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/corners.h"
#include "image/color.h"

namespace bookspin {

struct Camera {
  Eigen::Vector3d eye_W{0, 0, 8};     // never straight above or below the target
  Eigen::Vector3d target_W{0, 0, 0};  // seen in the middle of the picture
  double vertical_fov = 0.5236;       // radians
  bool operator==(const Camera&) const = default;
};

enum class BookStyle { solid, ghost };

struct BookPose {
  Corners corners_W = Corners::Zero();
  BookStyle style = BookStyle::solid;
  Eigen::Vector2d shift{0, 0};
  double brightness = 1;  // of a solid book, 0 ... 1
  bool operator==(const BookPose&) const = default;
};

struct Arrow {
  Eigen::Vector3d from_W{0, 0, 0};
  Eigen::Vector3d to_W{0, 0, 0};  // the tip
  Color color;                    // always opaque
  double radius = 0.02;           // of the shaft, world units
  Eigen::Vector2d shift{0, 0};
  bool operator==(const Arrow&) const = default;
};

struct Line {
  Eigen::Vector3d from_W{0, 0, 0};
  Eigen::Vector3d to_W{0, 0, 0};
  Color color;
  double width_px = 2;  // pixels
  Eigen::Vector2d shift{0, 0};
  bool operator==(const Line&) const = default;
};

enum class Align { left, center, right };
enum class Weight { regular, semibold };

struct Label {
  std::string text;  // UTF-8, one line
  Eigen::Vector2d position{0.5,
                           0.5};  // of the base line's left end, middle or right end: fractions of the frame's width
                                  // and height from the top left; with an anchor, an offset from it in frame heights
  std::optional<Eigen::Vector3d> anchor_W;  // a point that the label follows
  double height = 0.04;                     // of the line, as a fraction of the frame's height
  Color color{236, 239, 244, 255};
  Align align = Align::left;
  Weight weight = Weight::regular;
  bool tabular = false;  // all digits as wide as the widest: figures that change do not jitter
  bool operator==(const Label&) const = default;
};

struct Shot {
  Camera camera;
  Color background{32, 39, 49, 255};
  std::vector<BookPose> books;
  std::vector<Arrow> arrows;
  std::vector<Line> lines;
  std::vector<Label> labels;
  bool operator==(const Shot&) const = default;
};

}  // namespace bookspin
