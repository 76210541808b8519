#include "render/text.h"

#include <fmt/format.h>
#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "render/renderer.h"

namespace bookspin {
namespace {

constexpr Color rim_color{14, 18, 24, 255};
constexpr int rim_strength = 200;  // of 255
constexpr int phases = 4;          // positions of a glyph within a pixel

// The characters of UTF-8 text; a byte that is no part of any becomes U+FFFD, a line's end or a tab a space.
std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> result;
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i++]);
    int left = first < 0x80 ? 0 : first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : first >= 0xC0 ? 1 : -1;
    char32_t character = left <= 0 ? std::max<char32_t>(first, U' ') : first & (0x3FU >> left);
    while (left > 0 && i < text.size() && (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U) {
      character = (character << 6U) | (static_cast<unsigned char>(text[i++]) & 0x3FU);
      --left;
    }
    result.push_back(left == 0 ? character : U'\uFFFD');
  }
  return result;
}

// Of a pixel in a mask of that width.
std::size_t index(int x, int y, int width) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
}

bool is_digit(char32_t c) {
  return c >= U'0' && c <= U'9';
}

// The cover spread over a disc with a soft edge.
std::vector<std::uint8_t> spread(const std::vector<std::uint8_t>& cover, int width, int height, double radius) {
  std::vector<std::uint8_t> result(cover.size());
  const int reach = static_cast<int>(std::ceil(radius));
  for (int dy = -reach; dy <= reach; ++dy) {
    for (int dx = -reach; dx <= reach; ++dx) {
      const double fade = std::clamp(2 * (1 - std::hypot(dx, dy) / (radius + 0.5)), 0.0, 1.0);
      const int weight = static_cast<int>(std::lround(256 * fade));
      if (weight == 0) continue;
      for (int y = std::max(0, dy); y < std::min(height, height + dy); ++y) {
        for (int x = std::max(0, dx); x < std::min(width, width + dx); ++x) {
          const std::size_t source = index(x - dx, y - dy, width);
          const std::size_t target = index(x, y, width);
          result[target] =
              std::max(result[target], static_cast<std::uint8_t>(std::min(255, cover[source] * weight / 256)));
        }
      }
    }
  }
  return result;
}

std::uint8_t mix(int from, int to, int weight) {  // weight 0 ... 255
  return static_cast<std::uint8_t>((from * (255 - weight) + to * weight + 127) / 255);
}

void blend(std::uint8_t* pixel, const Color& color, int weight) {
  pixel[0] = mix(pixel[0], color.r, weight);
  pixel[1] = mix(pixel[1], color.g, weight);
  pixel[2] = mix(pixel[2], color.b, weight);
}

}  // namespace

struct TextPainter::Fonts {
  FT_Library library = nullptr;
  std::array<FT_Face, 2> faces{};

  static void check(FT_Error error, const char* file, const char* operation) {
    if (error == 0) return;
    const char* const reason = FT_Error_String(error);
    throw std::runtime_error(fmt::format("{}: {}: {}", file, operation,
                                         reason != nullptr ? reason : fmt::format("FreeType error {:#04x}", error)));
  }

  Fonts() {
    check(FT_Init_FreeType(&library), BOOKSPIN_FONT_REGULAR, "start FreeType");
    try {
      check(FT_New_Face(library, BOOKSPIN_FONT_REGULAR, 0, faces.data()), BOOKSPIN_FONT_REGULAR, "open font");
      check(FT_New_Face(library, BOOKSPIN_FONT_SEMIBOLD, 0, faces.data() + 1), BOOKSPIN_FONT_SEMIBOLD, "open font");
    } catch (...) {
      FT_Done_FreeType(library);
      throw;
    }
  }
  ~Fonts() { FT_Done_FreeType(library); }  // and the faces with it
  Fonts(const Fonts&) = delete;
  Fonts& operator=(const Fonts&) = delete;
};

std::vector<std::string> font_files() {
  return {BOOKSPIN_FONT_REGULAR, BOOKSPIN_FONT_SEMIBOLD};
}

TextPainter::TextPainter() : fonts_(std::make_unique<Fonts>()) {}
TextPainter::~TextPainter() = default;

const Glyph& TextPainter::glyph(const Key& key) {
  if (const auto found = glyphs_.find(key); found != glyphs_.end()) return found->second;

  const auto& [weight, em, character, phase_x, phase_y] = key;
  const bool regular = weight == Weight::regular;
  FT_FaceRec* const face = fonts_->faces[regular ? 0 : 1];
  const char* const file = regular ? BOOKSPIN_FONT_REGULAR : BOOKSPIN_FONT_SEMIBOLD;
  Fonts::check(FT_Set_Pixel_Sizes(face, 0, static_cast<FT_UInt>(em)), file, "set font size");
  Fonts::check(FT_Load_Char(face, character, FT_LOAD_NO_BITMAP | FT_LOAD_NO_HINTING), file, "load glyph");
  FT_Outline_Translate(&face->glyph->outline, phase_x * 64 / phases, -phase_y * 64 / phases);
  Fonts::check(FT_Render_Glyph(face->glyph, FT_RENDER_MODE_NORMAL), file, "draw glyph");

  const FT_GlyphSlotRec* const slot = face->glyph;
  const FT_Bitmap& bitmap = slot->bitmap;
  const double rim_radius = std::max(1.0, em / 11.0);
  const int border = static_cast<int>(std::ceil(rim_radius));
  Glyph glyph;
  glyph.advance = static_cast<double>(slot->linearHoriAdvance) / 65536;
  if (bitmap.width > 0) {
    glyph.left = slot->bitmap_left - border;
    glyph.top = -slot->bitmap_top - border;
    glyph.width = static_cast<int>(bitmap.width) + 2 * border;
    glyph.height = static_cast<int>(bitmap.rows) + 2 * border;
    glyph.cover.resize(index(0, glyph.height, glyph.width));
    for (int y = 0; y < static_cast<int>(bitmap.rows); ++y) {
      const std::uint8_t* const row = bitmap.buffer + std::ptrdiff_t{y} * bitmap.pitch;
      std::copy_n(row, bitmap.width, glyph.cover.data() + index(border, y + border, glyph.width));
    }
    glyph.rim = spread(glyph.cover, glyph.width, glyph.height, rim_radius);
  }
  return glyphs_.emplace(key, std::move(glyph)).first->second;
}

