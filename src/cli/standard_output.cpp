#include "cli/standard_output.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <string>

namespace bookspin {
namespace {

[[noreturn]] void fail() {
  throw std::runtime_error(std::string("standard output: cannot be written: ") + std::strerror(errno));
}

std::string without_controls(std::string_view text) {
  std::string shown;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    // U+0080 to U+009F, in UTF-8, are controls, too.
    const bool is_c1 = byte == 0xc2 && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    const bool is_c0 = (byte < 0x20 && byte != '\n' && byte != '\t') || byte == 0x7f;
    if (is_c1) ++i;
    shown += is_c0 || is_c1 ? '?' : text[i];
  }
  return shown;
}

}  // namespace

void reserve_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    // The lowest free number is this one; what is written to a file open for reading fails as it does to a closed one.
    if (fcntl(stream, F_GETFD) == -1 && open("/dev/null", O_RDONLY) == -1) return;
  }
}

void complain(std::string_view what) {
  std::fputs(("bookspin: " + without_controls(what) + '\n').c_str(), stderr);
  std::fflush(stderr);
}

void print(std::string_view text) {
  print_data(without_controls(text));
}

void print_data(std::string_view data) {
  if (std::fwrite(data.data(), 1, data.size(), stdout) != data.size()) fail();
}

void finish_output() {
  std::cout.flush();  // CLI11's help goes this way
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0 || !std::cout) fail();
}

}  // namespace bookspin
