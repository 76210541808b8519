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
  Part part(file);
  write_part(part, write);
  publish({&part});
}

void write_part(const Part& part, const std::function<void(std::ostream&)>& write) {
  std::ofstream out(part.path(), std::ios::binary);
  if (out) write(out);
  out.close();
  if (!out) fail(part.file(), "cannot be written", std::strerror(errno));
}

std::string readable_size(std::uintmax_t bytes) {
  const double kilobytes = static_cast<double>(bytes) / 1e3;
  return kilobytes < 999.5 ? fmt::format("{:.0f} kB", kilobytes) : fmt::format("{:.1f} MB", kilobytes / 1e3);
}

}  // namespace bookspin
