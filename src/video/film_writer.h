// Writes pictures, one after the other, as an H.264 film in an MP4 file that a web page can play while it loads; in a
// part whose name ends in .webm as VP9, in .gif as a GIF of at most 25 frames a second: every second, third ... picture.
//
// H.264 High, yuv420p, BT.709 in limited range, a closed group of pictures and a key frame each second, index first.
// Each key frame begins a segment, whose bytes do not depend on what was before: a film may be written in pieces, each of
// whole segments but for the film's end, and joined to the same bytes.
// It is written into a Part, which must outlive the writer, and which the caller publishes after finish(). The same
// pictures give the same bytes, on any CPU and beside any number of other writers (one thread a writer, any thread).
// Throws std::invalid_argument for odd or empty sizes, a picture of another size, a film without
// pictures; std::runtime_error (file, operation, the library's text) when the outside world fails. After a throw the
// writer can only be destroyed. Sources: FFmpeg's libavcodec and libavformat; ITU-T H.264; ITU-R BT.709-6.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/part.h"
#include "image/image.h"

namespace bookspin {

// The encoder and the library that has it. Throws std::runtime_error when there is none.
[[nodiscard]] std::string describe_encoder();
[[nodiscard]] std::string encoder_version();  // of libavcodec
[[nodiscard]] std::string mp4_settings();     // of the encoder: "key=value;key=value", as libavcodec reads them

// What a writer of a piece of an MP4, of the same other settings, has finished: segments.
class PieceReader {
 public:
  explicit PieceReader(const Part& piece);
  PieceReader(const PieceReader&) = delete;
  PieceReader& operator=(const PieceReader&) = delete;
  ~PieceReader();

 private:
  friend class FilmWriter;
  struct Piece;
  std::unique_ptr<Piece> piece_;
};

class FilmWriter {
 public:
  struct Settings {
    int width = 1280;    // pixels, even
    int height = 720;    // pixels, even
    int fps = 60;        // frames a second
    std::string title;   // as players show it; empty: none
    bool piece = false;  // of an MP4, for a PieceReader, whatever the part's name
  };

  FilmWriter(const Part& part, const Settings& settings);
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;
  ~FilmWriter();

  // A GIF's colors are those of the pictures shown before the first frame; other films need none.
  void sample(const Image& picture);
  [[nodiscard]] bool needs_samples() const;

  // Appends a frame. `changed` covers every pixel that differs from the frame before, and may be empty; of the first
  // frame everything counts. Only that part is converted.
  void write(const Image& frame, const std::vector<Rect>& changed);

  // Frames of a segment; none: films of this format are not written in pieces.
  [[nodiscard]] std::optional<int> segment() const;

  // Appends to an MP4 the next frames of a piece: a segment, the film's last one may be shorter. What this one has so
  // far is whole segments; from now on nothing but pieces may follow.
  void append(PieceReader& piece, int frames);

  // Completes the file; afterwards only destruction is allowed.
  void finish();

 private:
  struct Film;
  std::unique_ptr<Film> film_;
};

}  // namespace bookspin
