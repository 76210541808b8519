// A film's JSON (film/film_data.h says what it holds), read and checked: behind this door nothing can be missing, of the
// wrong type, or too short.
//
// Preconditions on the file: its key "format" is film_format. Every list of a book's data has one number a frame of the
// clip, null where there is none; the drawn frames lie within the clip; film and poster are names of files beside it.
// Throws std::invalid_argument "FILE: KEY: found ...; allowed: ..." for a file that claims the format and does not keep
// it, and std::runtime_error when it cannot be read.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace bookspin {

struct FilmRecord {
  struct Expectation {
    std::string says;
    std::string quantity;
    double found = 0.0;  // NaN: nothing
    bool met = false;
    int frame = 0;  // in which it was decided
  };
  struct Cue {
    int first = 0;  // frame of the clip
    int end = 0;    // the first frame without it
    std::string text;
  };
  struct Quantity {  // and how a chart shows it
    std::string name;
    std::string title;
    std::string unit;    // of what is shown
    double scale = 1.0;  // shown / value
    double low = 0.0;    // shown, to here the axis reaches whatever the data
    double high = 0.0;
    double most = 0.0;  // shown, what cannot be exceeded; 0: nothing. From its half on the axis shows it all
  };
  struct Book {
    std::string name;  // as shown among others: its method, if the script gives it no name
    std::string method;
    std::optional<int> exploded_frame;
    std::map<std::string, std::vector<double>> data;  // by quantity, one value a frame of the clip; NaN: none
  };

  std::string name;  // the file's, without .json
  std::string title;
  std::string caption;
  std::string script;  // its text
  std::string scene;   // JSON, as `bookspin json` prints it; empty: not told
  std::string film;    // file name; empty: a still
  std::string poster;  // file name
  int width = 0;       // pixels
  int height = 0;      // pixels
  int frames = 0;      // of the clip
  int fps = 0;
  double time_per_frame = 0.0;  // simulated
  int first_frame = 0;
  int drawn_frames = 0;
  std::map<std::string, std::string> versions;  // of what made it
  std::map<std::string, std::string> sha256;    // "film" (not of a still) and "poster"
  std::vector<Cue> cues;                        // the script's own
  std::vector<Expectation> expectations;
  std::vector<Quantity> quantities;
  std::vector<Book> books;  // at least one

  [[nodiscard]] double seconds() const { return static_cast<double>(drawn_frames) / fps; }
  [[nodiscard]] double seconds_at(int frame) const { return static_cast<double>(frame - first_frame) / fps; }
};

// Nothing for a file that does not claim to be a film's data: other JSON may lie beside the films.
[[nodiscard]] std::optional<FilmRecord> read_film_record(const std::filesystem::path& file);
[[nodiscard]] std::optional<FilmRecord> parse_film_record(const std::string& text, const std::filesystem::path& file);

}  // namespace bookspin
