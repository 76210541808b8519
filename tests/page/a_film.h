// A small film, four seconds of one book that turns over at frame 20: its data as film/film_data.h describes them, and
// what is read from them.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "page/film_record.h"
#include "scratch.h"

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

inline nlohmann::json a_quantity(const char* name, const char* title, const char* shown_unit, double scale, double low,
                                 double high, double most) {
  return {{"name", name},
          {"unit", ""},
          {"meaning", "what it means"},
          {"title", title},
          {"shown_unit", shown_unit},
          {"shown_scale", scale},
          {"axis", {{"low", low}, {"high", high}, {"most", most}}}};
}

inline nlohmann::json a_film(int frames = 20) {
  return {{"format", "bookspin film 1"},
          {"title", "A film"},
          {"caption", "What it shows."},
          {"film", "a.mp4"},
          {"poster", "a.png"},
          {"versions", {{"bookspin", "1.1.0"}}},
          {"sha256", {{"film", "0"}, {"poster", "0"}}},
          {"made_with", {{"width", 64}, {"height", 36}}},
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
             {"quantity", "flips"},
             {"text", "flips at least 1: found 1"},
             {"met", true},
             {"found", 1},
             {"frame", 19}}}},
          {"cues", nlohmann::json::array()},
          {"quantities",
           {a_quantity("tilt", "Tilt of the spin axis", "°", 1.0, 0.0, 5.0, 180.0),
            a_quantity("flips", "Flips so far", "", 1.0, 0.0, 1.0, 0.0),
            a_quantity("stretch", "Stretch", "%", 100.0, 0.0, 1.0, 0.0),
            a_quantity("energy_ratio", "Energy E/E₀", "", 1.0, 0.95, 1.05, 0.0),
            a_quantity("angular_momentum_ratio", "Angular momentum |L|/|L₀|", "", 1.0, 0.95, 1.05, 0.0),
            a_quantity("angle_error", "Error of the orientation", "rad", 1.0, 0.0, 0.1, 3.14)}},
          {"script", "title = \"A film\"\n"},
          {"books", {a_book("", frames)}}};
}

inline FilmRecord as_read(const nlohmann::json& film) {
  const Scratch scratch;
  write_text(scratch / "a.json", film.dump());
  return read_film_record(scratch / "a.json").value();
}

}  // namespace bookspin
