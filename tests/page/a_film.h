// The data of a small film, as film/film_data.h describes it: two seconds of one book that turns over at frame 10.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

namespace bookspin {

inline nlohmann::json a_book(const std::string& name, int frames) {
  std::vector<double> tilt;
  std::vector<int> flips;
  std::vector<double> energy;
  for (int n = 0; n < frames; ++n) {
    tilt.push_back(n < 10 ? 0.0 : 175.0);
    flips.push_back(n < 10 ? 0 : 1);
    energy.push_back(1.0 + 0.1 * n);
  }
  return {{"name", name},
          {"method", "matrix"},
          {"exploded_frame", nullptr},
          {"data", {{"tilt", tilt}, {"flips", flips}, {"energy_ratio", energy}}}};
}

inline nlohmann::json a_film(int frames = 20) {
  return {{"title", "A film"},
          {"caption", "What it shows."},
          {"film", "a.mp4"},
          {"poster", "a.png"},
          {"made_with", {{"size", "64x36"}}},
          {"clip",
           {{"frames", frames},
            {"fps", 10},
            {"time_per_frame", 0.5},
            {"substeps", 3},
            {"first_frame", 0},
            {"drawn_frames", frames}}},
          {"met", true},
          {"expectations",
           {{{"says", "it turns over"},
             {"text", "flips at least 1: found 1"},
             {"met", true},
             {"found", 1},
             {"frame", 19}}}},
          {"quantities", {{{"name", "tilt"}, {"unit", "degrees"}, {"meaning", "an angle"}}}},
          {"script", "title = \"A film\"\n"},
          {"books", {a_book("", frames)}}};
}

}  // namespace bookspin
