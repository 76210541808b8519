// A book in the picture and what a script can have drawn with it, as things of a Shot: arrows, the trace of the spin
// axis, springs, ghosts, labels.
//
// Lengths follow the book: an arrow of full length reaches beyond its corners. The angular momentum's is in proportion
// to its length at the start, and so is the angular velocity's: one that shrinks is seen to shrink. All is in the world
// frame, about the book's own center. A new overlay is a word in Overlay and its name (scene/scene.h), and a function
// and a row in overlays.cpp.
#pragma once

#include <string>
#include <vector>

#include "render/shot.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

[[nodiscard]] Label make_label(const std::string& text, double height, const Color& color,
                               const Eigen::Vector2d& position, Align align = Align::center);

// The corners as the hardcover's: the cover lies on the largest face, the spine along its longer edge.
[[nodiscard]] Corners as_bound(const BookSetup& setup, const Corners& corners_W);

// At one frame: the book, unless it is gone, and everything that setup.show asks for, moved by `shift` (shot.h). A book
// that has exploded is so large, and turns so fast, that it would flash: it is dimmed within a fifth of a second. Of one
// that is gone the ghosts stay. The shot's camera must be there: of the polhode's lines those behind are paler.
void add_book(Shot& shot, const BookSetup& setup, const BookTrack& track, int frame, int fps, bool gone,
              const Eigen::Vector2d& shift);

// How far below its center the book and what is drawn around it reach.
[[nodiscard]] double reach_below(const BookSetup& setup);

struct Sphere {
  Eigen::Vector3d center_W;
  double radius;
};

// Spheres that hold what setup.show asks for, beyond the book itself, in every frame.
[[nodiscard]] std::vector<Sphere> overlay_reach(const BookSetup& setup, const BookTrack& track);

}  // namespace bookspin
