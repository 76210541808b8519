// Labels, set in Inter by FreeType and blended onto a finished picture, each glyph with a soft dark rim so that it
// reads on a book as on the background.
//
// Two steps: lay_out finds where each glyph goes (and so which pixels the label touches), draw blends what falls into
// clip. A label blended in pieces gives the same bytes as in one. Glyphs are drawn once and kept; a character that Inter
// lacks is a box. Throws std::runtime_error naming the font file and FreeType's reason.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "image/image.h"
#include "render/camera.h"
#include "render/shot.h"

namespace bookspin {

struct Glyph {
  int left = 0, top = 0;            // of the bitmaps, pixels right of and below the pen
  int width = 0, height = 0;        // of the bitmaps, pixels
  std::vector<std::uint8_t> cover;  // 0 ... 255
  std::vector<std::uint8_t> rim;    // 0 ... 255: the cover, spread
  double advance = 0;               // to the next pen, pixels
};

struct TextLayout {
  struct Place {
    const Glyph* glyph;
    int x, y;  // of the pen, pixels
  };
  std::vector<Place> glyphs;
  Rect bounds;        // of the ink, within the frame
  double length = 0;  // from the first pen to the last, pixels
  Color color;
};

class TextPainter {
 public:
  TextPainter();
  ~TextPainter();
  TextPainter(TextPainter&&) = delete;
  TextPainter& operator=(TextPainter&&) = delete;

  // Valid as long as the painter. Nothing is laid out for an anchor that is not finite or not in front of the camera.
  TextLayout lay_out(const Label& label, const View& view, int width, int height);
  [[nodiscard]] std::vector<std::string> lacks(const std::string& text) const;  // characters that are a box, each once
  static void draw(const TextLayout& layout, const Rect& clip, Image& picture);

 private:
  struct Fonts;
  // Weight, em size in pixels, character, quarter-pixel offsets right and down.
  using Key = std::tuple<Weight, int, char32_t, int, int>;
  const Glyph& glyph(const Key& key);
  double digit_advance(Weight weight, int em);

  std::unique_ptr<Fonts> fonts_;
  std::map<Key, Glyph> glyphs_;  // a node stays where it is
};

[[nodiscard]] std::vector<std::string> font_files();

}  // namespace bookspin
