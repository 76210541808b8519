// The JSON beside each film: the scene, what was measured in every frame, and the verdict on every expectation.
//
//   format                        "bookspin film 1"
//   title, caption, script        as in the scene script (script: its whole text)
//   film, poster                  file names beside this one (film: absent for a still)
//   made_with                     width and height in pixels, first_frame, end_frame; set: the overrides, as given
//   clip                          frames, fps, time_per_frame, substeps; first_frame and drawn_frames: what is filmed
//   met                           true when every expectation is met
//   expectations                  says, text, met, found, frame: one for each bound
//   quantities                    name, unit, meaning; for a chart: title, shown_unit, shown_scale (shown / value), axis
//                                 (low, high: shown, what it holds whatever the data; most: what cannot be exceeded or 0)
//   books                         name, method, exploded_frame (null: never), and data: one list a quantity, one number
//                                 a frame, 7 significant digits, null where there is no number
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/judge.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

inline constexpr const char* film_format = "bookspin film 1";

struct MadeWith {
  int width = 1280;                    // pixels
  int height = 720;                    // pixels
  int first_frame = 0;                 // of the scene's frames
  int end_frame = -1;                  // the first one not drawn; -1: all to the end
  std::vector<std::string> overrides;  // as given, in order
};

struct FilmData {
  const Scene& scene;
  const Trajectory& trajectory;
  const std::vector<Verdict>& verdicts;
  std::string script;     // the text
  std::string film_name;  // file name of the MP4; empty: a still
  std::string poster_name;
  MadeWith made_with;
};

// Throws std::runtime_error; an older file survives a failure.
void write_film_data(const std::filesystem::path& file, const FilmData& data);

// Whether the file says that it was made so, with every expectation met. False for a file that cannot be read.
[[nodiscard]] bool was_made_with(const std::filesystem::path& file, const MadeWith& made_with);

}  // namespace bookspin
