#include "film/film_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <ostream>

#include "files/files.h"
#include "scene/scene_file.h"

namespace bookspin {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const MadeWith& made_with) {
  return {{"width", made_with.width},
          {"height", made_with.height},
          {"first_frame", made_with.first_frame},
          {"end_frame", made_with.end_frame},
          {"set", made_with.overrides}};
}

Json clip_json(const FilmData& data) {
  const Clip& clip = data.scene.clip;
  const int end = data.made_with.end_frame < 0 ? clip.frames : data.made_with.end_frame;
  return {{"frames", clip.frames},
          {"fps", clip.fps},
          {"time_per_frame", clip.time_per_frame},
          {"substeps", clip.substeps},
          {"first_frame", data.made_with.first_frame},
          {"drawn_frames", end - data.made_with.first_frame}};
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
  Json json{{"format", film_format}, {"title", data.scene.title}, {"caption", data.scene.caption}};
  if (!data.film_name.empty()) json["film"] = data.film_name;
  json["poster"] = data.poster_name;
  json["made_with"] = as_json(data.made_with);
  json["clip"] = clip_json(data);
  json["met"] = std::all_of(data.verdicts.begin(), data.verdicts.end(), [](const Verdict& v) { return v.met; });
  json["expectations"] = Json::array();
  for (const Verdict& v : data.verdicts) {
    json["expectations"].push_back(
        {{"says", v.says}, {"text", v.text}, {"met", v.met}, {"found", v.found}, {"frame", v.frame}});
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
  json["script"] = data.script;
  json["books"] = Json::array();
  for (std::size_t b = 0; b < data.scene.books.size(); ++b) {
    json["books"].push_back(book_json(data.scene.books[b], data.trajectory.books[b]));
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

void write_film_data(const std::filesystem::path& file, const FilmData& data) {
  const Json json = as_json(data);
  write_file(file, [&json](std::ostream& out) {
    write(out, json, "\n");
    out << '\n';
  });
}

bool was_made_with(const std::filesystem::path& file, const MadeWith& made_with) {
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(in, nullptr, false);
  return json.is_object() && json.value("met", false) && json.contains("made_with") &&
         json["made_with"] == as_json(made_with);
}

}  // namespace bookspin
