#include "scene/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "files/files.h"
#include "scene/any_book.h"
#include "scene/override.h"
#include "scene/table_reader.h"
#include "scene/toml.h"

namespace bookspin {
namespace {

constexpr std::array<std::string_view, 4> method_names{"springs", "matrix", "quaternion", "exact"};
constexpr std::array<std::string_view, 2> style_names{"solid", "ghost"};

constexpr int most_frames = 100000;       // half an hour at 60 frames a second
constexpr int most_book_frames = 300000;  // books times frames: what a trajectory may take of memory
constexpr int most_books = 8;

Range positive() {
  return {0.0, largest_number, true};
}
Range signed_number() {
  return {-largest_number, largest_number};
}

std::vector<std::string_view> quantity_names() {
  std::vector<std::string_view> names;
  for (const Quantity& q : quantities) names.push_back(q.name);
  return names;
}

void read_clip(TableReader& scene_reader, Clip& clip) {
  const toml::node* node = scene_reader.node("clip");
  if (node == nullptr) return;
  if (!node->is_table()) scene_reader.fail(*node, "clip", "a table [clip]");
  TableReader reader(*node->as_table(), "clip");
  reader.read("frames", clip.frames, 1, most_frames);
  reader.read("fps", clip.fps, 1, 240);
  reader.read("time_per_frame", clip.time_per_frame, positive());
  reader.read("substeps", clip.substeps, 1, 1000000);
  reader.done();
}

void read_view(TableReader& scene_reader, ViewSetup& view) {
  const toml::node* node = scene_reader.node("view");
  if (node == nullptr) return;
  if (!node->is_table()) scene_reader.fail(*node, "view", "a table [view]");
  TableReader reader(*node->as_table(), "view");
  reader.read("from", view.from, signed_number());
  if (view.from.x() == 0.0 && view.from.z() == 0.0) {
    reader.fail(*reader.node("from"), "from", "a direction that does not point straight up or down: x or z not 0");
  }
  const std::vector<std::string_view> names = quantity_names();
  for (const std::size_t i : reader.read_words("head_up", names)) view.head_up.push_back(quantities[i].id);
  reader.done();
}

// The paper's damping is on or off; a number is a multiple of its critical damping.
void read_damping(TableReader& reader, double& damping) {
  const toml::node* node = reader.node("damping");
  if (node == nullptr) return;
  if (node->is_boolean()) {
    damping = node->as_boolean()->get() ? 1.0 : 0.0;
    return;
  }
  const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= 0.0 && *value <= 1000.0)) {
    reader.fail(*node, "damping", "true, false, or a number from 0 to 1000");
  }
  damping = *value;
}

// One that the method takes, with the damping that the book has.
void read_integrator(TableReader& reader, BookSetup& book) {
  const toml::node* node = reader.node("integrator");
  if (node == nullptr) return;
  const std::optional<std::string> word = node->value<std::string>();
  const bool damped = book.method == Method::springs && book.options.damping > 0.0;
  std::vector<std::string_view> allowed;
  std::vector<std::string_view> undamped;  // what damping alone forbids
  for (const IntegratorInfo& integrator : integrators) {
    if (takes(book.method, damped, integrator)) {
      allowed.push_back(integrator.name);
      if (word != integrator.name) continue;
      book.options.integrator = integrator.id;
      return;
    }
    if (takes(book.method, false, integrator)) undamped.push_back(integrator.name);
  }
  if (allowed.empty()) reader.fail(*node, "integrator", "none: the exact motion takes no steps");
  std::string text =
      fmt::format("for {}{} one of {}", name_of(book.method), damped ? " with damping" : "", fmt::join(allowed, ", "));
  if (!undamped.empty()) text += fmt::format("; {} need damping = false", fmt::join(undamped, " and "));
  reader.fail(*node, "integrator", text);
}

BookSetup read_book(const toml::table& table, const std::string& path) {
  TableReader reader(table, path);
  BookSetup book;
  BookOptions& o = book.options;
  reader.read("name", book.name);
  book.method = static_cast<Method>(reader.read_word("method", method_names, 0));
  reader.read("size", o.size, {1e-6, largest_number});
  reader.read("angular_velocity", o.omega_W, signed_number());
  reader.read("jiggle", book.jiggle, {0.0, 1.0});
  bool normalize = true;
  reader.read("normalize", normalize);
  reader.read("normalize_every", o.normalize_every, 1, 1000000);
  if (!normalize) o.normalize_every = 0;
  read_damping(reader, o.damping);
  read_integrator(reader, book);
  reader.read("stiffness", o.stiffness, positive());
  reader.read("particle_mass", o.particle_mass, positive());
  reader.read("position", book.position_W, signed_number());
  book.style = static_cast<Style>(reader.read_word("style", style_names, 0));
  for (const std::size_t i : reader.read_words("show", overlay_names)) book.show.insert(static_cast<Overlay>(i));
  reader.done();
  return book;
}

std::pair<int, int> read_frame_pair(TableReader& reader, const toml::node& node) {
  const std::string allowed =
      fmt::format("two frames [first, last], from 0 to {}, the first not after the last", most_frames);
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 2 || !(*list)[0].is_integer() || !(*list)[1].is_integer()) {
    reader.fail(node, "frames", allowed);
  }
  const auto first = (*list)[0].as_integer()->get();
  const auto last = (*list)[1].as_integer()->get();
  if (first < 0 || last < first || last > most_frames) reader.fail(node, "frames", allowed);
  return {static_cast<int>(first), static_cast<int>(last)};
}

