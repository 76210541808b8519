#include "files/files.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace bookspin {
namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& file, std::string_view operation, std::string_view reason) {
  throw std::runtime_error(fmt::format("{}: {}: {}", file.string(), operation, reason));
}

// Gone when it is left: by an error, or because it has been renamed.
struct Part {
  fs::path file;
  ~Part() {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
};

}  // namespace

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, "cannot be read", std::strerror(errno));
  if (fs::is_directory(file)) fail(file, "cannot be read", "is a folder");
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_file(const fs::path& file, std::string_view text) {
  write_file(file, [text](std::ostream& out) { out << text; });
}

void write_file(const fs::path& file, const std::function<void(std::ostream&)>& write) {
  const Part part{file.string() + ".part"};
  std::ofstream out(part.file, std::ios::binary);
  if (!out) fail(file, "cannot be opened for writing", std::strerror(errno));
  write(out);
  out.close();
  if (!out) fail(file, "cannot be written", std::strerror(errno));
  std::error_code error;
  fs::rename(part.file, file, error);
  if (error) fail(file, "cannot be renamed", error.message());
}

std::string readable_size(std::uintmax_t bytes) {
  const double kilobytes = static_cast<double>(bytes) / 1e3;
  return kilobytes < 999.5 ? fmt::format("{:.0f} kB", kilobytes) : fmt::format("{:.1f} MB", kilobytes / 1e3);
}

}  // namespace bookspin
