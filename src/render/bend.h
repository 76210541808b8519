// Whether a deformed book still looks convex.
#pragma once

#include "dynamics/corners.h"

namespace bookspin {

// The winding seen on the screen holds only where the map keeps its orientation: everywhere, if it does so at the
// corners of a book that is not badly bent. Otherwise depth alone decides what is seen.
[[nodiscard]] bool keeps_orientation(const Corners& corners);

// Whether the map of the corners is so nearly affine, and keeps its orientation, that the book looks convex from
// everywhere.
[[nodiscard]] bool is_unbent(const Corners& corners);

}  // namespace bookspin
