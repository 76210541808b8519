// Shoots films: simulate, judge, draw, encode, poster, data.
//
// <name> is the script's file name without its extension. A film leaves <name>.mp4, <name>.png (the poster, its middle
// frame) and <name>.json in the folder; a scene of one frame is a still and leaves <name>.png and <name>.json. Each
// takes its final name only when it is complete, the data last: a film that fails, or is stopped, leaves what stood
// there before.
#pragma once

#include <atomic>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "film/film_data.h"
#include "image/image.h"
#include "render/renderer.h"
#include "scene/judge.h"
#include "scene/simulate.h"

namespace bookspin {

struct FilmOrder {
  std::filesystem::path script;
  std::filesystem::path folder;  // where the products go; made when missing
  MadeWith made_with;
};

struct FilmReceipt {
  std::filesystem::path product;  // the MP4, or the PNG of a still
  int frames = 0;                 // drawn
  int fps = 0;
  std::uintmax_t bytes = 0;  // of the product
  std::vector<Verdict> verdicts;
};

// Shared by all films in the making, and whoever watches them.
struct Progress {
  std::atomic<long> frames_done = 0;
  std::atomic<int> films_done = 0;
  std::atomic<bool> stop = false;  // set: every film stops at its next frame, throwing Stopped
};

// The scene of an order, its frames checked against the scene: std::invalid_argument when the film would be empty.
[[nodiscard]] Scene load_order(const FilmOrder& order);

// The renderer must have the size that the order asks for.
[[nodiscard]] FilmReceipt shoot(const FilmOrder& order, Renderer& renderer, Progress& progress);

// One film of several, which ended in a receipt or in an error.
struct FilmOutcome {
  FilmOrder order;
  std::optional<FilmReceipt> receipt;
  std::string error;  // empty: a receipt
};

// All films, the longest first, by `workers` threads, each with a renderer of its own. Outcomes in the order of the
// orders.
[[nodiscard]] std::vector<FilmOutcome> shoot_all(std::span<const FilmOrder> orders, const std::filesystem::path& assets,
                                                 int workers, Progress& progress);

// Whether the products are newer than the script and all `inputs` (files, or folders with all in them), were made with
// the same settings, and met every expectation.
[[nodiscard]] bool is_up_to_date(const FilmOrder& order, std::span<const std::filesystem::path> inputs);

// One frame of a scene, alone.
[[nodiscard]] Image draw_frame(const Scene& scene, int frame, int width, int height,
                               const std::filesystem::path& assets);

}  // namespace bookspin
