#include "film/film_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>
#include <stdexcept>

#include "files/checksums.h"
#include "files/files.h"
#include "film/process.h"
#include "render/renderer.h"
#include "scene/scene_json.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

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

Json checksums_json(const std::string& film, const std::string& poster) {
  Json json{{"film", film}, {"poster", poster}};
  if (film.empty()) json.erase("film");
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
  json["versions"] = {{"bookspin", BOOKSPIN_VERSION}, {"OpenGL", data.opengl}};
  for (const auto& [name, version] : library_versions()) json["versions"][name] = version;
  json["sha256"] =
      checksums_json(data.mp4 == nullptr ? "" : sha256_of(data.mp4->path()), sha256_of(data.poster.path()));
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
  json["scene"] = Json::parse(scene_json(film.scene));
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
  settle(products.data.parent_path());
  const Checksums listed = read_checksums(products.data.parent_path());
  for (const fs::path& product : {products.film, products.poster, products.data}) {
    if (!(film.is_still() && product == products.film) && !is_as_listed(listed, product)) return false;
  }
  const Json found = Json::parse(read_file(products.data), nullptr, false);
  const Json wanted{{"format", film_format},
                    {"made_with", made_with(film)},
                    {"sha256", checksums_json(film.is_still() ? "" : listed.at(products.film.filename().string()),
                                              listed.at(products.poster.filename().string()))},
                    {"met", true},
                    {"script", film.script}};
  for (const auto& [key, value] : wanted.items()) {
    if (!found.contains(key) || found[key] != value) return false;
  }
  // Last, as it costs a context: the same for all films of a call.
  static const std::string opengl = Process([](const auto&) { return describe_opengl(ContextKind::any); }).result();
  return found.contains("versions") && found["versions"].contains("OpenGL") && found["versions"]["OpenGL"] == opengl;
} catch (const std::runtime_error&) {
  return false;  // a product cannot be read, or there is no OpenGL: then drawing says why
}

}  // namespace bookspin
