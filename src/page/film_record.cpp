#include "page/film_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "files/files.h"

namespace bookspin {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* film_format = "bookspin film 1";
constexpr const char* any_film_format = "bookspin film";  // of whatever version

// A value of the JSON that knows its place, and gives nothing unchecked.
class Value {
 public:
  Value(const fs::path& file, std::string key, const Json& json) : file_(&file), key_(std::move(key)), json_(&json) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(fmt::format("{}: {}: {}", file_->string(), key_, what));
  }
  [[noreturn]] void refuse(const std::string& allowed) const {
    std::string found = json_->is_object()  ? "an object"
                        : json_->is_array() ? fmt::format("a list of {}", json_->size())
                                            : json_->dump(-1, ' ', true);
    constexpr std::size_t most = 60;
    if (found.size() > most) found.replace(most, found.npos, "...");
    fail(fmt::format("found {}; allowed: {}", found, allowed));
  }

  [[nodiscard]] bool has(const std::string& key) const { return object().contains(key); }
  [[nodiscard]] Value operator[](const std::string& key) const {
    const Json& self = object();
    const std::string place = key_.empty() ? key : key_ + '.' + key;
    const auto found = self.find(key);
    if (found == self.end()) Value(*file_, place, self).fail("is missing");
    return {*file_, place, *found};
  }
  [[nodiscard]] std::string object_text() const { return object().dump(); }
  [[nodiscard]] std::string text() const {
    if (!json_->is_string()) refuse("text");
    return json_->get<std::string>();
  }
  [[nodiscard]] std::string file_name() const {
    std::string name = json_->is_string() ? json_->get<std::string>() : "";
    if (name.empty() || name == "." || name == ".." || name.find_first_of(std::string_view("/\0", 2)) != name.npos) {
      refuse("the name of a file beside this one");
    }
    return name;
  }
  [[nodiscard]] bool yes() const {
    if (!json_->is_boolean()) refuse("true or false");
    return json_->get<bool>();
  }
  [[nodiscard]] int whole_number(int low, int high) const {
    const bool fits = json_->is_number_unsigned() ? json_->get<std::uint64_t>() <= static_cast<std::uint64_t>(high)
                                                  : json_->is_number_integer();
    if (!fits || json_->get<std::int64_t>() < low || json_->get<std::int64_t>() > high) {
      refuse(fmt::format("a whole number from {} to {}", low, high));
    }
    return json_->get<int>();
  }
  [[nodiscard]] std::optional<int> whole_number_or_null(int low, int high) const {
    if (json_->is_null()) return {};
    return whole_number(low, high);
  }
  [[nodiscard]] double number() const {
    if (!json_->is_number() || !std::isfinite(json_->get<double>())) refuse("a number");
    return json_->get<double>();
  }
  [[nodiscard]] double number_or_null() const { return json_->is_null() ? std::nan("") : number(); }
  // One number an entry, NaN for null.
  [[nodiscard]] std::vector<double> numbers(int count) const {
    if (!json_->is_array() || json_->size() != static_cast<std::size_t>(count)) {
      refuse(fmt::format("a list of {}, one number or null a frame", count));
    }
    std::vector<double> numbers;
    numbers.reserve(json_->size());
    for (std::size_t i = 0; i < json_->size(); ++i) {
      const Json& entry = (*json_)[i];
      if (!entry.is_number() && !entry.is_null()) {
        Value(*file_, fmt::format("{}.{}", key_, i), entry).refuse("a number or null");
      }
      numbers.push_back(entry.is_null() ? std::numeric_limits<double>::quiet_NaN() : entry.get<double>());
    }
    return numbers;
  }
  template <typename Read>
  [[nodiscard]] auto list(const Read& read) const {
    if (!json_->is_array()) refuse("a list");
    std::vector<decltype(read(*this))> entries;
    for (std::size_t i = 0; i < json_->size(); ++i) {
      entries.push_back(read(Value(*file_, fmt::format("{}.{}", key_, i), (*json_)[i])));
    }
    return entries;
  }
  template <typename Read>
  [[nodiscard]] auto map(const Read& read) const {
    std::map<std::string, decltype(read(*this))> entries;
    for (const auto& entry : object().items()) entries.emplace(entry.key(), read((*this)[entry.key()]));
    return entries;
  }

