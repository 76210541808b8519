#include "report/machine.h"

#include <fstream>
#include <thread>

#include "report/program.h"

namespace bookspin {
namespace {

// The first line that git answers; empty when it fails.
std::string git(const std::filesystem::path& project, std::vector<std::string> command) {
  command.insert(command.begin(), {"-C", project.string()});
  const Finished answer = run_program("git", command, "");
  return answer.status == 0 ? answer.out.substr(0, answer.out.find('\n')) : "";
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
  machine.commit = git(project, {"rev-parse", "--short=12", "HEAD"});
  if (machine.commit.empty()) {
    machine.commit = "unknown";
  } else if (!git(project, {"status", "--porcelain", "-uno"}).empty()) {
    machine.commit += "+";
  }
  return machine;
}

}  // namespace bookspin
