#include "cli/options.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

#include "cli/commands.h"
#include "cli/version.h"

namespace bookspin {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& found, const std::string& allowed) {
  throw CLI::ValidationError(option, fmt::format("found '{}'; allowed: {}", found, allowed));
}

// A number that is the entire text; nothing when it is not.
template <typename Number>
std::optional<Number> number_in(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

// An option whose text is read by `read(text)`.
template <typename Read>
CLI::Option* add(CLI::App& command, const std::string& names, const char* type, const char* help, const Read& read) {
  return command.add_option_function<std::string>(names, read, help)->type_name(type);
}

template <typename Number, typename Target>
CLI::Option* add_number(CLI::App& command, const std::string& names, Target& target, Number low, Number high,
                        const char* help) {
  const std::string name = names.substr(names.find("--"));
  const std::string allowed =
      fmt::format("a {}number from {} to {}", std::is_integral_v<Number> ? "whole " : "", low, high);
  return add(command, names, "N", help, [&target, name, low, high, allowed](const std::string& text) {
    const std::optional<Number> number = number_in<Number>(text);
    if (!number || !(*number >= low && *number <= high)) refuse(name, text, allowed);
    target = *number;
  });
}

std::string not_empty(const std::string& text) {
  return text.empty() ? "is empty" : "";
}

std::string not_empty_png(const std::string& text) {
  if (text.empty() || std::filesystem::path(text).extension() == ".png") return not_empty(text);
  return fmt::format("found '{}'; allowed: a name that ends in .png", text);
}

// Declarations of options that only one command has, or that need no word of their own.
Declare text(std::string Options::*target, const char* names, const char* type, const char* help) {
  return [=](CLI::App& command, Options& options) {
    command.add_option(names, options.*target, help)->type_name(type)->check(not_empty);
  };
}

Declare flag(bool Options::*target, const char* name, const char* help) {
  return [=](CLI::App& command, Options& options) { command.add_flag(name, options.*target, help); };
}

void scenes_argument(CLI::App& command, Options& options) {
  command.add_option("SCENE", options.scenes, "Scene scripts")->required()->type_name("FILE.toml")->check(not_empty);
}

void scene_argument(CLI::App& command, Options& options) {
  scenes_argument(command, options);
  command.get_option("SCENE")->expected(1)->description("Scene script");
}

void picture_output(CLI::App& command, Options& options) {
  command.add_option("-o,--output", options.output, "The picture")
      ->required()
      ->type_name("FILE.png")
      ->check(not_empty_png);
}

void size_option(CLI::App& command, Options& options) {
  add(command, "--size", "WxH", "Picture size in pixels, both even, up to 4096", [&options](const std::string& text) {
    const std::size_t x = std::min(text.find('x'), text.size());
    const auto width = number_in<int>(std::string_view(text).substr(0, x));
    const auto height = number_in<int>(std::string_view(text).substr(std::min(x + 1, text.size())));
    const auto fits = [](std::optional<int> n) { return n && *n >= 16 && *n <= 4096 && *n % 2 == 0; };
    if (!fits(width) || !fits(height)) {
      refuse("--size", text, "WxH, both even and from 16 to 4096, such as 1280x720");
    }
    options.width = *width;
    options.height = *height;
  })->default_str(fmt::format("{}x{}", options.width, options.height));
}

void format_option(CLI::App& command, Options& options) {
  command
      .add_option("--format", options.format,
                  "Of the films: a GIF has 20 of 60 frames, for slides; take a --size of 480x270")
      ->type_name("mp4|webm|gif")
      ->capture_default_str()
      ->check([](const std::string& text) {
        return text == "mp4" || text == "webm" || text == "gif"
                   ? ""
                   : fmt::format("found '{}'; allowed: mp4, webm, gif", text);
      });
}

void frames_option(CLI::App& command, Options& options) {
  add(command, "--frames", "A:B", "Only frames A to B, B not included; either may be left out",
      [&options](const std::string& text) {
        const std::size_t colon = text.find(':');
        const std::string_view from = std::string_view(text).substr(0, colon);
        const std::string_view to = colon == std::string::npos ? "?" : std::string_view(text).substr(colon + 1);
        const auto first = from.empty() ? 0 : number_in<int>(from);
        const auto end = number_in<int>(to);
        if (!first || *first < 0 || (!to.empty() && (!end || *end <= *first))) {
          refuse("--frames", text, "A:B with 0 <= A < B, such as 0:120");
        }
        options.first_frame = *first;
        options.end_frame = end;
      });
}

void set_option(CLI::App& command, Options& options) {
  command.add_option("--set", options.overrides, "Change a key of the script, dotted, books by index; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return text.find('=') == std::string::npos ? fmt::format("found '{}'; allowed: KEY=VALUE", text) : "";
      });
}

