#include "film/film_data.h"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "files/files.h"
#include "scene/quantities.h"
#include "scene/scene_file.h"

namespace bookspin {
namespace {

using Json = nlohmann::ordered_json;

Json as_json(const MadeWith& made_with) {
  return {{"width", made_with.width},
          {"height", made_with.height},
          {"frames", fmt::format("{}:{}", made_with.first_frame,
                                 made_with.end_frame < 0 ? "" : std::to_string(made_with.end_frame))},
          {"set", made_with.overrides}};
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

// Seven digits draw any chart; the trajectory command gives all of them.
void append_short(std::string& out, double value) {
  out += std::isfinite(value) ? fmt::format("{:.7g}", value) : "null";
}

std::string book_json(const BookSetup& setup, const BookTrack& track) {
  Json head{{"name", setup.name}, {"method", name_of(setup.method)}};
  head["exploded_frame"] = track.exploded_frame ? Json(*track.exploded_frame) : Json(nullptr);
  std::string out = head.dump();
  out.back() = ',';
  out += "\n   \"data\": {";
  for (const Quantity& quantity : quantities()) {
    out += fmt::format("{}\n    \"{}\": [", out.back() == '{' ? "" : ",", quantity.name);
    for (const BookFrame& frame : track.frames) {
      if (out.back() != '[') out += ',';
      append_short(out, quantity.of(frame));
    }
    out += ']';
  }
  return out + "}}";
}

Json head_json(const FilmData& data) {
  const Clip& clip = data.scene.clip;
  const int end = data.made_with.end_frame < 0 ? clip.frames : data.made_with.end_frame;
  Json head;
  head["format"] = "bookspin film 1";
  head["title"] = data.scene.title;
  head["caption"] = data.scene.caption;
  if (!data.film_name.empty()) head["film"] = data.film_name;
  head["poster"] = data.poster_name;
  head["made_with"] = as_json(data.made_with);
  head["clip"] = {{"frames", clip.frames},
                  {"fps", clip.fps},
                  {"time_per_frame", clip.time_per_frame},
                  {"substeps", clip.substeps},
                  {"first_frame", data.made_with.first_frame},
                  {"drawn_frames", end - data.made_with.first_frame}};
  bool all_met = true;
  Json expectations = Json::array();
  for (const Verdict& verdict : data.verdicts) {
    all_met = all_met && verdict.met;
    expectations.push_back({{"says", verdict.says},
                            {"text", verdict.text},
                            {"met", verdict.met},
                            {"found", number(verdict.found)},
                            {"frame", verdict.frame}});
  }
  head["met"] = all_met;
  head["expectations"] = expectations;
  head["quantities"] = Json::array();
  for (const Quantity& quantity : quantities()) {
    head["quantities"].push_back({{"name", quantity.name}, {"unit", quantity.unit}, {"meaning", quantity.meaning}});
  }
  head["script"] = data.script;
  return head;
}

}  // namespace

void write_film_data(const std::filesystem::path& file, const FilmData& data) {
  write_file(file, [&data](std::ostream& out) {
    std::string head = head_json(data).dump(1);
    head.resize(head.size() - 2);  // "\n}": the books follow
    out << head << ",\n \"books\": [";
    for (std::size_t b = 0; b < data.scene.books.size(); ++b) {
      out << (b == 0 ? "\n  " : ",\n  ") << book_json(data.scene.books[b], data.trajectory.books[b]);
    }
    out << "\n ]\n}\n";
  });
}

bool was_made_with(const std::filesystem::path& file, const MadeWith& made_with) {
  std::ifstream in(file, std::ios::binary);
  const Json json = Json::parse(in, nullptr, false);
  return json.is_object() && json.value("met", false) && json.contains("made_with") &&
         json["made_with"] == as_json(made_with);
}

}  // namespace bookspin
