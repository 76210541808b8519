#include "video/libav.h"

#include <array>
#include <cstdarg>
#include <new>
#include <stdexcept>
#include <string>

namespace bookspin {
namespace {

// A C callback without a user pointer leaves no other place; every encoder runs in its writer's thread alone.
thread_local std::string last_error_line;

void keep_last_error(void* source, int level, const char* format, va_list arguments) {
  if (level > AV_LOG_ERROR) return;
  std::array<char, 512> line{};
  int print_prefix = 0;  // it would hold an address
  av_log_format_line2(source, level, format, arguments, line.data(), static_cast<int>(line.size()), &print_prefix);
  try {
    last_error_line = line.data();
  } catch (const std::bad_alloc&) {
    last_error_line.clear();
  }
  while (last_error_line.ends_with('\n')) last_error_line.pop_back();
}

}  // namespace

void capture_libav_log() {
  [[maybe_unused]] static const bool installed = (av_log_set_callback(keep_last_error), true);
  last_error_line.clear();
}

void throw_libav_error(const std::filesystem::path& file, std::string_view operation, int code) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(code, text.data(), text.size());
  std::string message = file.string() + ": " + std::string(operation) + ": " + text.data();
  if (!last_error_line.empty()) message += " (" + last_error_line + ")";
  throw std::runtime_error(message);
}

}  // namespace bookspin
