// The eight corners of the book: the one answer that every method gives, and all that the renderer draws.
//
// Corner i lies on the positive side of body axis d when bit d of i is set (i = 0 ... 7; d = 0: x, 1: y, 2: z), so a
// book is the trilinear image of the unit cube: a deformed book is a deformed set of corners.
// Frames: W world, B body; at the start the two coincide, but for what a script's orientation turns. The unit of length
// is the scene's own.
#pragma once

#include <Eigen/Core>

namespace bookspin {

using Corners = Eigen::Matrix<double, 3, 8>;  // column i: corner i

}  // namespace bookspin
