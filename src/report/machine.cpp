#include "report/machine.h"

#include <cstdio>
#include <fstream>
#include <memory>
#include <thread>

namespace bookspin {
namespace {

std::string first_line_of(const std::string& command) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string line;
  if (!pipe) return line;
  for (int c = std::fgetc(pipe.get()); c != EOF && c != '\n'; c = std::fgetc(pipe.get())) line += static_cast<char>(c);
  return line;
}

}  // namespace

Machine this_machine(const std::filesystem::path& project) {
  Machine machine{"unknown processor", static_cast<int>(std::thread::hardware_concurrency()), BOOKSPIN_COMPILER,
                  BOOKSPIN_FLAGS, ""};
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    if (line.starts_with("model name")) {
      machine.processor = line.substr(line.find(':') + 2);
      break;
    }
  }
  const std::string git = "git -C '" + project.string() + "' ";
  machine.commit = first_line_of(git + "rev-parse --short=12 HEAD 2>/dev/null");
  if (machine.commit.empty()) {
    machine.commit = "unknown";
  } else if (!first_line_of(git + "status --porcelain -uno 2>/dev/null").empty()) {
    machine.commit += "+";
  }
  return machine;
}

}  // namespace bookspin
