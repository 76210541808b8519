#include "page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <list>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <stdexcept>

#include "files/files.h"
#include "fill/fill.h"
#include "page/chart.h"
#include "page/cues.h"
#include "page/film_record.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// The films of a folder, sorted by name, each with its products: at least one.
std::vector<FilmRecord> films_in(const fs::path& site) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(site, error)) {
    if (entry.path().extension() == ".json" && is_file(entry.path())) files.push_back(entry.path());
  }
  if (error) throw std::runtime_error(fmt::format("{}: cannot be listed: {}", site.string(), error.message()));
  std::sort(files.begin(), files.end());
  std::vector<FilmRecord> films;
  for (const fs::path& file : files) {
    std::optional<FilmRecord> film = read_film_record(file);
    if (!film) continue;
    for (const std::string& product : {film->poster, film->film}) {
      if (!is_file(site / product) && !product.empty()) {
        throw std::runtime_error(
            fmt::format("{}: is missing; `bookspin render {}.toml` makes it", (site / product).string(), film->name));
      }
    }
    films.push_back(std::move(*film));
  }
  if (films.empty()) {
    throw std::runtime_error(
        fmt::format("{0}: holds no films; `bookspin render SCENE.toml -o {0}` makes one", site.string()));
  }
  return films;
}

// The text as it may stand in an address, RFC 3986.
std::string percent_encoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || std::strchr("-._~", c) != nullptr;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}

// fig09b_matrix_large_step -> "Figure 9b".
std::string kind_of(const std::string& name) {
  static const std::regex figure("fig0*([0-9]+[a-z]?)_.*");
  std::smatch found;
  return std::regex_match(name, found, figure) ? "Figure " + found[1].str() : "Film";
}

// A frame of the clip: in the film's seconds for the player, in the scene's time for the reader.
Json moment(const FilmRecord& film, int frame) {
  return {{"seconds", fmt::format("{:.3f}", film.seconds_at(frame))},
          {"time", fmt::format("t = {:.{}f}", frame * film.time_per_frame, film.time_per_frame < 0.1 ? 1 : 0)}};
}

// Three digits, as a reader writes them: 0.953, 1234, 4 × 10⁻¹⁶.
std::string readable(double value) {
  const double size = std::abs(value);
  if (size == 0.0 || size >= 1e-4)
    return size >= 1e3 && size < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value);
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  const std::string text = fmt::format("{:.0e}", value);  // 4e-16
  std::string out = text.substr(0, text.find('e')) + " × 10⁻";
  for (const char c : fmt::format("{}", std::stoi(text.substr(text.find('-') + 1)))) out += digits[c - '0'];
  return out;
}

// "Stretch 0.06 %", "Energy E/E₀ 0.953".
std::string measured(const FilmRecord& film, const FilmRecord::Expectation& e) {
  const auto q = std::find_if(film.quantities.begin(), film.quantities.end(),
                              [&e](const FilmRecord::Quantity& one) { return one.name == e.quantity; });
  if (q == film.quantities.end() || std::isnan(e.found)) return {};
  if (e.quantity == "exploded") return e.found != 0.0 ? "exploded" : "not exploded";
  return fmt::format("{} {}{}{}", q->title, readable(e.found * q->scale), q->unit.empty() || q->unit == "°" ? "" : " ",
                     q->unit);
}

// One claim for each thing said; two bounds under the same words are one.
Json claims_of(const FilmRecord& film) {
  Json claims = Json::array();
  for (const FilmRecord::Expectation& e : film.expectations) {
    if (claims.empty() || claims.back()["says"] != e.says) {
      claims.push_back({{"says", e.says}, {"met", true}, {"found", Json::array()}});
    }
    claims.back()["met"] = claims.back()["met"] == true && e.met;
    Json found = moment(film, e.frame);
    found["value"] = measured(film, e);
    found["shown"] = e.frame >= film.first_frame && e.frame < film.first_frame + film.drawn_frames;
    Json& all = claims.back()["found"];
    if (std::find(all.begin(), all.end(), found) == all.end()) all.push_back(found);
  }
  return claims;
}

