// What a command line can say, and how each option is declared and read.
//
// A declaration adds its option to a command; CLI11 then reads the words, and throws a CLI::ParseError that names the
// option, what was found and what is allowed. A default is what stands in Options.
#pragma once

#include <CLI/CLI.hpp>
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
  int first_frame = 0;
  std::optional<int> end_frame;  // the first one not drawn; none: all to the end
  int frame = 0;
  int jobs = 0;  // 0: one a core
  bool update = false;
  bool quick = false;
  std::string topic;
  std::vector<std::string> pictures;  // two
  std::optional<int> max_delta;       // levels
  std::optional<double> mean_delta;   // levels
  std::optional<double> share;        // of pixels, 0 ... 1
  int threshold = 0;                  // levels; what counts for share
  std::stop_token stop;               // requested: the command throws Stopped soon
};

// A call that cannot be meant, found after the words were read: exit code 2.
struct WrongCall : std::invalid_argument {
  using invalid_argument::invalid_argument;
};

using Declare = void (*)(CLI::App& command, Options& options);

void scene_argument(CLI::App& command, Options& options);
void scenes_argument(CLI::App& command, Options& options);
void scripts_folder(CLI::App& command, Options& options);
void site_folder(CLI::App& command, Options& options);
void films_output(CLI::App& command, Options& options);
void report_output(CLI::App& command, Options& options);
void picture_output(CLI::App& command, Options& options);
void table_output(CLI::App& command, Options& options);
void size_option(CLI::App& command, Options& options);
void frames_option(CLI::App& command, Options& options);
void frame_option(CLI::App& command, Options& options);
void jobs_option(CLI::App& command, Options& options);
void update_flag(CLI::App& command, Options& options);
void quick_flag(CLI::App& command, Options& options);
void set_option(CLI::App& command, Options& options);
void assets_option(CLI::App& command, Options& options);
void topic_argument(CLI::App& command, Options& options);
void pictures_argument(CLI::App& command, Options& options);
void bounds_options(CLI::App& command, Options& options);
void delta_output(CLI::App& command, Options& options);

}  // namespace bookspin
