#include "live/live.h"

#include <vector>

#include "scene/any_book.h"
#include "scene/book_run.h"

using namespace bookspin;

struct live {
  int frames;  // of the whole motion
  std::vector<BookRun> runs;
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
    return Eigen::Vector3d(next_[-3], next_[-2], next_[-1]);
  }

 private:
  const double* next_;
};

template <class Table, class Column>
const char* cell(const Table& table, int row, const Column& column) {
  const auto i = static_cast<std::size_t>(row);
  return i < table.size() ? column(table[i]).data() : nullptr;  // literals: each ends in a zero
}

}  // namespace

live* live_open(const double* numbers, int books) {
  Numbers next(numbers);
  Clip clip;
  clip.frames = next.whole();
  clip.time_per_frame = next.number();
  clip.substeps = next.whole();
  const auto seed = static_cast<std::uint64_t>(next.number());
  auto* self = new live{clip.frames, {}};
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
    self->runs.emplace_back(book, clip, seed);
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
