#include "page/page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "files/files.h"
#include "page/chart.h"
#include "page/events.h"
#include "page/fill.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

[[noreturn]] void fail(const fs::path& file, const std::string& what) {
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

Json read_film(const fs::path& site, const std::string& name) {
  const auto need = [&](const std::string& product) {
    if (!fs::exists(site / product))
      fail(site / product, fmt::format("is missing; `bookspin render {}.toml` makes it", name));
    return site / product;
  };
  const fs::path file = need(name + ".json");
  Json film = Json::parse(read_file(file), nullptr, false);
  if (!film.is_object() || !film.contains("books") || !film.contains("clip")) fail(file, "is not the data of a film");
  need(film["poster"]);
  if (film.contains("film")) need(film["film"]);
  return film;
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

std::string readable_size(std::uintmax_t bytes) {
  return bytes < 100000 ? fmt::format("{:.0f} kB", static_cast<double>(bytes) / 1e3)
                        : fmt::format("{:.1f} MB", static_cast<double>(bytes) / 1e6);
}

// One claim for each thing said; two bounds under the same words are one.
Json claims_of(const Json& expectations) {
  Json claims = Json::array();
  for (const Json& e : expectations) {
    if (claims.empty() || claims.back()["says"] != e["says"]) {
      claims.push_back({{"says", e["says"]}, {"met", true}, {"found", Json::array()}});
    }
    claims.back()["met"] = claims.back()["met"] == true && e["met"] == true;
    claims.back()["found"].push_back(e["text"]);
  }
  return claims;
}

// What film.html and figure.html may use of a film.
Json film_context(const fs::path& site, const std::string& name, const Json& film, const std::string& panels) {
  const std::string size = film["made_with"]["size"];
  const bool still = !film.contains("film");
  const fs::path product = still ? film["poster"] : film["film"];
  Json context{{"name", name},
               {"kind", kind_of(name)},
               {"title", film["title"]},
               {"caption", film["caption"]},
               {"still", still},
               {"file", product},
               {"poster", film["poster"]},
               {"data", name + ".json"},
               {"width", size.substr(0, size.find('x'))},
               {"height", size.substr(size.find('x') + 1)},
               {"size", readable_size(fs::file_size(site / product))},
               {"script", film["script"]},
               {"script_file", name + ".toml"}};
  context["claims"] = claims_of(film["expectations"]);
  const Json& claims = context["claims"];
  const auto met = std::count_if(claims.begin(), claims.end(), [](const Json& c) { return c["met"] == true; });
  context["judged"] = !claims.empty();
  context["verdict"] = fmt::format("{} of {}", met, claims.size());
  context["all_met"] = met == static_cast<std::ptrdiff_t>(claims.size());
  if (still) return context;

  context["chart"] = chart_of(film, panels);
  const double seconds = context["chart"]["seconds"];
  context["length"] = fmt::format("{:.0f} s", seconds);
  const std::vector<Event> events = events_of(film);
  context["events"] = Json::array();
  for (const Event& event : events) {
    context["events"].push_back({{"seconds", fmt::format("{:.3f}", event.seconds)},
                                 {"time", fmt::format("{:.1f} s", event.seconds)},
                                 {"what", event.what}});
  }
  context["captions"] = "data:text/vtt;charset=utf-8," + percent_encoded(web_vtt(events, seconds));
  return context;
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
    out += fmt::format("{{{{#films.{0}}}}}{{{{{{films.{0}}}}}}}{{{{/films.{0}}}}}", name);
    rest = (*found)[0].second;
  }
  return out.append(rest, text.cend());
}

}  // namespace

PageReceipt write_page(const PageOrder& order) {
  const auto source = [&](const char* name) { return read_file(order.templates / name); };
  const auto source_name = [&](const char* name) { return (order.templates / name).string(); };
  const std::string film_template = source("film.html");
  const std::string figure_template = source("figure.html");
  std::map<std::string, std::string> panels;
  const std::string page_template = find_places(source("template.html"), panels);

  Json context{{"style", source("page.css")},
               {"behaviour", source("page.js")},
               {"films", Json::object()},
               {"more", Json::array()}};
  context["report"] = fs::exists(order.site / "report" / "index.html");
  for (const std::string& name : order.films) {
    const auto place = panels.find(name);
    Json film = film_context(order.site, name, read_film(order.site, name), place == panels.end() ? "" : place->second);
    film["snippet"] = fill(figure_template, film, source_name("figure.html"));
    const std::string html = fill(film_template, film, source_name("film.html"));
    context["films"][name] = html;
    if (place == panels.end()) context["more"].push_back(html);
  }
  context["any_more"] = !context["more"].empty();
  const fs::path file = order.site / "index.html";
  write_file(file, fill(page_template, context, source_name("template.html")));
  return {file, static_cast<int>(order.films.size()), fs::file_size(file)};
}

}  // namespace bookspin
