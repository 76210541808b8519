// bookspin: parse, call, one catch, exit code. 0: everything was made and every expectation met; 1: not so; 2: a wrong
// call; 128 + N: stopped by signal N.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <system_error>

#include "cli/commands.h"
#include "cli/options.h"
#include "cli/standard_output.h"
#include "cli/watch.h"
#include "scene/did_you_mean.h"

namespace bookspin {
namespace {

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

int run(int argc, char** argv) {
  Options options;
  CLI::App app("", "bookspin");
  declare_commands(app, options);
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
    const int exit_code = command.run(options);
    finish_output();
    return exit_code;
  };
  // The report measures for minutes without a look at the token: it ends by the signal itself. Films are made by
  // processes, which begin before any thread does.
  const bool threadless = command.run == report || command.run == render_scenes;
  return threadless ? run_to_the_end({}) : stoppable(run_to_the_end);
}

// Whoever reports an error, in whatever thread, then says this.
struct OutOfMemory : std::bad_alloc {
  [[nodiscard]] const char* what() const noexcept override {
    return "out of memory: end other programs, raise the limit (ulimit -v), or take fewer frames, books, --jobs or "
           "pixels";
  }
};

}  // namespace
}  // namespace bookspin

int main(int argc, char** argv) {
  const auto failed = [](const char* what, int exit_code) {
    bookspin::complain(what);
    return exit_code;
  };
  std::set_new_handler([] { throw bookspin::OutOfMemory(); });
  bookspin::reserve_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows beyond the user's limit is an error like a full disk
  try {
    return bookspin::run(argc, argv);
  } catch (const bookspin::WrongCall& error) {
    return failed(error.what(), 2);
  } catch (const std::system_error& error) {
    const bool thread = error.code() == std::errc::resource_unavailable_try_again;
    return failed(thread ? "cannot start a thread: processes or memory are limited (ulimit -u, -v)" : error.what(), 1);
  } catch (const std::exception& error) {
    return failed(error.what(), 1);
  }
}
