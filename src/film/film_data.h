// The JSON beside each film: the scene, what was measured in every frame, and the verdict on every expectation.
//
//   format                        "bookspin film 1"
//   title, caption, script        as in the scene script (script: its whole text)
//   film, poster                  file names beside this one (film: absent for a still)
//   made_with                     width and height in pixels; frames: [first, end) as asked for; set: the overrides, as
//                                 given; drawn_by: the fingerprint of shaders, textures, fonts, libraries and source
//   versions                      of bookspin and of each library that shapes the bytes
//   sha256                        of film and poster
//   clip                          frames, fps, time_per_frame, substeps; first_frame and drawn_frames: what is filmed;
//                                 fewer than asked for when every book has exploded
//   met                           true when every expectation is met
//   expectations                  says, quantity, text, met, found, frame: one for each bound
//   cues                          captions of the script's own: says, first_frame, end_frame (the first without it)
//   quantities                    name, unit, meaning; for a chart: title, shown_unit, shown_scale (shown / value), axis
//                                 (low, high: shown, what it holds whatever the data; most: what cannot be exceeded or 0)
//   scene                         what moves, with the overrides (scene/scene_json.h)
//   books                         name, method, exploded_frame (null: never), and data: one list a quantity, one number
//                                 a frame, 7 significant digits, null where there is no number
#pragma once

#include <filesystem>
#include <vector>

#include "files/part.h"
#include "film/film.h"
#include "scene/judge.h"
#include "scene/trajectory.h"

namespace bookspin {

inline constexpr const char* film_format = "bookspin film 1";

struct FilmData {
  const Film& film;
  const Trajectory& trajectory;
  const std::vector<Verdict>& verdicts;
  int drawn_frames;
  const Part* mp4;  // complete; nullptr: a still
  const Part& poster;
  const std::string& opengl;  // Renderer::description()
};

// Throws std::runtime_error.
void write_film_data(const Part& part, const FilmData& data);

// Whether the products are there as they were made, of the same script in the same way, by the OpenGL of now, with
// every expectation met.
// False for files that cannot be read or are not of this format.
[[nodiscard]] bool is_up_to_date(const Film& film, const Products& products);

}  // namespace bookspin
