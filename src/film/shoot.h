// Shoots films: simulate, judge, draw, encode, poster, data.
//
// A film leaves NAME.mp4, NAME.png (the poster, its middle frame) and NAME.json in the folder, which is made when
// missing; a scene of one frame is a still and leaves NAME.png and NAME.json, and an older film of that name goes. All
// take their names together, when all are complete, the data last: a film that fails, or is stopped, leaves what stood
// there before. Names that cannot be taken, or are the script's own, are refused before the work begins.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "film/film.h"
#include "image/image.h"
#include "render/renderer.h"
#include "scene/judge.h"
#include "scene/simulate.h"

namespace bookspin {

struct FilmReceipt {
  std::filesystem::path product;  // the MP4, or the PNG of a still
  std::uintmax_t bytes = 0;       // of the product
  int frames = 0;                 // drawn
  std::vector<Verdict> verdicts;
};

// Of all films in the making, for whoever watches them.
struct Progress {
  std::atomic<long> frames_simulated = 0;  // of each book
  std::atomic<long> frames_drawn = 0;
  std::atomic<int> films_done = 0;
};

// Throws what shoot() would throw because a product cannot have its name; leaves the folder and nothing in it.
void require_products(const Film& film, const std::filesystem::path& folder);

using GetRenderer = std::function<Renderer&()>;  // of the film's size

// The renderer is asked for when the scene is simulated. Several workers, each a process, draw and encode a long MP4 in
// pieces, which makes the same bytes: then `progress` is in memory that processes share, and OpenGL is not yet begun.
// Asked to stop, throws Stopped before the next frame.
[[nodiscard]] FilmReceipt shoot(const Film& film, const std::filesystem::path& folder, const GetRenderer& get_renderer,
                                Progress& progress, const std::stop_token& stop = {}, int workers = 1);

// One film of several, which ended in a receipt or in an error; when it was stopped, in neither.
struct FilmOutcome {
  std::optional<FilmReceipt> receipt;
  std::string error;
};

// All films, the longest first, each in a process of its own, `workers` at a time: one that dies costs its film. Where
// films are fewer than workers, and at the end, several share a film.
// Outcomes in the order of the films. `go_on` is called ten times a second, with the progress up to date; when it says
// no, all stop.
[[nodiscard]] std::vector<FilmOutcome> shoot_all(
    std::span<const Film> films, const std::filesystem::path& folder, const std::filesystem::path& assets, int workers,
    Progress& progress, const std::function<bool()>& go_on = [] { return true; });

// One frame of a scene, alone.
[[nodiscard]] Image draw_frame(const Scene& scene, int frame, int width, int height,
                               const std::filesystem::path& assets, const std::stop_token& stop = {});

}  // namespace bookspin
