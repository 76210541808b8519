#include "live/live.h"

#include <algorithm>
#include <initializer_list>
#include <vector>

#include "film/framing.h"
#include "image/halved.h"
#include "render/bend.h"
#include "render/book_mesh.h"
#include "render/strokes.h"
#include "scene/any_book.h"
#include "scene/book_run.h"

using namespace bookspin;

struct live {
  int frames;  // of the whole motion
  std::vector<BookSetup> books;
  std::vector<BookRun> runs;
  std::vector<std::vector<Sphere>> spheres;  // what is to be seen of each book while it is healthy
  std::vector<float> picture;
};

namespace {

static_assert(sizeof(BookFrame) == (24 + 4 + 4 + 3 + 3 + quantity_count) * sizeof(double));

class Numbers {
 public:
  explicit Numbers(const double* next) : next_(next) {}
  double number() { return *next_++; }
  int whole() { return static_cast<int>(number()); }
  Eigen::Vector3d vector() {
    next_ += 3;
    return {next_[-3], next_[-2], next_[-1]};
  }

 private:
  const double* next_;
};

template <class Table, class Column>
const char* cell(const Table& table, int row, const Column& column) {
  const auto i = static_cast<std::size_t>(row);
  return i < table.size() ? column(table[i]).data() : nullptr;  // literals: each ends in a zero
}

constexpr int frames_a_second = 60;
constexpr double band = 0.96;            // of the height, for the books
constexpr double room_to_shiver = 1.08;  // of what a healthy book reaches

void put(std::vector<float>& out, int kind, std::initializer_list<double> head,
         std::initializer_list<const float*> blocks, std::initializer_list<std::size_t> sizes) {
  std::size_t count = head.size();
  for (const std::size_t size : sizes) count += size;
  out.push_back(static_cast<float>(kind));
  out.push_back(static_cast<float>(count));
  for (const double number : head) out.push_back(static_cast<float>(number));
  const std::size_t* size = sizes.begin();
  for (const float* block : blocks) out.insert(out.end(), block, block + *size++);
}

void put_book(std::vector<float>& out, const View& camera, const BookPose& book) {
  const View view = camera.shifted(book.shift);
  const Eigen::Matrix<float, 3, 8> corners_C =
      (view.R_CW() * (book.corners_W.colwise() - view.eye_W()) / view.distance()).cast<float>();
  const Eigen::Matrix4f clip_from_camera = view.clip_from_unit_camera().cast<float>();
  const Eigen::Vector2f half_frame = view.half_frame().cast<float>();
  put(out, book.style == BookStyle::ghost ? 1 : 0,
      {book.brightness, is_unbent(book.corners_W) ? 1.0 : 0.0, keeps_orientation(book.corners_W) ? 1.0 : 0.0},
      {corners_C.data(), clip_from_camera.data(), half_frame.data()}, {24, 16, 2});
}

void put_arrow(std::vector<float>& out, const View& camera, const Arrow& arrow) {
  if (!((arrow.to_W - arrow.from_W).norm() > 0)) return;
  const View view = camera.shifted(arrow.shift);
  const Eigen::Matrix4f clip_from_world = view.clip_from_world().cast<float>();
  const Eigen::Matrix3f R_CW = view.R_CW().cast<float>();
  const std::vector<float> vertices = arrow_triangles(arrow);
  put(out, 2, {}, {clip_from_world.data(), R_CW.data(), vertices.data()}, {16, 9, vertices.size()});
}

}  // namespace

live* live_open(const double* numbers, int books) {
  Numbers next(numbers);
  Clip clip;
  clip.frames = next.whole();
  clip.time_per_frame = next.number();
  clip.substeps = next.whole();
  const auto seed = static_cast<std::uint64_t>(next.number());
  auto* self = new live{clip.frames, {}, {}, {}, {}};
  for (int b = 0; b < books; ++b) {
    BookSetup book;
    BookOptions& o = book.options;
    book.method = static_cast<Method>(next.whole());
    o.integrator = static_cast<Integrator>(next.whole());
    o.size = next.vector();
    o.moments = next.vector();
    Eigen::Quaterniond q;
    q.w() = next.number();
    q.vec() = next.vector();
    if (q.norm() != 0.0) book.q_WB0 = q;
    o.omega_W = next.vector();
    book.jiggle = next.number();
    o.normalize_every = next.whole();
    o.damping = next.number();
    o.stiffness = next.number();
    o.particle_mass = next.number();
    book.position_W = next.vector();
    book.style = next.whole() != 0 ? Style::ghost : Style::solid;
    const int show = next.whole();
    for (std::size_t i = 0; i < overlay_table.size(); ++i) {
      if ((show >> i & 1) != 0) book.show.insert(static_cast<Overlay>(i));
    }
    self->runs.emplace_back(book, clip, seed);
    self->spheres.push_back(overlay_reach(book, self->runs.back().track()));
    self->spheres.back().push_back({Eigen::Vector3d::Zero(), room_to_shiver * body_of(o).reach});
    self->books.push_back(book);
  }
  return self;
}

void live_close(live* self) {
  delete self;
}

