// PNG files in and out.
//
// write_png writes RGB when the picture is fully opaque, RGBA otherwise; the same image gives the same bytes. Written to a
// path it appears all at once, or what stood there stays; a Part is left for the caller to publish. All throw
// std::runtime_error naming the file, the operation and the reason.
#pragma once

#include <filesystem>
#include <string>

#include "files/part.h"
#include "image/image.h"

namespace bookspin {

[[nodiscard]] std::string png_version();  // of libpng

[[nodiscard]] Image read_png(const std::filesystem::path& path);
[[nodiscard]] Image parse_png(const std::string& bytes, const std::filesystem::path& name);  // name: for messages
void write_png(const std::filesystem::path& path, const Image& image);
void write_png(const Part& part, const Image& image);

}  // namespace bookspin
