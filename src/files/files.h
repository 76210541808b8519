// Whole files: read at once, or written so that a name never stands for half a file.
//
// A file grows as a Part (part.h) and is renamed when it is complete: on any error what stood under the name survives.
// All throw std::runtime_error "FILE: what failed: the system's reason".
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "files/part.h"

namespace bookspin {

// Without a reason: the system's own, of now.
[[noreturn]] void throw_file_error(const std::filesystem::path& file, std::string_view what_failed,
                                   std::string_view reason = {});

// A regular file or a link to one; a link to itself is none.
[[nodiscard]] bool is_file(const std::filesystem::path& path);

// A regular file, of at most 256 MiB: nothing that bookspin reads whole is larger.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

// The same; of a FIFO or a device what it says until it ends. A signal that is handled ends the wait for it.
[[nodiscard]] std::string read_file_or_pipe(const std::filesystem::path& file);

// Those above it too; it may be there.
void make_folder(const std::filesystem::path& folder);

// All that a part will hold; not yet published. What is too long to hold is streamed.
void write_part(const Part& part, std::string_view text);
void write_part(const Part& part, const std::function<void(std::ostream&)>& write);

// "412 kB", "3.1 MB".
[[nodiscard]] std::string readable_size(std::uintmax_t bytes);

}  // namespace bookspin
