// The next smaller picture of a texture.
#pragma once

#include "image/image.h"

namespace bookspin {

// Half as wide and as high (rounded down, at least 1), each pixel the mean of four in linear light; opaque.
[[nodiscard]] Image halved(const Image& image);

}  // namespace bookspin
