// What each command of the program does. Each returns the exit code: 0 when everything was made and every expectation
// met, else 1. Failures throw; main prints them.
#pragma once

#include "cli/options.h"

namespace bookspin {

int list_scenes(const Options& options);
int render_scenes(const Options& options);
int draw_scene_frame(const Options& options);
int check_scenes(const Options& options);
int write_trajectory(const Options& options);
int print_scene(const Options& options);
int report(const Options& options);
int give_advice(const Options& options);
int make_page(const Options& options);
int verify_products(const Options& options);
int examine(const Options& options);
int explain(const Options& options);
int print_schema(const Options& options);
int print_completion(const Options& options);
int compare_pictures(const Options& options);

}  // namespace bookspin