 private:
  [[nodiscard]] const Json& object() const {
    if (!json_->is_object()) refuse("an object");
    return *json_;
  }

  const fs::path* file_;
  std::string key_;  // dotted, entries of lists by index
  const Json* json_;
};

FilmRecord::Book read_book(const Value& book, int frames) {
  FilmRecord::Book result;
  result.name = book["name"].text();
  result.method = book["method"].text();
  if (result.name.empty()) result.name = result.method;
  result.exploded_frame = book["exploded_frame"].whole_number_or_null(0, frames - 1);
  result.data = book["data"].map([frames](const Value& list) { return list.numbers(frames); });
  return result;
}

}  // namespace

std::optional<FilmRecord> read_film_record(const fs::path& file) {
  return parse_film_record(read_file(file), file);
}

std::optional<FilmRecord> parse_film_record(const std::string& text, const fs::path& file) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& error) {  // no JSON, or a number beyond all others
    if (text.find(any_film_format) == std::string::npos) return {};
    const std::string what = error.what();
    throw std::invalid_argument(fmt::format("{}: is cut short or broken: {}; `bookspin render {}.toml` makes it",
                                            file.string(), what.substr(what.find("] ") + 2), file.stem().string()));
  }
  if (!json.is_object() || !json.contains("format") || !json["format"].is_string()) return {};
  const std::string format = json["format"];
  if (!format.starts_with(any_film_format)) return {};

  const Value root(file, "", json);
  if (format != film_format) root["format"].refuse(fmt::format("\"{}\"", film_format));
  FilmRecord film;
  film.name = file.stem().string();
  film.title = root["title"].text();
  film.caption = root["caption"].text();
  film.script = root["script"].text();
  if (root.has("scene")) film.scene = root["scene"].object_text();
  if (root.has("film")) film.film = root["film"].file_name();
  film.poster = root["poster"].file_name();
  const auto text_of = [](const Value& value) { return value.text(); };
  film.versions = root["versions"].map(text_of);
  film.sha256 = root["sha256"].map(text_of);
  constexpr int most_pixels = 1 << 16;
  film.width = root["made_with"]["width"].whole_number(1, most_pixels);
  film.height = root["made_with"]["height"].whole_number(1, most_pixels);
  constexpr int most_frames = 1 << 30;
  const Value clip = root["clip"];
  film.frames = clip["frames"].whole_number(1, most_frames);
  film.fps = clip["fps"].whole_number(1, 1000);
  film.time_per_frame = clip["time_per_frame"].number();
  film.first_frame = clip["first_frame"].whole_number(0, film.frames - 1);
  film.drawn_frames = clip["drawn_frames"].whole_number(1, film.frames - film.first_frame);
  film.expectations = root["expectations"].list([&film](const Value& e) {
    return FilmRecord::Expectation{e["says"].text(), e["quantity"].text(), e["found"].number_or_null(), e["met"].yes(),
                                   e["frame"].whole_number(0, film.frames - 1)};
  });
  film.cues = root["cues"].list([&film](const Value& cue) {
    const int first = cue["first_frame"].whole_number(0, film.frames - 1);
    return FilmRecord::Cue{first, cue["end_frame"].whole_number(first + 1, film.frames), cue["says"].text()};
  });
  film.quantities = root["quantities"].list([](const Value& q) {
    return FilmRecord::Quantity{q["name"].text(),          q["title"].text(),         q["shown_unit"].text(),
                                q["shown_scale"].number(), q["axis"]["low"].number(), q["axis"]["high"].number(),
                                q["axis"]["most"].number()};
  });
  film.books = root["books"].list([&film](const Value& book) { return read_book(book, film.frames); });
  if (film.books.empty()) root["books"].refuse("at least one");
  for (const FilmRecord::Book& book : film.books) {
    for (const auto& entry : book.data) {
      const auto is_named = [&entry](const FilmRecord::Quantity& q) { return q.name == entry.first; };
      if (std::none_of(film.quantities.begin(), film.quantities.end(), is_named)) {
        root["quantities"].fail(fmt::format("none has the name {}, of which there are data", entry.first));
      }
    }
  }
  return film;
}

}  // namespace bookspin
