// What each command of the program does. Each returns the exit code: 0 when everything was made and every expectation
// met, else 1. Failures throw; main prints them.
#pragma once

#include <string>
#include <vector>

namespace bookspin {

struct Options {
  std::vector<std::string> scenes;
  std::vector<std::string> overrides;
  std::string folder;             // empty: the command's default
  std::string output;             // empty: standard output
  std::string size = "1280x720";  // WxH
  std::string frames;             // A:B; empty: all
  int frame = 0;
  int jobs = 0;  // 0: one a core
  bool update = false;
  bool quick = false;
};

int list_scenes(const Options& options);
int render_scenes(const Options& options);
int draw_scene_frame(const Options& options);
int check_scenes(const Options& options);
int write_trajectory(const Options& options);
int report(const Options& options);
int make_page(const Options& options);

}  // namespace bookspin