double TextPainter::digit_advance(Weight weight, int em) {
  double widest = 0;
  for (char32_t digit = U'0'; digit <= U'9'; ++digit) {
    widest = std::max(widest, glyph({weight, em, digit, 0, 0}).advance);
  }
  return std::ceil(widest * phases) /
         phases;  // so that a digit looks the same wherever it stands a whole number of digits on
}

TextLayout TextPainter::lay_out(const Label& label, const View& view, int width, int height) {
  TextLayout layout;
  layout.color = label.color;
  const int em = std::max(1, static_cast<int>(std::lround(label.height * height)));
  double x = label.position.x() * width;
  double y = label.position.y() * height;
  if (label.anchor_W) {
    if (!view.drawable(*label.anchor_W)) return layout;
    const PixelPoint anchor = view.project(*label.anchor_W);
    if (!(anchor.depth > view.near())) return layout;
    x = anchor.x + label.position.x() * height;
    y = anchor.y + label.position.y() * height;
  } else {
    y = std::round(y);  // what stands still stands sharp
  }
  if (!(std::abs(x) < 4.0 * width && std::abs(y) < 4.0 * height)) return layout;

  const double digit = label.tabular ? digit_advance(label.weight, em) : 0;
  const std::vector<char32_t> text = characters(label.text);
  const auto advance = [&](char32_t c) {
    return label.tabular && is_digit(c) ? digit : glyph({label.weight, em, c, 0, 0}).advance;
  };
  for (const char32_t c : text) layout.length += advance(c);
  if (label.align == Align::center) x -= layout.length / 2;
  if (label.align == Align::right) x -= layout.length;

  for (const char32_t c : text) {
    const double step = advance(c);
    const double own = glyph({label.weight, em, c, 0, 0}).advance;
    const auto pen_x = static_cast<int>(std::lround((x + (step - own) / 2) * phases));
    const auto pen_y = static_cast<int>(std::lround(y * phases));
    const int whole_x = pen_x >= 0 ? pen_x / phases : -((-pen_x + phases - 1) / phases);
    const int whole_y = pen_y >= 0 ? pen_y / phases : -((-pen_y + phases - 1) / phases);
    const Glyph& placed = glyph({label.weight, em, c, pen_x - whole_x * phases, pen_y - whole_y * phases});
    layout.glyphs.push_back({&placed, whole_x, whole_y});
    layout.bounds = union_of(layout.bounds, {whole_x + placed.left, whole_y + placed.top, placed.width, placed.height});
    x += step;
  }
  layout.bounds = intersection(layout.bounds, {0, 0, width, height});
  return layout;
}

std::vector<std::string> TextPainter::lacks(const std::string& text) const {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
    const std::string character = text.substr(i, end - i);
    const bool boxed = FT_Get_Char_Index(fonts_->faces[0], characters(character).front()) == 0;
    if (boxed && std::find(result.begin(), result.end(), character) == result.end()) result.push_back(character);
    i = end;
  }
  return result;
}

void TextPainter::draw(const TextLayout& layout, const Rect& clip, Image& picture) {
  const Rect area = intersection(layout.bounds, clip);
  if (area.empty()) return;
  // Rims of neighbors overlap: gathered first, so that no rim darkens twice and none lies on a letter.
  const std::size_t size = index(0, area.height, area.width);
  std::vector<std::uint8_t> rim(size), cover(size);
  for (const TextLayout::Place& place : layout.glyphs) {
    const Glyph& glyph = *place.glyph;
    const int left = place.x + glyph.left, top = place.y + glyph.top;
    const Rect part = intersection({left, top, glyph.width, glyph.height}, area);
    for (int y = part.y; y < part.y + part.height; ++y) {
      for (int x = part.x; x < part.x + part.width; ++x) {
        const std::size_t from = index(x - left, y - top, glyph.width);
        const std::size_t to = index(x - area.x, y - area.y, area.width);
        rim[to] = std::max(rim[to], glyph.rim[from]);
        cover[to] = static_cast<std::uint8_t>(std::min(255, cover[to] + glyph.cover[from]));
      }
    }
  }
  for (int y = 0; y < area.height; ++y) {
    for (int x = 0; x < area.width; ++x) {
      const std::size_t i = index(x, y, area.width);
      if (rim[i] == 0) continue;
      std::uint8_t* const pixel = picture.pixel(area.x + x, area.y + y);
      blend(pixel, rim_color, rim[i] * rim_strength / 255 * layout.color.a / 255);
      blend(pixel, layout.color, cover[i] * layout.color.a / 255);
    }
  }
}

std::string freetype_version() {
  FT_Library library = nullptr;
  if (FT_Init_FreeType(&library) != 0) return "unknown";
  int major = 0;
  int minor = 0;
  int patch = 0;
  FT_Library_Version(library, &major, &minor, &patch);
  FT_Done_FreeType(library);
  return fmt::format("{}.{}.{}", major, minor, patch);
}

}  // namespace bookspin