// What film.html and figure.html may use of a film.
Json film_context(const fs::path& site, const FilmRecord& film, const std::string& panels) {
  const std::string& product = film.film.empty() ? film.poster : film.film;
  const bool still = product == film.poster || product.ends_with(".gif");  // an <img>
  Json context{{"id", percent_encoded(film.name)},
               {"kind", kind_of(film.name)},
               {"title", film.title},
               {"caption", film.caption},
               {"still", still},
               {"file", percent_encoded(product)},
               {"poster", percent_encoded(still ? product : film.poster)},
               {"data", percent_encoded(film.name + ".json")},
               {"width", film.width},
               {"height", film.height},
               {"fps", film.fps},
               {"size", readable_size(fs::file_size(site / product))},
               {"script", film.script},
               {"script_file", film.name + ".toml"},
               {"claims", claims_of(film)}};
  const Json& claims = context["claims"];
  const auto met = std::count_if(claims.begin(), claims.end(), [](const Json& c) { return c["met"] == true; });
  context["judged"] = !claims.empty();
  context["verdict"] = fmt::format("{} of {}", met, claims.size());
  context["all_met"] = met == static_cast<std::ptrdiff_t>(claims.size());
  if (still) return context;

  context["chart"] = chart_of(film, panels);
  context["length"] = fmt::format("{:.{}f} s", film.seconds(), film.seconds() < 10.0 ? 1 : 0);
  const std::vector<FilmRecord::Cue> cues = cues_of(film);
  context["eventful"] = !cues.empty();
  context["events"] = Json::array();
  for (const FilmRecord::Cue& cue : cues) {
    context["events"].push_back(moment(film, cue.first));
    context["events"].back()["what"] = cue.text;
  }
  const auto turn = std::find_if(cues.begin(), cues.end(), [](const FilmRecord::Cue& cue) {
    return cue.text.find("turning over") != std::string::npos;
  });
  context["turn"] = turn == cues.end() ? "0" : moment(film, turn->first)["seconds"].get<std::string>();
  context["vtt_file"] = film.name + ".vtt";
  context["vtt_text"] = web_vtt(film, cues);
  context["vtt"] = percent_encoded(film.name + ".vtt");
  context["captions"] = "data:text/vtt;charset=utf-8," + percent_encoded(context["vtt_text"]);
  return context;
}

// The report's table of speed against error, if there is one.
Json speed_in(const fs::path& report) {
  Json speed;
  if (!is_file(report)) return speed;
  const Json json = Json::parse(read_file(report), nullptr, false);
  if (!json.is_object() || !json.contains("cheapest_a")) return speed;
  speed = {
      {"rows", Json::array()}, {"processor", json.value("processor", Json())}, {"quick", json.value("quick", Json())}};
  for (const Json& row : json["cheapest_a"]) {
    Json cells = Json::array();
    for (const char* key : {"ns at 1e-2", "ns at 1e-6", "ns at 1e-9", "best error"}) {
      const Json cell = row.value(key, Json());
      cells.push_back(cell.is_number() ? readable(cell.get<double>()) : "never");
    }
    speed["rows"].push_back({{"method", row.value("method", Json())}, {"cells", cells}});
  }
  return speed;
}

