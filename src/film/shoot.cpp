#include "film/shoot.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <list>
#include <map>
#include <new>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "files/files.h"
#include "files/part.h"
#include "film/film_data.h"
#include "film/process.h"
#include "film/storyboard.h"
#include "image/png.h"
#include "video/film_writer.h"

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
  make_folder(folder);
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

// In memory that processes share.
template <typename T>
class Shared {
 public:
  Shared() : memory_(mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (memory_ == MAP_FAILED) throw std::runtime_error(fmt::format("mmap: {}", std::strerror(errno)));
    object_ = new (memory_) T;
  }
  ~Shared() { munmap(memory_, sizeof(T)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  T& operator*() const { return *object_; }
  T* operator->() const { return object_; }

 private:
  void* memory_;
  T* object_ = nullptr;
};

void stop_if(const std::stop_token& stop) {
  if (stop.stop_requested()) throw Stopped();
}

// Work in a process of its own.
class Helper {
 public:
  template <class Work>
  explicit Helper(const Work& work)
      : process_([&](const std::stop_token& stop) {
          work(stop);
          return std::string();
        }) {}

  // Whether it is done, asked for so many milliseconds at most. Throws what the work threw.
  bool is_done(int within) {
    pollfd pipe{process_.descriptor(), POLLIN, 0};
    if (!done_ && poll(&pipe, 1, within) > 0) {
      (void)process_.result();
      done_ = true;
    }
    return done_;
  }

 private:
  Process process_;
  bool done_ = false;
};

// Several workers, this process and its helpers, take a film's segments by turns: neighbors cost alike. draw(share,
// writer, look_around) draws those of a share and says by what. OpenGL is not yet begun here.
template <class Draw>
std::string draw_in_pieces(const fs::path& film, FilmWriter::Settings settings, FilmWriter& writer, int frames,
                           int shares, const Draw& draw, const std::stop_token& stop) {
  settings.piece = true;
  std::list<Part> pieces;
  for (int i = 0; i < shares; ++i) pieces.emplace_back(film, NamedBy::program);
  const auto draw_piece = [&](int share, const auto& look_around) {
    FilmWriter piece(*std::next(pieces.begin(), share), settings);
    std::string drawn_by = draw(share, &piece, look_around);
    piece.finish();
    return drawn_by;
  };
  std::list<Helper> helpers;
  for (int i = 1; i < shares; ++i)
    helpers.emplace_back([&, i](const std::stop_token& its_stop) { draw_piece(i, [&] { stop_if(its_stop); }); });
  std::string drawn_by = draw_piece(0, [&] {
    stop_if(stop);
    for (Helper& helper : helpers) (void)helper.is_done(0);  // or has failed, and the rest is in vain
  });
  for (Helper& helper : helpers) {
    while (!helper.is_done(100)) stop_if(stop);
  }

  std::list<PieceReader> readers(pieces.begin(), pieces.end());
  auto reader = readers.begin();
  const int segment = *writer.segment();
  for (int first = 0; first < frames; first += segment) {
    writer.append(*reader, std::min(segment, frames - first));
    if (++reader == readers.end()) reader = readers.begin();
  }
  return drawn_by;
}

constexpr char end_of_field = '\0';

std::string text_of(const FilmReceipt& receipt) {
  std::string text;
  const auto put = [&](const auto& field) { text += fmt::format("{}{}", field, end_of_field); };
  put(receipt.product.string());
  put(receipt.bytes);
  put(receipt.frames);
  for (const Verdict& v : receipt.verdicts) {
    put(v.says);
    put(static_cast<int>(v.quantity));
    put(v.text);
    put(int{v.met});
    put(v.found);
    put(v.frame);
  }
  return text;
}

FilmReceipt receipt_of(const std::string& text) {
  std::istringstream in(text);
  const auto field = [&in] {
    std::string value;
    std::getline(in, value, end_of_field);
    return value;
  };
  FilmReceipt receipt;
  receipt.product = field();
  receipt.bytes = std::stoull(field());
  receipt.frames = std::stoi(field());
  while (in.peek() != std::istringstream::traits_type::eof()) {
    Verdict& v = receipt.verdicts.emplace_back();
    v.says = field();
    v.quantity = static_cast<Q>(std::stoi(field()));
    v.text = field();
    v.met = field() == "1";
    v.found = std::strtod(field().c_str(), nullptr);
    v.frame = std::stoi(field());
  }
  return receipt;
}

}  // namespace

void require_products(const Film& film, const fs::path& folder) {
  const PartsOfFilm parts(film, prepare(film, folder));
}

FilmReceipt shoot(const Film& film, const fs::path& folder, const GetRenderer& get_renderer, Progress& progress,
                  const std::stop_token& stop, int workers) {
  const Products names = prepare(film, folder);
  PartsOfFilm parts(film, names);
  std::optional<Part>& mp4 = parts.mp4;
  Part& poster = parts.poster;
  Part& data = parts.data;
  const FilmWriter::Settings settings{film.width, film.height, film.scene.clip.fps, film.scene.title};
  std::optional<FilmWriter> writer;
  if (mp4) writer.emplace(*mp4, settings);
  const Trajectory trajectory = simulate(film.scene, stop, &progress.frames_simulated);
  FilmReceipt receipt;
  receipt.verdicts = judge(film.scene, trajectory);
  const Storyboard storyboard(film.scene, trajectory, film.width, film.height);
  const int end_frame = std::clamp(storyboard.frames(), film.first_frame + 1, film.end_frame);
  receipt.frames = end_frame - film.first_frame;
  const int segment = writer ? writer->segment().value_or(receipt.frames) : receipt.frames;
  const int shares = std::min(workers, (receipt.frames + segment - 1) / segment);
  const auto draw = [&](int share, FilmWriter* into, const auto& look_around) {
    Renderer& renderer = get_renderer();
    for (int frame = film.first_frame; frame < end_frame; ++frame) {
      if ((frame - film.first_frame) / segment % shares != share) continue;
      look_around();
      const Image& picture = renderer.draw(storyboard.shot(frame));
      if (into != nullptr) into->write(picture, renderer.changed());
      if (frame == (film.first_frame + end_frame) / 2) write_png(poster, picture);
      ++progress.frames_drawn;
    }
    return renderer.description();
  };
  constexpr int samples = 16;
  for (int i = 0; writer && writer->needs_samples() && i < samples; ++i)
    writer->sample(get_renderer().draw(storyboard.shot(film.first_frame + i * receipt.frames / samples)));
  const std::string drawn_by = shares > 1
                                   ? draw_in_pieces(names.film, settings, *writer, receipt.frames, shares, draw, stop)
                                   : draw(0, writer ? &*writer : nullptr, [&] { stop_if(stop); });
  if (writer) writer->finish();
  progress.frames_drawn += film.end_frame - end_frame;  // those that need not be drawn
  write_film_data(data, {film, trajectory, receipt.verdicts, receipt.frames, mp4 ? &*mp4 : nullptr, poster, drawn_by});

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
                                   int workers, Progress& progress, const std::function<bool()>& go_on) {
  const Shared<Progress> shared;
  const auto work = [&](const Film& film, const std::stop_token& stop, int share) -> std::string {
    std::optional<Renderer> renderer;
    const auto get = [&]() -> Renderer& {
      return renderer ? *renderer : renderer.emplace(film.width, film.height, assets);
    };
    return text_of(shoot(film, folder, get, *shared, stop, share));
  };
  const auto cost = [&films](std::size_t i) {
    return static_cast<std::size_t>(films[i].frames()) * (films[i].scene.books.size() + 2);
  };
  std::vector<std::size_t> queue(films.size());
  std::iota(queue.begin(), queue.end(), 0U);
  std::stable_sort(queue.begin(), queue.end(), [&](std::size_t a, std::size_t b) { return cost(a) < cost(b); });

  std::vector<FilmOutcome> outcomes(films.size());
  std::map<std::size_t, Process> running;  // by film
  bool stopping = false;
  const auto look = [&] {
    progress.frames_simulated = shared->frames_simulated.load();
    progress.frames_drawn = shared->frames_drawn.load();
    progress.films_done = shared->films_done.load();
    if (stopping || go_on()) return;
    stopping = true;
    queue.clear();
    for (const auto& [i, process] : running) process.ask_to_stop();
  };
  for (look(); !queue.empty() || !running.empty(); look()) {
    while (!queue.empty() && running.size() < static_cast<std::size_t>(workers)) {
      const std::size_t i = queue.back();
      queue.pop_back();
      // The last film is for all workers: those that are still at another one come to it when that is done.
      const int free = workers - static_cast<int>(running.size());
      const int share = queue.empty() ? workers : free / static_cast<int>(queue.size() + 1);
      try {
        running.try_emplace(i,
                            [&, i](const std::stop_token& stop) { return work(films[i], stop, std::max(1, share)); });
      } catch (const std::runtime_error& error) {
        outcomes[i].error = error.what();
      }
    }
    std::vector<pollfd> pipes;
    for (const auto& [i, process] : running) pipes.push_back({process.descriptor(), POLLIN, 0});
    if (poll(pipes.data(), pipes.size(), 100) <= 0) continue;
    auto pipe = pipes.begin();
    for (auto at = running.begin(); at != running.end(); ++pipe) {
      auto& [i, process] = *at;
      if (pipe->revents == 0 || process.read()) {
        ++at;
        continue;
      }
      try {
        outcomes[i].receipt = receipt_of(process.result());
      } catch (const std::runtime_error& error) {
        if (!stopping) outcomes[i].error = error.what();
      }
      at = running.erase(at);
    }
  }
  // What a process that was killed has left.
  if (std::ranges::any_of(outcomes, [](const FilmOutcome& outcome) { return !outcome.error.empty(); })) settle(folder);
  return outcomes;
}

Image draw_frame(const Scene& scene, int frame, int width, int height, const fs::path& assets,
                 const std::stop_token& stop) {
  const Trajectory trajectory = simulate(scene, stop);
  const Storyboard storyboard(scene, trajectory, width, height);
  return Renderer(width, height, assets).draw(storyboard.shot(frame));
}

}  // namespace bookspin
