// bookspin: parse, call, one catch, exit code. 0: everything was made and every expectation met; 1: not so; 2: a wrong
// call; 128 + N: stopped by signal N.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/standard_output.h"
#include "cli/version.h"
#include "cli/watch.h"
#include "scene/did_you_mean.h"
#include "scene/reference.h"

namespace bookspin {
namespace {

constexpr const char* about =
    "Films of a tumbling book: scene scripts (TOML) -> MP4, and the numbers behind them.\n"
    "The paper's figures come with it; `bookspin list` shows them.";
constexpr const char* exit_codes =
    "Exit code: 0 when everything was made and every expectation met, 1 when not, 2 for a wrong call,\n"
    "128 + N when signal N has stopped it.";

struct Command {
  const char* name;
  const char* help;
  std::vector<Declare> options;
  int (*run)(const Options&);
  const char* examples;
};

const std::vector<Command> commands{
    {"list",
     "Show the scene scripts of a folder",
     {scripts_folder, assets_option, set_option},
     list_scenes,
     "Example:\n  bookspin list videos"},
    {"render",
     "Make films, with poster and data beside each",
     {scenes_argument, films_output, size_option, frames_option, jobs_option, update_flag, set_option, assets_option},
     render_scenes,
     "Examples:\n  bookspin render videos/fig05_unstable_x.toml -o films\n"
     "  bookspin render my.toml --size 640x360 --frames 0:120 --set book.0.jiggle=0.01"},
    {"frame",
     "Draw one frame as a PNG",
     {scene_argument, frame_option, picture_output, size_option, set_option, assets_option},
     draw_scene_frame,
     "Example:\n  bookspin frame videos/fig05_unstable_x.toml --frame 450 -o flipping.png"},
    {"check",
     "Simulate and judge every expectation, without drawing",
     {scenes_argument, set_option},
     check_scenes,
     "Example:\n  bookspin check videos/*.toml"},
    {"trajectory",
     "Write the motion as CSV: corners, orientation, L, omega, and every quantity",
     {scene_argument, table_output, set_option},
     write_trajectory,
     "Example:\n  bookspin trajectory videos/fig09_matrix.toml --set clip.substeps=300 -o fine.csv"},
    {"page",
     "Write the page of the films in a folder beside them, index.html, and their captions",
     {site_folder, assets_option},
     make_page,
     "Example:\n  bookspin page films"},
    {"report",
     "Measure speed against error, stability and the paper's claims: a page and its data",
     {report_output, quick_flag, assets_option},
     report,
     "Example:\n  bookspin report -o report"},
    {"compare",
     "Say how far two pictures are apart: exit code 0 within the bounds, without any when they are equal; 1 beyond",
     {pictures_argument, bounds_options, delta_output},
     compare_pictures,
     "Example:\n  bookspin compare before.png after.png --max-delta 16 --mean-delta 0.4 --delta differs.png"},
    {"help",
     "Explain the program, one of its commands, or `scene`: every key that a script may hold",
     {topic_argument},
     nullptr,
     "Example:\n  bookspin help scene"},
    {"schema",
     "Print the JSON schema of scene scripts, by which an editor completes and checks them",
     {},
     print_schema,
     "Example:\n  bookspin schema >bookspin.schema.json"},
};

// What is wrong with a call. A word that nobody knows is the cause of whatever else is missing.
std::string what_is_wrong(const CLI::App& at, bool is_command, const CLI::ParseError& error) {
  const std::vector<std::string> words = at.remaining();
  if (words.empty()) return error.what();
  const std::string word = words.front().substr(0, words.front().find('='));
  std::vector<std::string> known;
  if (word.starts_with('-')) {
    for (const CLI::Option* option : at.get_options()) {
      for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    }
    return fmt::format("unknown option '{}'; {}", word, did_you_mean(word, known));
  }
  if (is_command) return fmt::format("found '{}', which is one word too many", word);
  for (const Command& command : commands) known.emplace_back(command.name);
  return fmt::format("unknown command '{}'; {}", word, did_you_mean(word, known));
}

int explain(const CLI::App& app, const std::string& topic) {
  std::vector<std::string> known{"scene"};
  for (const Command& command : commands) known.emplace_back(command.name);
  if (topic == "scene") {
    print(script_manual());
  } else if (topic.empty()) {
    print(app.get_formatter()->make_help(&app, "bookspin", CLI::AppFormatMode::Normal));
  } else if (std::find(known.begin(), known.end(), topic) != known.end()) {
    print(app.get_subcommand(topic)->help("bookspin"));
  } else {
    throw WrongCall(fmt::format("help: found '{}'; {}", topic, did_you_mean(topic, known)));
  }
  return 0;
}

int run(int argc, char** argv) {
  Options options;
  CLI::App app(about, "bookspin");
  app.require_subcommand(1);
  app.fallthrough(false);
  app.get_formatter()->column_width(34);
  app.set_version_flag("--version", version_text, "Print the version, and those of the libraries");
  app.footer(exit_codes);
  for (const Command& command : commands) {
    CLI::App* parser = app.add_subcommand(command.name, command.help);
    for (const Declare declare : command.options) declare(*parser, options);
    parser->footer(command.examples);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // help or version
      app.exit(error);
      finish_output();
      return 0;
    }
    const std::vector<CLI::App*> parsed = app.get_subcommands();
    const bool is_command = !parsed.empty();
    const CLI::App& at = is_command ? *parsed.front() : app;
    const std::string name = is_command ? "bookspin " + at.get_name() : "bookspin";
    throw WrongCall(fmt::format("{}\n`{} --help` explains", what_is_wrong(at, is_command, error), name));
  }
  const std::string name = app.get_subcommands().front()->get_name();
  const Command& command =
      *std::find_if(commands.begin(), commands.end(), [&](const Command& c) { return c.name == name; });
  const auto run_to_the_end = [&](const std::stop_token& stop) {
    options.stop = stop;
    const int exit_code = command.run == nullptr ? explain(app, options.topic) : command.run(options);
    finish_output();
    return exit_code;
  };
  // The report measures for minutes without a look at the token: it ends by the signal itself.
  return command.run == report ? run_to_the_end({}) : stoppable(run_to_the_end);
}

}  // namespace
}  // namespace bookspin

int main(int argc, char** argv) {
  const auto failed = [](const char* what, int exit_code) {
    std::fprintf(stderr, "bookspin: %s\n", what);
    return exit_code;
  };
  bookspin::reserve_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond the user's limit is an error like a full disk
  try {
    return bookspin::run(argc, argv);
  } catch (const bookspin::WrongCall& error) {
    return failed(error.what(), 2);
  } catch (const std::bad_alloc&) {
    return failed("out of memory", 1);
  } catch (const std::exception& error) {
    return failed(error.what(), 1);
  }
}