void read_frames(TableReader& reader, Expectation& e) {
  if (reader.has("frame")) {
    reader.read("frame", e.first_frame, 0, most_frames);
    e.last_frame = e.first_frame;
    if (reader.has("frames")) reader.fail(*reader.node("frames"), "frames", "either frame or frames");
  }
  const toml::node* node = reader.node("frames");
  if (node == nullptr) return;
  const auto [first, last] = read_frame_pair(reader, *node);
  e.first_frame = first;
  e.last_frame = last;
}

Expectation read_expectation(const toml::table& table, const std::string& path, int books) {
  TableReader reader(table, path);
  Expectation e;
  const std::vector<std::string_view> names = quantity_names();
  reader.read("says", e.says);
  if (!reader.has("quantity")) reader.fail_missing("quantity", fmt::format("one of {}", fmt::join(names, ", ")));
  e.quantity = quantities[reader.read_word("quantity", names, 0)].id;
  reader.read("book", e.book, 0, books - 1);
  reader.node("frame");  // known, though most expectations give a range or nothing
  read_frames(reader, e);
  for (const auto& [key, bound] : {std::pair{"at_least", &e.at_least}, std::pair{"at_most", &e.at_most},
                                   std::pair{"rises_to", &e.rises_to}, std::pair{"falls_to", &e.falls_to}}) {
    reader.read(key, *bound, {-1e300, 1e300});
  }
  if (!e.at_least && !e.at_most && !e.rises_to && !e.falls_to) {
    reader.fail_missing("at_least", "one of at_least, at_most (every frame), rises_to, falls_to (some frame)");
  }
  reader.done();
  return e;
}

Cue read_cue(const toml::table& table, const std::string& path, const std::vector<Cue>& before) {
  TableReader reader(table, path);
  Cue cue;
  reader.read("says", cue.says);
  if (cue.says.empty()) reader.fail_missing("says", "a text in quotes, not empty");
  const toml::node* node = reader.node("frames");
  if (node == nullptr) reader.fail_missing("frames", "two frames [first, last]");
  std::tie(cue.first_frame, cue.last_frame) = read_frame_pair(reader, *node);
  if (!before.empty() && cue.first_frame <= before.back().last_frame) {
    reader.fail(*node, "frames", fmt::format("frames after {}, the last of the cue before", before.back().last_frame));
  }
  reader.done();
  return cue;
}

const toml::array* tables(TableReader& reader, std::string_view key) {
  const toml::node* node = reader.node(key);
  if (node == nullptr) return nullptr;
  const toml::array* list = node->as_array();
  if (list == nullptr || list->empty()) reader.fail(*node, key, fmt::format("one or more tables [[{}]]", key));
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& one = (*list)[i];
    if (!one.is_table()) reader.fail(one, fmt::format("{}.{}", key, i), fmt::format("a table [[{}]]", key));
  }
  return list;
}

Scene read_scene(const toml::table& table) {
  TableReader reader(table, "");
  Scene scene;
  reader.read("title", scene.title);
  if (!reader.has("title")) reader.fail_missing("title", "a text in quotes");
  if (scene.title.empty()) reader.fail(*reader.node("title"), "title", "a text in quotes, not empty");
  reader.read("caption", scene.caption);
  int seed = 1;
  reader.read("seed", seed, 0, std::numeric_limits<int>::max());
  scene.seed = static_cast<std::uint64_t>(seed);
  read_clip(reader, scene.clip);
  read_view(reader, scene.view);
  const toml::array* books = tables(reader, "book");
  if (books == nullptr) reader.fail_missing("book", "one or more tables [[book]]");
  const std::size_t most =
      std::min<std::size_t>(most_books, static_cast<std::size_t>(most_book_frames / scene.clip.frames));
  if (books->size() > most) {
    throw std::invalid_argument(
        fmt::format("{}book: found {} books of {} frames; allowed: up to {} books, and books x frames up to {}",
                    location(books->source()), books->size(), scene.clip.frames, most_books, most_book_frames));
  }
  for (std::size_t i = 0; i < books->size(); ++i) {
    scene.books.push_back(read_book(*(*books)[i].as_table(), fmt::format("book.{}", i)));
  }
  if (const toml::array* list = tables(reader, "expect")) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      scene.expectations.push_back(
          read_expectation(*(*list)[i].as_table(), fmt::format("expect.{}", i), static_cast<int>(scene.books.size())));
    }
  }
  if (const toml::array* list = tables(reader, "cue")) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      scene.cues.push_back(read_cue(*(*list)[i].as_table(), fmt::format("cue.{}", i), scene.cues));
    }
  }
  reader.done();
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
  toml::table table = parse_toml(text, name);
  for (const std::string& text_of_one : overrides) apply_override(table, text_of_one);
  return read_scene(table);
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_file(file), file.string(), overrides);
}

std::string_view name_of(Method method) {
  return method_names[static_cast<std::size_t>(method)];
}

}  // namespace bookspin
