// bookspin: parse, call, one catch, exit code. 0: everything was made and every expectation met; 1: not so; 2: a wrong
// call.

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>

#include "cli/commands.h"

namespace {

constexpr const char* about =
    "Films of a tumbling book: scene scripts (TOML) -> MP4, and the numbers behind them.\n"
    "The paper's figures are in videos/*.toml; `bookspin list` shows them.";

int run(int argc, char** argv) {
  bookspin::Options options;
  CLI::App app(about, "bookspin");
  app.require_subcommand(1);
  app.fallthrough(false);
  app.get_formatter()->column_width(34);

  const auto add_set = [&options](CLI::App* command) {
    command
        ->add_option("--set", options.overrides, "Change a key of the script, dotted, books by index; may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
  };
  const auto add_scenes = [&options](CLI::App* command) {
    command->add_option("SCENE", options.scenes, "Scene scripts")->required()->type_name("FILE.toml");
  };
  const auto add_scene = [&options](CLI::App* command) {
    command->add_option("SCENE", options.scenes, "Scene script")->required()->expected(1)->type_name("FILE.toml");
  };
  const auto add_size = [&options](CLI::App* command) {
    command->add_option("--size", options.size, "Picture size in pixels, both even, up to 4096")
        ->type_name("WxH")
        ->capture_default_str();
  };

  CLI::App* list = app.add_subcommand("list", "Show the scene scripts of a folder");
  list->add_option("DIR", options.folder, "Folder of scripts (default: the project's videos)");
  add_set(list);
  list->footer("Example:\n  bookspin list videos");

  CLI::App* render = app.add_subcommand("render", "Make films, with poster and data beside each");
  add_scenes(render);
  render->add_option("-o,--output", options.folder, "Folder of the films (default: the project's videos/site)")
      ->type_name("DIR");
  add_size(render);
  render->add_option("--frames", options.frames, "Only frames A to B, B not included; either may be left out")
      ->type_name("A:B");
  render->add_option("-j,--jobs", options.jobs, "Films made at the same time (default: one a core)")
      ->check(CLI::Range(1, 256));
  render->add_flag(
      "--update", options.update,
      "Only films older than their script, the shaders, the textures or this program, made otherwise, or with an "
      "expectation unmet");
  add_set(render);
  render->footer(
      "Examples:\n  bookspin render videos/fig05_unstable_x.toml -o films\n"
      "  bookspin render my.toml --size 640x360 --frames 0:120 --set book.0.jiggle=0.01");

  CLI::App* frame = app.add_subcommand("frame", "Draw one frame as a PNG");
  add_scene(frame);
  frame->add_option("--frame", options.frame, "Which frame, from 0")->required()->type_name("N");
  frame->add_option("-o,--output", options.output, "The picture")->required()->type_name("FILE.png");
  add_size(frame);
  add_set(frame);
  frame->footer("Example:\n  bookspin frame videos/fig05_unstable_x.toml --frame 450 -o flipping.png");

  CLI::App* check = app.add_subcommand("check", "Simulate and judge every expectation, without drawing");
  add_scenes(check);
  add_set(check);
  check->footer("Example:\n  bookspin check videos/*.toml");

  CLI::App* trajectory =
      app.add_subcommand("trajectory", "Write the motion as CSV: corners, orientation, L, energies, stretch");
  add_scene(trajectory);
  trajectory->add_option("-o,--output", options.output, "The table (default: standard output)")->type_name("FILE.csv");
  add_set(trajectory);
  trajectory->footer("Example:\n  bookspin trajectory videos/fig09_matrix.toml --set clip.substeps=300 -o fine.csv");

  CLI::App* report = app.add_subcommand(
      "report", "Measure speed against error, stability and the paper's claims: a page and its data");
  report->add_option("-o,--output", options.folder, "Folder of the report (default: the project's videos/site/report)")
      ->type_name("DIR");
  report->add_flag("--quick", options.quick, "Every file in seconds: for tests, not for reading");
  report->footer("Example:\n  bookspin report -o report");

  CLI::App* page = app.add_subcommand("page", "Write the course page beside the films, index.html");
  page->add_option("DIR", options.folder, "Folder of the films (default: the project's videos/site)");
  page->footer("Example:\n  bookspin page videos/site");

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (*list) return bookspin::list_scenes(options);
  if (*render) return bookspin::render_scenes(options);
  if (*frame) return bookspin::draw_scene_frame(options);
  if (*check) return bookspin::check_scenes(options);
  if (*trajectory) return bookspin::write_trajectory(options);
  if (*report) return bookspin::report(options);
  return bookspin::make_page(options);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bookspin: %s\n", error.what());
    return 1;
  }
}
