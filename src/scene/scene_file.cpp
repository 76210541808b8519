#include "scene/scene_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "files/files.h"
#include "scene/any_book.h"
#include "scene/override.h"
#include "scene/simulate.h"
#include "scene/table_reader.h"
#include "scene/toml.h"

namespace bookspin {
namespace {

const Words style_names{"solid", "ghost"};

constexpr int most_frames = 100000;       // half an hour at 60 frames a second
constexpr int most_book_frames = 300000;  // books times frames: what a trajectory may take of memory
constexpr int most_books = 8;
constexpr long most_steps = 10'000'000'000;  // hours

constexpr Range positive{0.0, largest_number, true};
constexpr Range signed_number{-largest_number, largest_number};

void read_clip(TableReader& reader, Clip& clip) {
  reader.read("frames", clip.frames, 1, most_frames,
              "frames of the film; frame 0 is the start, one alone is a still; a film ends a second after all its "
              "books have exploded and gone");
  reader.read("fps", clip.fps, 1, 240, "frames a second");
  reader.read("time_per_frame", clip.time_per_frame, positive, "simulated time from one frame to the next");
  reader.read("substeps", clip.substeps, 1, 1000000,
              "integration steps in each frame; the step is h = time_per_frame / substeps");
}

void read_view(TableReader& reader, ViewSetup& view) {
  reader.read("from", view.from, signed_number,
              "direction from the books to the camera, not straight up or down; the distance follows from the motion");
  if (view.from.x() == 0.0 && view.from.z() == 0.0) {
    reader.fail("from", "a direction that does not point straight up or down: x or z not 0");
  }
  for (const std::size_t i : reader.read_words("head_up", names_of(quantities),
                                               "shown with the time while the film runs; none: no time either",
                                               "a list of quantities, as below")) {
    view.head_up.push_back(quantities[i].id);
  }
}

// The paper's damping is on or off; a number is a multiple of its critical damping.
void read_damping(TableReader& reader, double& damping) {
  const toml::node* node =
      reader.declare({"damping", "of springs: multiple of the critical damping; 0: none; true is 1, false is 0",
                      "true, false, or a number from 0 to 1000",
                      R"("type": ["boolean", "number"], "minimum": 0, "maximum": 1000)", fmt::format("{}", damping)});
  if (node == nullptr) return;
  if (node->is_boolean()) {
    damping = node->as_boolean()->get() ? 1.0 : 0.0;
    return;
  }
  const std::optional<double> value = node->is_number() ? node->value<double>() : std::nullopt;
  if (!value || !(*value >= 0.0 && *value <= 1000.0)) reader.fail("damping");
  damping = *value;
}

// One that the method takes, with the damping that the book has.
void read_integrator(TableReader& reader, BookSetup& book) {
  const toml::node* node =
      reader.declare({"integrator", "how the book is stepped", "",
                      fmt::format(R"("enum": ["{}"])", fmt::join(names_of(integrators), R"(", ")")),
                      fmt::format("\"{}\"", info_of(book.options.integrator).name),
                      "an integrator of the method, as below; none for exact"});
  if (node == nullptr) return;
  const std::optional<std::string> word = node->value<std::string>();
  const bool damped = book.method == Method::springs && book.options.damping > 0.0;
  Words allowed;
  Words undamped;  // what damping alone forbids
  for (const IntegratorInfo& integrator : integrators) {
    if (takes(book.method, damped, integrator)) {
      allowed.push_back(integrator.name);
      if (word != integrator.name) continue;
      book.options.integrator = integrator.id;
      return;
    }
    if (takes(book.method, false, integrator)) undamped.push_back(integrator.name);
  }
  if (allowed.empty()) reader.fail("integrator", "none: the exact motion takes no steps");
  std::string text =
      fmt::format("for {}{} one of {}", name_of(book.method), damped ? " with damping" : "", fmt::join(allowed, ", "));
  if (!undamped.empty()) text += fmt::format("; {} need damping = false", fmt::join(undamped, ", "));
  reader.fail_word(*node, "integrator", allowed, text);
}

void refuse_both(const TableReader& reader, const char* one, const char* other) {
  if (reader.has(one) && reader.has(other)) reader.fail(other, fmt::format("either {} or {}", one, other));
}

// `size` or `moments`: flat at most, and that where no spring has to keep it so.
void read_shape(TableReader& reader, const BookSetup& book, BookOptions& o) {
  constexpr Range moment{0.0, 1e12, true};
  reader.read("size", o.size, {0.0, largest_number}, "edge lengths along x, y, z; one of a flat book is 0");
  const char* key = "size";
  if (reader.read("moments", std::span(o.moments.data(), 3), "I1, I2, I3", moment,
                  "principal moments of inertia about x, y, z, in place of `size`: a book that has them is drawn")) {
    refuse_both(reader, "size", key = "moments");
    o.moments /= o.particle_mass;
    if (!o.moments.allFinite() || o.moments.minCoeff() < 1e-300) {
      reader.fail("moments", "three that are from 1e-300 to 1e+308 when divided by particle_mass");
    }
    const std::optional<Eigen::Vector3d> size = size_of(o.moments);
    if (!size) reader.fail("moments", "those of a body: none is greater than the sum of the other two");
    o.size = *size;
  } else if ((o.size.array() == 0.0).count() > 1 || (o.size.array() > 0.0 && o.size.array() < 1e-6).any()) {
    reader.fail("size", "edges from 1e-06 to 1e+06, and 0 for one of them");
  }
  if (book.method == Method::springs && o.size.minCoeff() == 0.0) {
    reader.fail(key, "three edges above 0: no spring keeps a flat book flat; matrix, quaternion and exact do");
  }
}

// `angular_velocity` or `angular_momentum`, and the orientation.
void read_start(TableReader& reader, BookSetup& book) {
  BookOptions& o = book.options;
  reader.read("angular_velocity", o.omega_W, signed_number,
              "at the start, about the book's x, y, z, in radians per unit of time");
  constexpr Range momentum{-1e12, 1e12};
  Eigen::Vector3d L_B;
  if (reader.read("angular_momentum", std::span(L_B.data(), 3), "x, y, z", momentum,
                  "at the start, about the book's x, y, z, in place of `angular_velocity`")) {
    refuse_both(reader, "angular_velocity", "angular_momentum");
    o.omega_W = L_B.cwiseQuotient(body_of(o).I_B);
  }
  std::array<double, 4> q{};
  if (reader.read(
          "orientation", q, "w, x, y, z", signed_number,
          "at the start, as a quaternion of any length above 0; without it the book's x, y, z are the world's")) {
    book.q_WB0 = Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
    if (book.q_WB0->norm() == 0.0) reader.fail("orientation", "not all of them 0");
    // One of length 1 stays as it is: a script that was written from a scene gives that scene.
    if (std::abs(book.q_WB0->squaredNorm() - 1.0) > 1e-15) normalize(*book.q_WB0);
  }
}

void read_book(TableReader& reader, BookSetup& book) {
  BookOptions& o = book.options;
  reader.read("name", book.name, "printed under the book");
  book.method = static_cast<Method>(
      reader.read_word("method", Words(method_names.begin(), method_names.end()),
                       "how the book is simulated: eight corners on 28 springs, a rotation matrix, a quaternion, "
                       "or the exact rigid motion, which takes no steps"));
  reader.read("particle_mass", o.particle_mass, positive, "mass of each of the eight corners");
  read_shape(reader, book, o);
  read_start(reader, book);
  reader.read("jiggle", book.jiggle, {0.0, 1.0},
              "length of a random vector added to the angular velocity, as a part of its length; the direction is the "
              "seed's, the same for all books");
  bool normalize = true;
  reader.read(
      "normalize", normalize,
      "springs: energy and center; matrix: by singular value decomposition; quaternion: to unit length; whatever "
      "the integrator");
  reader.read("normalize_every", o.normalize_every, 1, 1000000, "steps from one normalization to the next");
  if (!normalize) o.normalize_every = 0;
  read_damping(reader, o.damping);
  read_integrator(reader, book);
  reader.read("stiffness", o.stiffness, positive, "of springs: force per length of each of the 28");
  reader.read("position", book.position_W, signed_number,
              "where its picture is put; the camera sees each book as if it stood in the middle");
  book.style = static_cast<Style>(reader.read_word("style", style_names, "how the book is drawn"));
  for (const std::size_t i : reader.read_words("show", names_of(overlay_table), "what is drawn with the book",
                                               "a list of overlays, as below")) {
    book.show.insert(static_cast<Overlay>(i));
  }
}

// [first, last]; nothing when the key is absent.
std::optional<std::pair<int, int>> read_frame_pair(TableReader& reader, const char* meaning) {
  const toml::node* node = reader.declare(
      {"frames", meaning,
       fmt::format("two frames [first, last], from 0 to {}, the first not after the last", most_frames),
       fmt::format(R"("type": "array", "items": {{"type": "integer", "minimum": 0, "maximum": {}}}, "minItems": 2, )"
                   R"("maxItems": 2)",
                   most_frames)});
  if (node == nullptr) return {};
  const toml::array* list = node->as_array();
  if (list == nullptr || list->size() != 2 || !(*list)[0].is_integer() || !(*list)[1].is_integer()) {
    reader.fail("frames");
  }
  const auto first = (*list)[0].as_integer()->get();
  const auto last = (*list)[1].as_integer()->get();
  if (first < 0 || last < first || last > most_frames) reader.fail("frames");
  return std::pair{static_cast<int>(first), static_cast<int>(last)};
}

void read_frames(TableReader& reader, Expectation& e) {
  reader.read("frame", e.last_frame, 0, most_frames, "the one frame that is judged");
  const auto frames =
      read_frame_pair(reader, "the frames that are judged, in place of `frame`; without both the whole film is");
  if (frames && e.last_frame) reader.fail("frames", "either frame or frames");
  if (e.last_frame) e.first_frame = *e.last_frame;
  if (frames) std::tie(e.first_frame, e.last_frame) = *frames;
}

void read_expectation(TableReader& reader, Expectation& e, std::size_t books) {
  reader.read("says", e.says, "the claim in words");
  e.quantity =
      quantities[reader.read_word("quantity", names_of(quantities), "what is measured", "a quantity, as below")].id;
  reader.need("quantity");
  reader.read("book", e.book, 0, static_cast<int>(books) - 1, "of which book, from 0");
  read_frames(reader, e);
  constexpr Range any{-1e300, 1e300};
  reader.read("at_least", e.at_least, any, "every frame that is judged is at or above this");
  reader.read("at_most", e.at_most, any, "every frame that is judged is at or below this");
  reader.read("rises_to", e.rises_to, any, "some frame that is judged reaches this or passes it upwards");
  reader.read("falls_to", e.falls_to, any, "some frame that is judged reaches this or passes it downwards");
  if (!e.at_least && !e.at_most && !e.rises_to && !e.falls_to) {
    reader.fail_missing("at_least", "one of at_least, at_most (every frame), rises_to, falls_to (some frame)");
  }
}

void read_cue(TableReader& reader, Cue& cue, int after) {
  reader.read("says", cue.says, "one sentence, true as long as it stands");
  if (cue.says.empty()) reader.fail_missing("says", "a text in quotes, not empty");
  reader.need("says");
  const auto frames = read_frame_pair(reader, "when it stands");
  reader.need("frames");
  std::tie(cue.first_frame, cue.last_frame) = *frames;
  if (cue.first_frame <= after) {
    reader.fail("frames", fmt::format("frames after {}, the last of the cue before", after));
  }
}

Scene read_scene(const toml::table& table, std::vector<KeyTable>* record = nullptr) {
  TableReader reader(table, record);
  Scene scene;
  reader.read("title", scene.title, "shown in the picture and on the page");
  reader.need("title");
  if (scene.title.empty()) reader.fail("title", "a text in quotes, not empty");
  reader.read("caption", scene.caption, "the text below the film");
  int seed = 1;
  reader.read("seed", seed, 0, std::numeric_limits<int>::max(), "of the jiggle");
  scene.seed = static_cast<std::uint64_t>(seed);
  for (TableReader& clip : reader.table("clip", "length and steps")) {
    read_clip(clip, scene.clip);
    clip.done();
  }
  for (TableReader& view : reader.table("view", "camera and numbers in the picture")) {
    read_view(view, scene.view);
    view.done();
  }
  std::vector<TableReader> books = reader.tables("book", "one to eight of them");
  reader.need("book");
  const std::size_t most =
      std::min<std::size_t>(most_books, static_cast<std::size_t>(most_book_frames / scene.clip.frames));
  if (books.size() > most) {
    throw std::invalid_argument(fmt::format(
        "{}book: found {} books of {} frames; allowed: up to {} books, and books x frames up to {}",
        location(table.get("book")->source()), books.size(), scene.clip.frames, most_books, most_book_frames));
  }
  for (TableReader& book : books) {
    read_book(book, scene.books.emplace_back());
    book.done();
  }
  if (steps_of(scene) > most_steps) {
    throw std::invalid_argument(
        fmt::format("{}clip.substeps: found {} frames of {} steps, {} steps for all books; allowed: up to {} steps",
                    location(table["clip"]["substeps"].node()->source()), scene.clip.frames, scene.clip.substeps,
                    steps_of(scene), most_steps));
  }
  for (TableReader& expect : reader.tables("expect", "what the film must show, as numbers; at least one bound each")) {
    read_expectation(expect, scene.expectations.emplace_back(), books.size());
    expect.done();
  }
  for (TableReader& cue : reader.tables("cue", "captions of your own; without one the page finds them in the motion")) {
    const int after = scene.cues.empty() ? -1 : scene.cues.back().last_frame;
    read_cue(cue, scene.cues.emplace_back(), after);
    cue.done();
  }
  reader.done();
  return scene;
}

}  // namespace

std::vector<KeyTable> script_keys() {
  std::vector<KeyTable> tables;
  (void)read_scene(parse_toml("title = 'T'\nclip = {}\nview = {}\nbook = [{}, {}, {}, {}, {}, {}, {}, {}]\n"
                              "expect = [{quantity = 'tilt', at_least = 0}]\ncue = [{says = 'S', frames = [0, 0]}]",
                              "every table"),
                   &tables);
  std::rotate(tables.begin(), tables.end() - 1, tables.end());  // the root, which is read last, comes first
  return tables;
}

Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
  toml::table table = parse_toml(text, name);
  for (const std::string& text_of_one : overrides) apply_override(table, text_of_one);
  return read_scene(table);
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_file_or_pipe(file), file.string(), overrides);
}

std::vector<std::string> remarks_on(const Scene& scene) {
  std::vector<std::string> remarks;
  if (scene.clip.frames == 1) return remarks;
  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const BookSetup& book = scene.books[b];
    const double speed = book.options.omega_W.norm();
    const bool exact = book.method == Method::exact;
    const double turn = speed * scene.clip.time_per_frame / (exact ? 1 : scene.clip.substeps);
    if (speed == 0.0) {
      remarks.push_back(fmt::format("book.{}: does not turn: its angular_velocity is [0, 0, 0]", b));
    } else if (turn > (exact ? std::numbers::pi : 1.0)) {
      remarks.push_back(
          fmt::format("book.{}.angular_velocity: turns the book by {:.3g} radians from one {} to the next: are these "
                      "degrees? radians are meant",
                      b, turn, exact ? "frame" : "step"));
    }
  }
  return remarks;
}

}  // namespace bookspin