int live_advance(live* self, int frames) {
  int there = static_cast<int>(self->runs.front().track().frames.size());
  for (; frames > 0 && there < self->frames; --frames, ++there) {
    for (BookRun& run : self->runs) run.advance();
  }
  return there;
}

const double* live_track(const live* self, int book) {
  return self->runs[static_cast<std::size_t>(book)].track().frames.front().corners_W.data();
}

int live_doubles() {
  return sizeof(BookFrame) / sizeof(double);
}

int live_exploded(const live* self, int book) {
  return self->runs[static_cast<std::size_t>(book)].track().exploded_frame.value_or(-1);
}

const void* const* live_mesh(int fineness) {
  static BookMesh mesh;
  static std::vector<const void*> parts;
  mesh = hardcover(fineness);
  parts.clear();
  const auto add = [](const auto& list, std::size_t numbers) {
    parts.push_back(list.data());
    parts.push_back(reinterpret_cast<const void*>(list.size() * numbers));  // NOLINT(*-int-to-ptr): a count
  };
  add(mesh.vertices, sizeof(BookVertex) / sizeof(float));
  add(mesh.borders, sizeof(BorderVertex) / sizeof(float));
  for (const auto& part : mesh.triangles) add(part, 1);
  return parts.data();
}

const unsigned char* live_halved(const unsigned char* rgba, int width, int height) {
  static Image half;
  Image image(width, height);
  std::copy_n(rgba, image.rgba.size(), image.rgba.begin());
  half = halved(image);
  return half.rgba.data();
}

const float* live_picture(live* self, int frame, const double from[3], double zoom, int width, int height) {
  const Eigen::Vector3d from_W(from[0], from[1], from[2]);
  const Eigen::Matrix3d R_CW = camera_axes(from_W);
  std::vector<Stand> stands;
  for (std::size_t b = 0; b < self->books.size(); ++b) {
    stands.push_back({(R_CW * self->books[b].position_W).head<2>(), self->spheres[b]});
  }
  Camera camera;
  camera.vertical_fov = film_fov;
  const double distance = distance_that_frames(stands, R_CW, static_cast<double>(width) / height, band) / zoom;
  camera.eye_W = distance * R_CW.row(2).transpose();
  const Eigen::Vector2d middle = picture_of(stands, R_CW, distance * zoom).center();

  Shot shot;
  shot.camera = camera;
  for (std::size_t b = 0; b < self->books.size(); ++b) {
    const BookSetup& setup = self->books[b];
    const BookTrack& track = self->runs[b].track();
    const bool gone = is_gone(track.frames[static_cast<std::size_t>(frame)], distance / body_of(setup.options).reach);
    add_book(shot, setup, track, frame, frames_a_second, gone, shift_of(stands[b], distance, middle));
  }

  // In the renderer's order; what is not in sight is not drawn.
  const View view(camera, width, height);
  const auto in_sight = [&](const Eigen::Vector3d& point_W) { return view.drawable(point_W); };
  const auto draw_books = [&](BookStyle style) {
    for (const BookPose& book : shot.books) {
      bool drawable = book.style == style;
      for (int i = 0; i < 8; ++i) drawable = drawable && in_sight(book.corners_W.col(i));
      if (drawable) put_book(self->picture, view, book);
    }
  };
  self->picture.clear();
  draw_books(BookStyle::solid);
  for (const Arrow& arrow : shot.arrows) {
    if (in_sight(arrow.from_W) && in_sight(arrow.to_W)) put_arrow(self->picture, view, arrow);
  }
  std::erase_if(shot.lines, [&](const Line& line) { return !in_sight(line.from_W) || !in_sight(line.to_W); });
  for (const bool opaque : {true, false}) {
    const std::vector<float> vertices = line_triangles(view, shot.lines, opaque);
    if (!vertices.empty()) put(self->picture, opaque ? 3 : 4, {}, {vertices.data()}, {vertices.size()});
  }
  draw_books(BookStyle::ghost);
  self->picture.push_back(-1.0F);
  return self->picture.data();
}

const char* live_word(int table, int row) {
  switch (table) {
    case live_methods:
      return cell(method_names, row, [](std::string_view name) { return name; });
    case live_integrators:
      return cell(integrators, row, [](const IntegratorInfo& i) { return i.name; });
    case live_overlays:
      return cell(overlay_table, row, [](const OverlayInfo& o) { return o.name; });
    case live_quantities:
      return cell(quantities, row, [](const Quantity& q) { return q.name; });
    case live_symbols:
      return cell(quantities, row, [](const Quantity& q) { return q.symbol; });
    case live_titles:
      return cell(quantities, row, [](const Quantity& q) { return q.title; });
    case live_units:
      return cell(quantities, row, [](const Quantity& q) { return q.shown_unit; });
    default:
      return nullptr;
  }
}

int live_takes(int method, int damped, int integrator) {
  return takes(static_cast<Method>(method), damped != 0, info_of(static_cast<Integrator>(integrator))) ? 1 : 0;
}

double live_axis(int quantity, int which) {
  const Quantity& q = quantities[static_cast<std::size_t>(quantity)];
  return which == 0 ? q.shown_scale : which == 1 ? q.axis.low : which == 2 ? q.axis.high : q.axis.most;
}
