// PNG files in and out.
//
// write_png writes RGB when the picture is fully opaque, RGBA otherwise, and appears all at once: the bytes go to path
// + ".part", which is flushed to disk and then renamed; on any error the partial file is removed and what stood at path
// stays. The same image gives the same bytes. Both throw std::runtime_error naming the file, the operation and the
// reason.
#pragma once

#include <filesystem>

#include "image/image.h"

namespace bookspin {

Image read_png(const std::filesystem::path& path);
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace bookspin
