#include "film/shoot.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <thread>

#include "files/part.h"
#include "film/film_data.h"
#include "film/storyboard.h"
#include "image/png.h"
#include "video/mp4_writer.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;

// Makes the folder; none of the products is the script.
Products prepare(const Film& film, const fs::path& folder) {
  Products names = products(film, folder);
  for (const fs::path& product : {names.film, names.poster, names.data}) {
    std::error_code ignored;  // of names that do not exist
    if (fs::equivalent(product, film.file, ignored)) {
      throw std::invalid_argument(fmt::format("{}: would replace the script itself; call that {}.toml",
                                              product.string(), film.file.stem().string()));
    }
  }
  fs::create_directories(folder);
  return names;
}

struct PartsOfFilm {
  std::optional<Part> mp4;  // none: a still
  Part poster;
  Part data;

  PartsOfFilm(const Film& film, const Products& names)
      : poster(names.poster, NamedBy::program), data(names.data, NamedBy::program) {
    if (!film.is_still()) mp4.emplace(names.film, NamedBy::program);
  }
};

}  // namespace

void require_products(const Film& film, const fs::path& folder) {
  const PartsOfFilm parts(film, prepare(film, folder));
}

FilmReceipt shoot(const Film& film, const fs::path& folder, Renderer& renderer, Progress& progress,
                  const std::stop_token& stop) {
  const Products names = prepare(film, folder);
  PartsOfFilm parts(film, names);
  auto& [mp4, poster, data] = parts;
  std::optional<Mp4Writer> writer;
  if (mp4) {
    writer.emplace(*mp4, Mp4Writer::Settings{film.width, film.height, film.scene.clip.fps, film.scene.title});
  }
  const Trajectory trajectory = simulate(film.scene, stop, &progress.frames_simulated);
  FilmReceipt receipt;
  receipt.verdicts = judge(film.scene, trajectory);
  const Storyboard storyboard(film.scene, trajectory, film.width, film.height);
  const int end_frame = std::clamp(storyboard.frames(), film.first_frame + 1, film.end_frame);
  const int poster_frame = (film.first_frame + end_frame) / 2;
  for (int frame = film.first_frame; frame < end_frame; ++frame) {
    if (stop.stop_requested()) throw Stopped();
    const Image& picture = renderer.draw(storyboard.shot(frame));
    if (writer) writer->write(picture, renderer.changed());
    if (frame == poster_frame) write_png(poster, picture);
    ++progress.frames_drawn;
  }
  if (writer) writer->finish();
  progress.frames_drawn += film.end_frame - end_frame;  // those that need not be drawn
  write_film_data(data, {film, trajectory, receipt.verdicts, end_frame - film.first_frame, mp4 ? &*mp4 : nullptr,
                         poster, renderer.description()});

  receipt.frames = end_frame - film.first_frame;
  receipt.product = mp4 ? names.film : names.poster;
  receipt.bytes = fs::file_size(mp4 ? mp4->path() : poster.path());
  if (mp4) {
    publish({&*mp4, &poster, &data});
  } else {
    publish({&poster, &data}, names.film);
  }
  ++progress.films_done;
  return receipt;
}

std::vector<FilmOutcome> shoot_all(std::span<const Film> films, const fs::path& folder, const fs::path& assets,
                                   int workers, Progress& progress, const std::stop_token& stop) {
  std::vector<FilmOutcome> outcomes(films.size());
  const auto length = [&films](std::size_t i) {
    return static_cast<std::size_t>(films[i].frames()) * films[i].scene.books.size();
  };
  std::vector<std::size_t> queue(films.size());
  std::iota(queue.begin(), queue.end(), 0U);
  std::stable_sort(queue.begin(), queue.end(), [&](std::size_t a, std::size_t b) { return length(a) > length(b); });

  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    std::optional<Renderer> renderer;
    for (std::size_t i = next++; i < queue.size() && !stop.stop_requested(); i = next++) {
      const Film& film = films[queue[i]];
      FilmOutcome& outcome = outcomes[queue[i]];
      try {
        if (!renderer) renderer.emplace(film.width, film.height, assets);
        outcome.receipt = shoot(film, folder, *renderer, progress, stop);
      } catch (const Stopped&) {
        return;
      } catch (const std::exception& error) {
        outcome.error = error.what();
      }
    }
  };
  std::vector<std::jthread> threads;
  for (int i = 0; i < std::min<int>(workers, static_cast<int>(films.size())); ++i) threads.emplace_back(work);
  threads.clear();  // joins
  return outcomes;
}

Image draw_frame(const Scene& scene, int frame, int width, int height, const fs::path& assets,
                 const std::stop_token& stop) {
  const Trajectory trajectory = simulate(scene, stop);
  const Storyboard storyboard(scene, trajectory, width, height);
  return Renderer(width, height, assets).draw(storyboard.shot(frame));
}

}  // namespace bookspin
