// Which files of a folder are the program's own, and whether they are as they were made.
//
// A folder's list is its file "bookspin.sha256", as `sha256sum --check` reads it: one line a file, "DIGEST  NAME", by
// name; a name with a newline or a backslash is escaped, and the line then starts with a backslash. Lines that are not
// of this form are passed over. Versions before 1.1 wrote no lists: their files are known by what they hold. Source: GNU
// coreutils (the form).
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace bookspin {

inline constexpr const char* checksums_name = "bookspin.sha256";

using Checksums = std::map<std::string, std::string>;  // file name -> digest

// 64 hexadecimal digits.
[[nodiscard]] std::string sha256(const std::string& bytes);
[[nodiscard]] std::string sha256_of(const std::filesystem::path& file);

[[nodiscard]] Checksums parse_checksums(std::string_view text);
[[nodiscard]] std::string text_of(const Checksums& checksums);

// Nothing for a folder without a list.
[[nodiscard]] Checksums read_checksums(const std::filesystem::path& folder);

// Whether the file is there, listed, and has the bytes that it had when it was made.
[[nodiscard]] bool is_as_listed(const Checksums& listed, const std::filesystem::path& file);

// Whether the file is the program's own: listed, or made by a version that wrote no lists: a film's data, by their first
// and their outermost keys; film, poster and captions beside such data that name them; course page and report.
[[nodiscard]] bool is_own(const Checksums& listed, const std::filesystem::path& file);

}  // namespace bookspin