void shell_argument(CLI::App& command, Options& options) {
  command.add_option("SHELL", options.topic, "bash or zsh")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember({"bash", "zsh"}));
}

void pictures_argument(CLI::App& command, Options& options) {
  command.add_option("PICTURE", options.pictures, "Two pictures of one size")
      ->required()
      ->expected(2)
      ->type_name("FILE.png")
      ->check(CLI::ExistingFile);
}

void bounds_options(CLI::App& command, Options& options) {
  add_number(command, "--max-delta", options.max_delta, 0, 255, "Most that a pixel may be off, in levels");
  add_number(command, "--mean-delta", options.mean_delta, 0.0, 255.0,
             "Most that pixels may be off on average, in levels");
  add_number(command, "--share", options.share, 0.0, 1.0, "Largest share of pixels that may be off beyond --threshold");
  add_number(command, "--threshold", options.threshold, 0, 255, "Levels that count as equal for --share")
      ->default_str(fmt::format("{}", options.threshold));
}

void delta_output(CLI::App& command, Options& options) {
  command.add_option("--delta", options.output, "Draw what differs: the first picture in gray, each such pixel in red")
      ->type_name("FILE.png")
      ->check(not_empty_png);
}

constexpr const char* about =
    "Films of a tumbling book: scene scripts (TOML) -> MP4, and the numbers behind them.\n"
    "The paper's figures come with it; `bookspin list` shows them.";
constexpr const char* exit_codes =
    "Exit code: 0 when everything was made and every expectation met, 1 when not, 2 for a call that is\n"
    "wrong whatever the files hold, 128 + N when signal N has stopped it.";

const Declare assets_option =
    text(&Options::assets, "--assets", "DIR",
         "Folder of shaders, textures, videos and data (default: $BOOKSPIN_ASSETS, else those "
         "that came with the program)");

}  // namespace

