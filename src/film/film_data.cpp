#include "film/film_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "files/files.h"
#include "files/fingerprint.h"
#include "scene/scene_file.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Nothing for a file that is no JSON, or cannot be read.
Json read_json(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return Json::parse(in, nullptr, false);
}

Json made_with(const Film& film) {
  return {{"width", film.width},
          {"height", film.height},
          {"frames", {film.first_frame, film.end_frame}},
          {"set", film.overrides},
          {"drawn_by", film.drawn_by}};
}

Json clip_of(const Film& film, int drawn_frames) {
  const Clip& clip = film.scene.clip;
  return {{"frames", clip.frames},
          {"fps", clip.fps},
          {"time_per_frame", clip.time_per_frame},
          {"substeps", clip.substeps},
          {"first_frame", film.first_frame},
          {"drawn_frames", drawn_frames}};
}

Json fingerprints(const Film& film, const fs::path& mp4, const fs::path& poster) {
  Json json = Json::object();
  if (!film.is_still()) json["film"] = fingerprint(read_file(mp4));
  json["poster"] = fingerprint(read_file(poster));
  return json;
}

// Seven digits draw any chart; the trajectory command gives all of them.
Json short_number(double value) {
  return std::isfinite(value) ? Json::parse(fmt::format("{:.7g}", value)) : Json(nullptr);
}

Json book_json(const BookSetup& setup, const BookTrack& track) {
  Json lists = Json::object();
  for (const Quantity& q : quantities) {
    Json& list = lists[std::string(q.name)] = Json::array();
    for (const BookFrame& frame : track.frames) list.push_back(short_number(frame[q.id]));
  }
  return {{"name", setup.name},
          {"method", name_of(setup.method)},
          {"exploded_frame", track.exploded_frame ? Json(*track.exploded_frame) : Json(nullptr)},
          {"data", lists}};
}

Json as_json(const FilmData& data) {
  const Film& film = data.film;
  Json json{{"format", film_format}, {"title", film.scene.title}, {"caption", film.scene.caption}};
  if (data.mp4 != nullptr) json["film"] = data.mp4->file().filename().string();
  json["poster"] = data.poster.file().filename().string();
  json["made_with"] = made_with(film);
  json["fingerprints"] = fingerprints(film, data.mp4 == nullptr ? "" : data.mp4->path(), data.poster.path());
  json["clip"] = clip_of(film, data.drawn_frames);
  json["met"] = std::all_of(data.verdicts.begin(), data.verdicts.end(), [](const Verdict& v) { return v.met; });
  json["expectations"] = Json::array();
  for (const Verdict& v : data.verdicts) {
    json["expectations"].push_back({{"says", v.says},
                                    {"quantity", quantity(v.quantity).name},
                                    {"text", v.text},
                                    {"met", v.met},
                                    {"found", v.found},
                                    {"frame", v.frame}});
  }
  json["cues"] = Json::array();
  for (const Cue& cue : film.scene.cues) {
    if (cue.first_frame >= film.scene.clip.frames) continue;  // of a film made shorter than its script says
    json["cues"].push_back({{"says", cue.says},
                            {"first_frame", cue.first_frame},
                            {"end_frame", std::min(cue.last_frame + 1, film.scene.clip.frames)}});
  }
  json["quantities"] = Json::array();
  for (const Quantity& q : quantities) {
    json["quantities"].push_back({{"name", q.name},
                                  {"unit", q.unit},
                                  {"meaning", q.meaning},
                                  {"title", q.title},
                                  {"shown_unit", q.shown_unit},
                                  {"shown_scale", q.shown_scale},
                                  {"axis", {{"low", q.axis.low}, {"high", q.axis.high}, {"most", q.axis.most}}}});
  }
  json["script"] = film.script;
  json["books"] = Json::array();
  for (std::size_t b = 0; b < film.scene.books.size(); ++b) {
    json["books"].push_back(book_json(film.scene.books[b], data.trajectory.books[b]));
  }
  return json;
}

// A line for each key, but only one for a list of numbers or texts.
void write(std::ostream& out, const Json& json, const std::string& line_end) {
  if (!json.is_structured() || json.empty() || (json.is_array() && !json.front().is_structured())) {
    out << json.dump();
    return;
  }
  char separator = json.is_object() ? '{' : '[';
  for (const auto& [key, value] : json.items()) {
    out << separator << line_end << ' ';
    if (json.is_object()) out << Json(key).dump() << ": ";
    write(out, value, line_end + ' ');
    separator = ',';
  }
  out << line_end << (json.is_object() ? '}' : ']');
}

}  // namespace

void write_film_data(const Part& part, const FilmData& data) {
  const Json json = as_json(data);
  write_part(part, [&json](std::ostream& out) {
    write(out, json, "\n");
    out << '\n';
  });
}

bool is_up_to_date(const Film& film, const Products& products) try {
  const Json found = read_json(products.data);
  const Json wanted{{"format", film_format},
                    {"made_with", made_with(film)},
                    {"fingerprints", fingerprints(film, products.film, products.poster)},
                    {"met", true},
                    {"script", film.script}};
  for (const auto& [key, value] : wanted.items()) {
    if (!found.contains(key) || found[key] != value) return false;
  }
  return true;
} catch (const std::runtime_error&) {
  return false;  // a product cannot be read
}

bool is_film_of(const fs::path& data, const fs::path& mp4) {
  const Json json = read_json(data);
  return json.contains("format") && json["format"] == film_format && json.contains("film") &&
         json["film"] == mp4.filename().string();
}

}  // namespace bookspin
