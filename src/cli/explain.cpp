// help, schema, completion: what can be said, told from the declarations of the commands and of the scripts.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/standard_output.h"
#include "cli/version.h"
#include "scene/did_you_mean.h"
#include "scene/reference.h"

namespace bookspin {
namespace {

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
  return text;
}

// "-o, --output" with its type.
std::string names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  if (names.empty()) return option.get_name(true);  // of what has a place and no name
  return fmt::format("{} {}", fmt::join(names, ", "), option.get_type_name());
}

std::string roff(const std::string& text) {
  const std::string escaped = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  return replaced("\n" + escaped, "\n.", "\n\\&.").substr(1);
}

std::string man_page(const CLI::App& program) {
  std::string page = fmt::format(
      ".TH BOOKSPIN 1 \"\" \"{}\"\n.SH NAME\nbookspin \\- films of a tumbling book\n.SH SYNOPSIS\n"
      ".B bookspin\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH DESCRIPTION\n{}\n.SH COMMANDS\n",
      version(), roff(program.get_description()));
  for (const CLI::App* command : program.get_subcommands({})) {
    page += fmt::format(".SS {}\n{}.\n", command->get_name(), roff(command->get_description()));
    for (const CLI::Option* option : command->get_options()) {
      if (option == command->get_help_ptr()) continue;
      page += fmt::format(".TP\n.B {}\n{}.\n", roff(names_of(*option)), roff(option->get_description()));
    }
    page += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command->get_footer()));
  }
  return page + fmt::format(
                    ".SH EXIT STATUS\n{}\n.SH ENVIRONMENT\n.TP\n.B BOOKSPIN_ASSETS\nAs \\-\\-assets.\n.SH SEE ALSO\n"
                    "\\fBbookspin help scene\\fR: every key that a script may hold.\n",
                    roff(program.get_footer()));
}

std::vector<std::string> topics() {
  std::vector<std::string> topics{"scene", "man"};
  for (const Command& command : commands) topics.emplace_back(command.name);
  return topics;
}

std::vector<std::string> options_of(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  if (command.get_name() == "help") names = topics();
  if (command.get_name() == "completion") names = {"bash", "zsh"};
  return names;
}

// Of a word that is none of these, the shell's own: files.
std::string bash_completion(const CLI::App& program) {
  std::string cases;
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands({})) {
    names.push_back(command->get_name());
    cases += fmt::format("    {}) words='{}' ;;\n", command->get_name(), fmt::join(options_of(*command), " "));
  }
  return fmt::format(
      "_bookspin() {{\n  local words\n  case $COMP_CWORD,${{COMP_WORDS[1]}} in\n    1,*) words='{} --help --version' "
      ";;\n{}"
      "  esac\n  COMPREPLY=($(compgen -W \"$words\" -- \"${{COMP_WORDS[COMP_CWORD]}}\"))\n}}\n"
      "complete -o default -F _bookspin bookspin\n",
      fmt::join(names, " "), replaced(cases, "    ", "    *,"));
}

std::string zsh_completion(const CLI::App& program) {
  const auto described = [](const std::string& name, const std::string& description) {
    return fmt::format(" '{}:{}'", name, replaced(description, "'", "'\\''"));
  };
  std::string names;
  std::string cases;
  for (const CLI::App* command : program.get_subcommands({})) {
    names += described(command->get_name(), command->get_description());
    cases += fmt::format("    {}) known=(", command->get_name());
    for (const std::string& name : options_of(*command)) {
      const CLI::Option* option = name.starts_with('-') ? command->get_option(name) : nullptr;
      cases += described(name, option == nullptr ? "" : option->get_description());
    }
    cases += ") ;;\n";
  }
  return fmt::format(
      "#compdef bookspin\nlocal -a known\nif ((CURRENT == 2)); then\n  known=({})\nelse\n  case $words[2] in\n{}  "
      "esac\nfi\n"
      "if ((CURRENT > 2)) && [[ $PREFIX != -* && $words[2] != (help|completion) ]]; then\n  _files\nelse\n"
      "  _describe bookspin known\nfi\n",
      names, cases);
}

}  // namespace

int explain(const Options& options) {
  const CLI::App& program = *options.program;
  const std::vector<std::string> known = topics();
  if (options.topic.empty()) {
    print(program.get_formatter()->make_help(&program, "bookspin", CLI::AppFormatMode::Normal));
  } else if (options.topic == "scene") {
    print(script_manual());
  } else if (options.topic == "man") {
    print(man_page(program));
  } else if (std::find(known.begin(), known.end(), options.topic) != known.end()) {
    print(program.get_subcommand(options.topic)->help("bookspin"));
  } else {
    throw WrongCall(fmt::format("help: found '{}'; {}", options.topic, did_you_mean(options.topic, known)));
  }
  return 0;
}

int print_schema(const Options&) {
  print(script_schema());
  return 0;
}

int print_completion(const Options& options) {
  print(options.topic == "zsh" ? zsh_completion(*options.program) : bash_completion(*options.program));
  return 0;
}

}  // namespace bookspin
