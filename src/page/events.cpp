#include "page/events.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

namespace bookspin {
namespace {

using Json = nlohmann::json;

constexpr double together = 0.5;         // seconds: what a reader takes in at once
constexpr double longest_cue = 4.0;      // seconds
constexpr double quarter_turn = 1.5708;  // radians between a book and the exact one that nobody can overlook

struct Found {
  int frame;
  std::string who;   // the book's name; empty: what is a whole sentence
  std::string what;  // it does: "has turned over"
};

double value_at(const Json& list, int frame) {
  const Json& value = list[static_cast<std::size_t>(frame)];
  return value.is_number() ? value.get<double>() : std::nan("");
}

// A book without a name among others goes by its method.
std::string name_of(const Json& book) {
  const std::string name = book["name"];
  return name.empty() ? book["method"].get<std::string>() : name;
}

// The first frame before `end` at which the quantity has reached the bound, upwards or downwards.
void add_crossing(std::vector<Found>& found, const Json& book, const char* quantity, double bound, bool up, int end,
                  const std::string& what) {
  const Json& data = book["data"];
  if (!data.contains(quantity)) return;
  for (int n = 0; n < end; ++n) {
    const double value = value_at(data[quantity], n);
    if (up ? value >= bound : value <= bound) {
      found.push_back({n, name_of(book), what});
      return;
    }
  }
}

// Each frame at which a count has risen.
template <typename Words>
void add_counts(std::vector<Found>& found, const Json& book, const char* quantity, int end, const Words& words) {
  const Json& data = book["data"];
  if (!data.contains(quantity)) return;
  for (int n = 1; n < end; ++n) {
    const double count = value_at(data[quantity], n);
    if (count > value_at(data[quantity], n - 1)) found.push_back({n, name_of(book), words(static_cast<int>(count))});
  }
}

void add_book(std::vector<Found>& found, const Json& book, int frames) {
  const bool explodes = book["exploded_frame"].is_number();
  const int end = explodes ? std::min(frames, book["exploded_frame"].get<int>()) : frames;
  add_counts(found, book, "flips", end,
             [](int n) { return fmt::format("has turned {} (flip {})", n % 2 == 1 ? "over" : "back", n); });
  // The vibration of springs swells and shrinks too, but too fast for words.
  if (book["method"] != "springs") {
    add_counts(found, book, "pulsations", end,
               [](int n) { return fmt::format("has swollen and shrunk (pulsation {})", n); });
    add_crossing(found, book, "largest_singular_value", 1.2, true, end, "has grown by a fifth");
  }
  add_crossing(found, book, "energy_ratio", 2.0, true, end, "has twice its energy");
  add_crossing(found, book, "angular_momentum_ratio", 0.5, false, end, "has lost half its angular momentum");
  add_crossing(found, book, "angular_momentum_ratio", 0.1, false, end, "has lost nine tenths of its angular momentum");
  add_crossing(found, book, "angle_error", quarter_turn, true, end, "is a right angle away from the exact motion");
  if (explodes) found.push_back({end, name_of(book), "explodes; the film holds on the last picture before"});
}

// What happened together, in words: "matrix, springs: the book has turned over (flip 1). It looks stable."
std::string told(const std::vector<Found>& found, bool many_books) {
  std::vector<std::pair<std::string, std::set<std::string>>> merged;  // what, and who
  for (const Found& f : found) {
    auto same = std::find_if(merged.begin(), merged.end(), [&](const auto& m) { return m.first == f.what; });
    if (same == merged.end()) same = merged.insert(same, {f.what, {}});
    if (!f.who.empty()) same->second.insert(f.who);
  }
  std::string text;
  for (const auto& [what, who] : merged) {
    if (!text.empty()) text += ' ';
    if (who.empty())
      text += what;
    else if (many_books)
      text += fmt::format("{}: the book {}.", fmt::join(who, ", "), what);
    else
      text += fmt::format("The book {}.", what);
  }
  return text;
}

std::string sentence(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text.back() == '.' ? text : text + '.';
}

std::string vtt_time(double seconds) {
  const auto ms = std::llround(seconds * 1000.0);
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000);
}

std::string vtt_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

}  // namespace

std::vector<Event> events_of(const Json& film) {
  const Json& clip = film["clip"];
  const int first = clip["first_frame"];
  const int drawn = clip["drawn_frames"];
  const double fps = clip["fps"];
  std::vector<Found> found;
  for (const Json& book : film["books"]) add_book(found, book, clip["frames"]);
  for (const Json& expectation : film["expectations"]) {
    const std::string says = sentence(expectation["says"]);
    if (!says.empty() && expectation["met"] == true) found.push_back({expectation["frame"], "", says});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.frame < b.frame; });

  std::vector<Event> events;
  for (auto from = found.begin(); from != found.end();) {
    auto to = from;
    while (to != found.end() && to->frame - from->frame < together * fps) ++to;
    if (from->frame >= first && from->frame < first + drawn) {
      events.push_back({(from->frame - first) / fps, told({from, to}, film["books"].size() > 1)});
    }
    from = to;
  }
  return events;
}

std::string web_vtt(const std::vector<Event>& events, double film_seconds) {
  std::string out = "WEBVTT\n";
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double next = i + 1 < events.size() ? events[i + 1].seconds : film_seconds;
    const double end = std::min(next, events[i].seconds + longest_cue);
    if (end <= events[i].seconds) continue;
    out += fmt::format("\n{} --> {}\n{}\n", vtt_time(events[i].seconds), vtt_time(end), vtt_text(events[i].what));
  }
  return out;
}

}  // namespace bookspin
