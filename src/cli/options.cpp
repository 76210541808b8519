#include "cli/options.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>

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

void add_output(CLI::App& command, const char* names, std::string& target, const char* help, const char* type) {
  command.add_option(names, target, help)->type_name(type)->check(not_empty);
}

}  // namespace

void scene_argument(CLI::App& command, Options& options) {
  scenes_argument(command, options);
  command.get_option("SCENE")->expected(1)->description("Scene script");
}

void scenes_argument(CLI::App& command, Options& options) {
  command.add_option("SCENE", options.scenes, "Scene scripts")->required()->type_name("FILE.toml")->check(not_empty);
}

void scripts_folder(CLI::App& command, Options& options) {
  add_output(command, "DIR", options.folder, "Folder of scripts (default: the videos that come with the program)", "");
}

void site_folder(CLI::App& command, Options& options) {
  add_output(command, "DIR", options.folder, "Folder of the films (default: site)", "");
}

void films_output(CLI::App& command, Options& options) {
  add_output(command, "-o,--output", options.folder, "Folder of the films (default: site)", "DIR");
}

void report_output(CLI::App& command, Options& options) {
  add_output(command, "-o,--output", options.folder, "Folder of the report (default: site/report)", "DIR");
}

void picture_output(CLI::App& command, Options& options) {
  command.add_option("-o,--output", options.output, "The picture")
      ->required()
      ->type_name("FILE.png")
      ->check(not_empty_png);
}

void table_output(CLI::App& command, Options& options) {
  add_output(command, "-o,--output", options.output, "The table (default: standard output)", "FILE.csv");
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

void frame_option(CLI::App& command, Options& options) {
  add_number(command, "--frame", options.frame, 0, 99999, "Which frame, from 0")->required();
}

void jobs_option(CLI::App& command, Options& options) {
  add_number(command, "-j,--jobs", options.jobs, 1, 256, "Films made at the same time (default: one a core)");
}

void update_flag(CLI::App& command, Options& options) {
  command.add_flag(
      "--update", options.update,
      "Only films that are missing or damaged, made otherwise, of another script or by a program that draws "
      "otherwise, or with an expectation unmet");
}

void quick_flag(CLI::App& command, Options& options) {
  command.add_flag("--quick", options.quick, "Every file in seconds: for tests, not for reading");
}

void set_option(CLI::App& command, Options& options) {
  command.add_option("--set", options.overrides, "Change a key of the script, dotted, books by index; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return text.find('=') == std::string::npos ? fmt::format("found '{}'; allowed: KEY=VALUE", text) : "";
      });
}

void assets_option(CLI::App& command, Options& options) {
  add_output(command, "--assets", options.assets,
             "Folder of shaders, textures, videos and data (default: $BOOKSPIN_ASSETS, else those that came with the "
             "program)",
             "DIR");
}

void topic_argument(CLI::App& command, Options& options) {
  command.add_option("TOPIC", options.topic, "A command, or scene")->type_name("");
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

}  // namespace bookspin