std::string base64(const std::string& bytes) {
  static const char* const letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += k <= count ? letters[group >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

// A scene that the panel can show and say again as a script to the last digit. JavaScript's whole numbers end at 2^53.
bool can_be_live(const Json& scene) {
  return scene.is_object() && scene.value("frames", 0) > 1 && scene.value("substeps", 0) <= 20000 &&
         scene.value("seed", 0.0) <= 0x1p53 && scene.contains("books") && scene["books"].is_array() &&
         std::all_of(scene["books"].begin(), scene["books"].end(), [](const Json& book) {
           return book.is_object() && book.contains("orientation") && book["orientation"].is_null() &&
                  book.contains("moments") && book["moments"] == Json{0.0, 0.0, 0.0};
         });
}

Json live_context(const LiveParts& parts, const std::vector<FilmRecord>& films, const fs::path& templates) {
  const auto texts_in = [](const fs::path& folder, std::initializer_list<const char*> extensions, bool with_extension) {
    Json texts = Json::object();
    for (const auto& entry : fs::directory_iterator(folder)) {
      for (const char* extension : extensions) {
        if (entry.path().extension() != extension) continue;
        texts[(with_extension ? entry.path().filename() : entry.path().stem()).string()] = read_file(entry.path());
      }
    }
    return texts;
  };
  Json data{{"wasm", base64(read_file(parts.module))},
            {"shaders", texts_in(parts.shaders, {".vert", ".frag"}, true)},
            {"textures", texts_in(parts.textures, {".svg"}, false)},
            {"films", Json::object()}};
  for (const FilmRecord& film : films) {
    const Json scene = Json::parse(film.scene, nullptr, false);
    if (film.film.empty() || !can_be_live(scene)) continue;
    data["films"][percent_encoded(film.name)] = {{"title", film.title}, {"first", film.first_frame}, {"scene", scene}};
  }
  std::string text;
  for (const char c : data.dump()) text += c == '<' ? std::string("\\u003c") : std::string(1, c);  // no end of a script
  return {{"data", text},
          {"html", read_file(templates / "live.html")},
          {"style", read_file(templates / "live.css")},
          {"behavior", read_file(templates / "engine.js") + read_file(templates / "painter.js") +
                           read_file(templates / "curves.js") + read_file(templates / "live.js")}};
}

// Turns every {{film NAME: panels}} into {{{films.NAME}}} and notes the panels.
std::string find_places(const std::string& text, std::map<std::string, std::string>& panels) {
  static const std::regex place(R"(\{\{film ([A-Za-z0-9_-]+)(?:: *([^}]*))?\}\})");
  std::string out;
  auto rest = text.cbegin();
  for (std::sregex_iterator found(text.begin(), text.end(), place), none; found != none; ++found) {
    const std::string name = (*found)[1];
    panels[name] = (*found)[2];
    out.append(rest, (*found)[0].first);
    out += fmt::format("{{{{{{films.{}.html}}}}}}", name);
    rest = (*found)[0].second;
  }
  return out.append(rest, text.cend());
}

}  // namespace

PageReceipt write_page(const PageOrder& order) {
  const auto source = [&](const char* name) { return read_file(order.templates / name); };
  const auto source_name = [&](const char* name) { return (order.templates / name).string(); };
  const std::string film_template = source("film.html");
  const std::string missing_template = source("missing.html");
  const std::string figure_template = source("figure.html");
  std::map<std::string, std::string> panels;
  const std::string page_template = find_places(source("template.html"), panels);
  const std::vector<FilmRecord> films = films_in(order.site);

  const auto placed = static_cast<std::size_t>(
      std::count_if(films.begin(), films.end(), [&](const FilmRecord& film) { return panels.contains(film.name); }));
  const bool story = placed > 0 && 2 * placed >= panels.size();
  Json context{{"style", source("page.css")},
               {"behavior", source("page.js")},
               {"story", story},
               {"films", Json::object()},
               {"more", Json::array()}};
  context["report"] = is_file(order.site / "report" / "index.html");
  context["speed"] = speed_in(order.site / "report" / "report.json");
  if (order.live) context["live"] = live_context(*order.live, films, order.templates);
  for (const auto& entry : fs::directory_iterator(order.templates)) {
    if (entry.path().extension() == ".svg") context["drawings"][entry.path().stem().string()] = read_file(entry.path());
  }
  for (const auto& [name, unused] : panels) {
    context["films"][name]["html"] = fill(missing_template, {{"name", name}}, source_name("missing.html"));
  }
  std::list<Part> parts;
  for (const FilmRecord& film : films) {
    const auto place = panels.find(film.name);
    Json shown = film_context(order.site, film, place == panels.end() ? "" : place->second);
    shown["snippet"] = fill(figure_template, shown, source_name("figure.html"));
    shown["html"] = fill(film_template, shown, source_name("film.html"));
    if (shown.contains("vtt_text")) {
      write_part(parts.emplace_back(order.site / shown["vtt_file"].get<std::string>(), NamedBy::program),
                 shown["vtt_text"].get_ref<const std::string&>());
    }
    if (story && place != panels.end()) {
      context["films"][film.name] = std::move(shown);
    } else {
      context["more"].push_back(std::move(shown));
    }
  }
  context["any_more"] = !context["more"].empty();
  const std::string page = fill(page_template, context, source_name("template.html"));
  write_part(parts.emplace_back(order.site / "index.html", NamedBy::program), page);
  std::vector<Part*> all;
  for (Part& part : parts) all.push_back(&part);
  publish(all);
  return {parts.back().file(), static_cast<int>(films.size()), page.size()};
}

}  // namespace bookspin
