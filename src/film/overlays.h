// What a script can have drawn with a book, as things of a Shot: arrows, the trace of the spin axis, springs, labels.
//
// Lengths follow the book: an arrow of full length reaches beyond its corners. The angular momentum's is in proportion
// to its length at the start, and so is the angular velocity's: one that shrinks is seen to shrink. All positions are
// W.
#pragma once

#include <string>

#include "render/shot.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

// Okabe and Ito's colours, told apart by every kind of colour vision.
namespace palette {
inline constexpr Color orange{230, 159, 0, 255};
inline constexpr Color sky{86, 180, 233, 255};
inline constexpr Color green{0, 158, 115, 255};
inline constexpr Color yellow{240, 228, 66, 255};
inline constexpr Color vermilion{213, 94, 0, 255};
inline constexpr Color purple{204, 121, 167, 255};
inline constexpr Color light{236, 239, 244, 255};
inline constexpr Color grey{150, 160, 175, 255};
}  // namespace palette

[[nodiscard]] Label make_label(const std::string& text, double height, const Color& color,
                               const Eigen::Vector2d& position, Align align = Align::center);

// Everything that setup.show asks for, at one film frame.
void add_overlays(Shot& shot, const BookSetup& setup, const BookTrack& track, int frame);

// How far the overlays of setup.show reach from the book's centre in any frame; 0: there are none.
[[nodiscard]] double overlay_reach(const BookSetup& setup);

// "E/E₀ 1.003", for the head-up line.
[[nodiscard]] std::string head_up_text(const Quantity& quantity, const BookFrame& frame);

}  // namespace bookspin
