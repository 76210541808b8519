#include "video/i420.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace bookspin {
namespace {

// Fixed point with 16 fractional bits: coefficients then fit 16 bits, and compilers multiply eight of them at once even
// on the oldest x86-64. The worst sum is 0.006 of a level off, which matters only where the exact value is that near to
// a half.
constexpr int fraction_bits = 16;
constexpr double one = 1 << fraction_bits;
constexpr double luma_range = 219.0 / 255.0 * one;
constexpr double chroma_range = 224.0 / 255.0 * one;

constexpr int round_to_int(double x) {
  return static_cast<int>(x < 0 ? x - 0.5 : x + 0.5);
}

constexpr auto y_r = static_cast<std::uint16_t>(round_to_int(0.2126 * luma_range));
constexpr auto y_g = static_cast<std::uint16_t>(round_to_int(0.7152 * luma_range));
constexpr auto y_b = static_cast<std::uint16_t>(round_to_int(0.0722 * luma_range));

// Each chroma row sums to 0, so that grays stay exactly gray.
constexpr auto cb_r = static_cast<std::int16_t>(round_to_int(-0.2126 / 1.8556 * chroma_range));
constexpr auto cb_b = static_cast<std::int16_t>(round_to_int(0.5 * chroma_range));
constexpr auto cb_g = static_cast<std::int16_t>(-cb_r - cb_b);
constexpr auto cr_r = cb_b;
constexpr auto cr_b = static_cast<std::int16_t>(round_to_int(-0.0722 / 1.5748 * chroma_range));
constexpr auto cr_g = static_cast<std::int16_t>(-cr_r - cr_b);

// A stretch of one row, channel by channel. Cell 0 is the pixel left of the first one converted: the chroma filter
// reaches there.
struct PlanarRow {
  std::vector<std::uint16_t> r, g, b;

  explicit PlanarRow(std::size_t pixels) : r(pixels + 1), g(pixels + 1), b(pixels + 1) {}
};

// `rgba` points at the first pixel converted; the one before it is read only when there is one.
void load(const std::uint8_t* rgba, bool has_left, PlanarRow& row) {
  std::uint16_t* __restrict r = row.r.data() + 1;
  std::uint16_t* __restrict g = row.g.data() + 1;
  std::uint16_t* __restrict b = row.b.data() + 1;
  const std::size_t pixels = row.r.size() - 1;
  for (std::size_t x = 0; x < pixels; ++x) {
    r[x] = rgba[4 * x];
    g[x] = rgba[4 * x + 1];
    b[x] = rgba[4 * x + 2];
  }
  const std::uint8_t* left = has_left ? rgba - 4 : rgba;
  row.r[0] = left[0];
  row.g[0] = left[1];
  row.b[0] = left[2];
}

void write_luma(const PlanarRow& row, std::uint8_t* __restrict y) {
  const std::uint16_t* r = row.r.data() + 1;
  const std::uint16_t* g = row.g.data() + 1;
  const std::uint16_t* b = row.b.data() + 1;
  const std::size_t pixels = row.r.size() - 1;
  constexpr std::uint32_t offset = (16U << fraction_bits) + (1U << (fraction_bits - 1));
  for (std::size_t x = 0; x < pixels; ++x) {
    const std::uint32_t sum =
        std::uint32_t{r[x]} * y_r + std::uint32_t{g[x]} * y_g + std::uint32_t{b[x]} * y_b + offset;
    y[x] = static_cast<std::uint8_t>(sum >> fraction_bits);
  }
}

void add(std::vector<std::uint16_t>& sum, const std::vector<std::uint16_t>& row) {
  std::uint16_t* __restrict s = sum.data();
  const std::uint16_t* __restrict a = row.data();
  const std::size_t cells = sum.size();
  for (std::size_t x = 0; x < cells; ++x) s[x] = static_cast<std::uint16_t>(s[x] + a[x]);
}

// `sum` holds the sum of two rows; the eight weights 1 2 1 / 1 2 1 leave three more fractional bits.
void write_chroma(const PlanarRow& sum, std::uint8_t* __restrict cb, std::uint8_t* __restrict cr) {
  const std::uint16_t* r = sum.r.data();
  const std::uint16_t* g = sum.g.data();
  const std::uint16_t* b = sum.b.data();
  const std::size_t samples = (sum.r.size() - 1) / 2;
  constexpr int shift = fraction_bits + 3;
  constexpr int offset = (128 << shift) + (1 << (shift - 1));
  const auto filter = [](const std::uint16_t* p) { return static_cast<std::int16_t>(p[0] + 2 * p[1] + p[2]); };
  for (std::size_t c = 0; c < samples; ++c) {
    const std::int16_t r8 = filter(r + 2 * c);
    const std::int16_t g8 = filter(g + 2 * c);
    const std::int16_t b8 = filter(b + 2 * c);
    cb[c] = static_cast<std::uint8_t>((r8 * cb_r + g8 * cb_g + b8 * cb_b + offset) >> shift);
    cr[c] = static_cast<std::uint8_t>((r8 * cr_r + g8 * cr_g + b8 * cr_b + offset) >> shift);
  }
}

}  // namespace

void convert_to_i420(const Image& image, Rect changed, const I420Planes& planes) {
  assert(image.width % 2 == 0 && image.height % 2 == 0);
  assert(changed.empty() || (changed.x >= 0 && changed.y >= 0 && changed.x + changed.width <= image.width &&
                             changed.y + changed.height <= image.height));
  if (changed.empty()) return;

  // Outwards to whole 2x2 blocks; on the right one block more, whose filter reaches back to the last changed column.
  const int first_c = changed.x / 2;
  const int end_c = std::min(image.width / 2, (changed.x + changed.width) / 2 + 1);
  const int first_row = changed.y / 2;
  const int end_row = (changed.y + changed.height + 1) / 2;

  const std::size_t pixels = 2 * static_cast<std::size_t>(end_c - first_c);
  PlanarRow top(pixels);
  PlanarRow bottom(pixels);
  const std::ptrdiff_t image_stride = 4 * static_cast<std::ptrdiff_t>(image.width);
  for (std::ptrdiff_t row = first_row; row < end_row; ++row) {
    const std::uint8_t* rgba = image.rgba.data() + 2 * row * image_stride + 8 * static_cast<std::ptrdiff_t>(first_c);
    std::uint8_t* y = planes.y + 2 * row * planes.y_stride + 2 * static_cast<std::ptrdiff_t>(first_c);
    load(rgba, first_c > 0, top);
    load(rgba + image_stride, first_c > 0, bottom);
    write_luma(top, y);
    write_luma(bottom, y + planes.y_stride);
    add(top.r, bottom.r);
    add(top.g, bottom.g);
    add(top.b, bottom.b);
    write_chroma(top, planes.cb + row * planes.cb_stride + first_c, planes.cr + row * planes.cr_stride + first_c);
  }
}

}  // namespace bookspin
