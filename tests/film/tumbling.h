// A short film of a tumbling book, in a scratch folder.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "film/film_data.h"
#include "film/shoot.h"
#include "render/renderer.h"
#include "scratch.h"

namespace bookspin {

inline const std::filesystem::path project = BOOKSPIN_SOURCE_DIR;
inline constexpr int width = 160;
inline constexpr int height = 90;

inline constexpr const char* tumbling = R"(
title = "Tumbling"
[clip]
frames = 24
fps = 30
time_per_frame = 2.0
substeps = 40
[[book]]
method = "matrix"
angular_velocity = [0.2, 0.05, 0]
[[expect]]
quantity = "orthogonality_defect"
at_most = 1e-12
)";

inline FilmSettings small() {
  FilmSettings settings;
  settings.width = width;
  settings.height = height;
  return settings;
}

inline std::vector<std::string> files_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

struct Shoot : testing::Test {
  Shoot() { write_text(script, tumbling); }

  FilmReceipt shoot_it(const Film& film, const std::stop_token& stop = {}) {
    Renderer renderer(film.width, film.height, project);
    return shoot(
        film, site, [&]() -> Renderer& { return renderer; }, progress, stop);
  }

  FilmReceipt shoot_it() { return shoot_it(load_film(script, small())); }

  // The products: name and content.
  [[nodiscard]] std::map<std::string, std::string> products_there() const {
    std::map<std::string, std::string> texts;
    for (const std::string& name : files_in(site)) texts[name] = read_text(site / name);
    return texts;
  }

  [[nodiscard]] bool up_to_date(const FilmSettings& settings = small()) const {
    const Film film = load_film(script, settings);
    return is_up_to_date(film, products(film, site));
  }

  Scratch scratch;
  std::filesystem::path script = scratch / "tumbling.toml";
  std::filesystem::path site = scratch / "site";
  Progress progress;
};

}  // namespace bookspin
