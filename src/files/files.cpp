#include "files/files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "files/descriptor.h"

namespace bookspin {
namespace fs = std::filesystem;

void throw_file_error(const fs::path& file, std::string_view what_failed, std::string_view reason) {
  const std::string text = reason.empty() ? std::strerror(errno) : std::string(reason);
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), what_failed, text));
}

bool is_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::none && error != std::errc::too_many_symbolic_link_levels)
    throw_file_error(path, "cannot be looked at", error.message());
  return fs::is_regular_file(status);
}

std::string read_file(const fs::path& file) {
  std::error_code error;
  const fs::file_type type = fs::status(file, error).type();
  if (type == fs::file_type::regular || type == fs::file_type::not_found) return read_file_or_pipe(file);
  throw_file_error(file, "cannot be read", type == fs::file_type::directory ? "is a folder" : "is not a regular file");
}

std::string read_file_or_pipe(const fs::path& file) {
  constexpr std::size_t most = std::size_t{256} << 20U;
  constexpr std::size_t at_once = 65536;
  const Descriptor in(open(file.c_str(), O_RDONLY | O_CLOEXEC));
  std::string text;
  ssize_t count = in.number < 0 ? -1 : 1;
  while (count > 0 && text.size() <= most) {
    const std::size_t so_far = text.size();
    text.resize(so_far + at_once);
    count = read(in.number, text.data() + so_far, at_once);
    text.resize(so_far + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
  }
  if (count < 0) throw_file_error(file, "cannot be read", errno == EISDIR ? "is a folder" : "");
  if (text.size() > most) throw_file_error(file, "cannot be read", "is larger than 256 MiB");
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw_file_error(folder, "cannot be made", error.message());
}

void write_part(const Part& part, std::string_view text) {
  write_part(part, [text](std::ostream& out) { out << text; });
}

void write_part(const Part& part, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(part.path(), std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out) throw_file_error(part.shown(), "cannot be written");
}

std::string readable_size(std::uintmax_t bytes) {
  const double kilobytes = static_cast<double>(bytes) / 1e3;
  return kilobytes < 999.5 ? fmt::format("{:.0f} kB", kilobytes) : fmt::format("{:.1f} MB", kilobytes / 1e3);
}

}  // namespace bookspin