const std::vector<Command> commands{
    {"list",
     "Show the scene scripts of a folder",
     {text(&Options::folder, "DIR", "", "Folder of scripts (default: the videos that come with the program)"),
      assets_option, set_option},
     list_scenes,
     "Example:\n  bookspin list videos"},
    {"render",
     "Make films, with poster and data beside each",
     {scenes_argument, text(&Options::folder, "-o,--output", "DIR", "Folder of the films (default: site)"), size_option,
      frames_option, format_option,
      [](auto& command, auto& options) {
        add_number(command, "-j,--jobs", options.jobs, 1, 256,
                   "Processes that film at the same time (default: one a core)");
      },
      flag(&Options::update, "--update",
           "Only films that are missing or damaged, made otherwise, of another script or by a program that draws "
           "otherwise, or with an expectation unmet"),
      set_option, assets_option},
     render_scenes,
     "Examples:\n  bookspin render videos/fig05_unstable_x.toml -o films\n"
     "  bookspin render my.toml --size 640x360 --frames 0:120 --set book.0.jiggle=0.01"},
    {"frame",
     "Draw one frame as a PNG",
     {scene_argument,
      [](auto& command, auto& options) {
        add_number(command, "--frame", options.frame, 0, 99999, "Which frame, from 0")->required();
      },
      picture_output, size_option, set_option, assets_option},
     draw_scene_frame,
     "Example:\n  bookspin frame videos/fig05_unstable_x.toml --frame 450 -o flipping.png"},
    {"check",
     "Simulate and judge every expectation, without drawing",
     {scenes_argument, set_option},
     check_scenes,
     "Example:\n  bookspin check videos/*.toml"},
    {"trajectory",
     "Write the motion as CSV: corners, orientation, L, omega, and every quantity",
     {scene_argument, text(&Options::output, "-o,--output", "FILE.csv", "The table (default: standard output)"),
      set_option},
     write_trajectory,
     "Example:\n  bookspin trajectory videos/fig09_matrix.toml --set clip.substeps=300 -o fine.csv"},
    {"json",
     "Print a script as JSON: every number to its last digit, with the defaults filled in",
     {scene_argument, set_option},
     print_scene,
     "Example:\n  bookspin json videos/fig09_matrix.toml --set clip.substeps=300"},
    {"page",
     "Write the page of the films in a folder beside them, index.html, and their captions",
     {text(&Options::folder, "DIR", "", "Folder of the films (default: site)"), assets_option},
     make_page,
     "Example:\n  bookspin page films"},
    {"verify",
     "Say of each product in a folder whether it is whole, how it was made, and whether its claims are met",
     {text(&Options::folder, "DIR", "", "Folder of the films (default: site)")},
     verify_products,
     "Example:\n  bookspin verify films"},
    {"report",
     "Measure speed against error, stability and the paper's claims: a page and its data",
     {text(&Options::folder, "-o,--output", "DIR", "Folder of the report (default: site/report)"),
      flag(&Options::quick, "--quick", "Every file in seconds: for tests, not for reading"), assets_option},
     report,
     "Example:\n  bookspin report -o report"},
    {"advise",
     "Say which method and step keep a scene's book within an error of the exact motion, at the least work",
     {scene_argument,
      [](auto& command, auto& options) {
        add_number(command, "--error", options.error, 1e-14, 1.0,
                   "Largest angle to the exact orientation in any frame, in radians")
            ->default_str(fmt::format("{}", options.error));
      },
      set_option},
     give_advice,
     "Example:\n  bookspin advise videos/fig09_matrix.toml --error 1e-3"},
    {"compare",
     "Say how far two pictures are apart: exit code 0 within the bounds, without any when they are equal; 1 beyond",
     {pictures_argument, bounds_options, delta_output},
     compare_pictures,
     "Example:\n  bookspin compare before.png after.png --max-delta 16 --mean-delta 0.4 --delta differs.png"},
    {"doctor",
     "Say what this machine has for making films, and what to install: exit code 0 when they can be made",
     {assets_option},
     examine,
     "Example:\n  bookspin doctor"},
    {"help",
     "Explain the program, one of its commands, or the scripts",
     {text(&Options::topic, "TOPIC", "", "A command; scene: every key that a script may hold; man: the manual page")},
     explain,
     "Example:\n  bookspin help scene"},
    {"schema",
     "Print the JSON schema of scene scripts, by which an editor completes and checks them",
     {},
     print_schema,
     "Example:\n  bookspin schema >bookspin.schema.json"},
    {"completion",
     "Print what has a shell complete commands and options",
     {shell_argument},
     print_completion,
     "Example:\n  bookspin completion bash >~/.local/share/bash-completion/completions/bookspin"},
};

// CLI11 from 2.5 on would fill the lines of the examples as if they were prose.
void keep_lines(auto& formatter) {
  if constexpr (requires { formatter.enable_footer_formatting(false); }) formatter.enable_footer_formatting(false);
}

void declare_commands(CLI::App& program, Options& options) {
  options.program = &program;
  program.description(about);
  program.footer(exit_codes);
  program.require_subcommand(1);
  program.fallthrough(false);
  program.get_formatter()->column_width(34);
  keep_lines(*program.get_formatter());
  program.set_version_flag("--version", version_text, "Print the version, and those of the libraries");
  for (const Command& command : commands) {
    CLI::App* parser = program.add_subcommand(command.name, command.help);
    for (const Declare& declare : command.declare) declare(*parser, options);
    parser->footer(command.examples);
  }
}

}  // namespace bookspin
