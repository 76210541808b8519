// What a command line can say: the table of commands, each with its options, which are declared and read here.
//
// CLI11 reads the words, and throws a CLI::ParseError that names the option, what was found and what is allowed. A
// default is what stands in Options.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <vector>

namespace bookspin {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;  // KEY=VALUE
  std::string folder;                  // empty: the command's default
  std::string output;                  // empty: standard output
  std::string assets;                  // empty: found (assets.h)
  int width = 1280;                    // pixels
  int height = 720;                    // pixels
  std::string format = "mp4";
  int first_frame = 0;
  std::optional<int> end_frame;  // the first one not drawn; none: all to the end
  int frame = 0;
  int jobs = 0;         // 0: one a core
  double error = 1e-6;  // radians
  bool update = false;
  bool quick = false;
  std::string topic;                  // of help and completion
  std::vector<std::string> pictures;  // two
  std::optional<int> max_delta;       // levels
  std::optional<double> mean_delta;   // levels
  std::optional<double> share;        // of pixels, 0 ... 1
  int threshold = 0;                  // levels; what counts for share
  std::stop_token stop;               // requested: the command throws Stopped soon
  const CLI::App* program = nullptr;  // all that can be said
};

// A call that cannot be meant, whatever the files hold: exit code 2. What only a script shows to be wrong, such as a
// frame that it does not have, is 1, like all that is not made.
struct WrongCall : std::invalid_argument {
  using invalid_argument::invalid_argument;
};

using Declare = std::function<void(CLI::App& command, Options& options)>;

struct Command {
  const char* name;
  const char* help;
  std::vector<Declare> declare;
  int (*run)(const Options&);
  const char* examples;
};

extern const std::vector<Command> commands;

void declare_commands(CLI::App& program, Options& options);

}  // namespace bookspin
