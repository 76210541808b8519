#include "page/events.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <span>

namespace bookspin {
namespace {

using Book = FilmRecord::Book;

constexpr double together = 0.5;         // seconds: what a reader takes in at once
constexpr double longest_cue = 4.0;      // seconds
constexpr double quarter_turn = 1.5708;  // radians between a book and the exact one that nobody can overlook

struct Found {
  int frame;
  std::string who;   // the book's name; empty: what is a whole sentence
  std::string what;  // it does: "has turned over"
};

// The frames of a quantity before `end`; none when the film does not have it.
std::span<const double> values_of(const Book& book, const char* quantity, int end) {
  const auto found = book.data.find(quantity);
  if (found == book.data.end()) return {};
  return std::span(found->second).first(static_cast<std::size_t>(end));
}

// The first frame before `end` at which the quantity has reached the bound, upwards or downwards.
void add_crossing(std::vector<Found>& found, const Book& book, const char* quantity, double bound, bool up, int end,
                  const std::string& what) {
  const auto values = values_of(book, quantity, end);
  const auto crossing =
      std::find_if(values.begin(), values.end(), [&](double v) { return up ? v >= bound : v <= bound; });
  if (crossing != values.end()) found.push_back({static_cast<int>(crossing - values.begin()), book.name, what});
}

// Each frame at which a count has risen.
template <typename Words>
void add_counts(std::vector<Found>& found, const Book& book, const char* quantity, int end, const Words& words) {
  const auto counts = values_of(book, quantity, end);
  for (std::size_t n = 1; n < counts.size(); ++n) {
    if (counts[n] > counts[n - 1]) found.push_back({static_cast<int>(n), book.name, words(std::llround(counts[n]))});
  }
}

void add_book(std::vector<Found>& found, const Book& book, int frames) {
  const int end = book.exploded_frame.value_or(frames);
  add_counts(found, book, "flips", end,
             [](long long n) { return fmt::format("has turned {} (flip {})", n % 2 == 1 ? "over" : "back", n); });
  // The vibration of springs swells and shrinks too, but too fast for words.
  if (book.method != "springs") {
    add_counts(found, book, "pulsations", end,
               [](long long n) { return fmt::format("has swollen and shrunk (pulsation {})", n); });
    add_crossing(found, book, "largest_singular_value", 1.2, true, end, "has grown by a fifth");
  }
  add_crossing(found, book, "energy_ratio", 2.0, true, end, "has twice its energy");
  add_crossing(found, book, "angular_momentum_ratio", 0.5, false, end, "has lost half its angular momentum");
  add_crossing(found, book, "angular_momentum_ratio", 0.1, false, end, "has lost nine tenths of its angular momentum");
  add_crossing(found, book, "angle_error", quarter_turn, true, end, "is a right angle away from the exact motion");
  if (book.exploded_frame) found.push_back({end, book.name, "explodes; the film holds on the last picture before"});
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
  if (text.empty()) return text;
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  return text.back() == '.' ? text : text + '.';
}

std::string vtt_time(double seconds) {
  const auto ms = std::llround(seconds * 1000.0);
  return fmt::format("{:02}:{:02}:{:02}.{:03}", ms / 3600000, ms / 60000 % 60, ms / 1000 % 60, ms % 1000);
}

// One line: an empty one would end the cue.
std::string vtt_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < ' ';
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, control ? ' ' : c);
  }
  return out;
}

}  // namespace

std::vector<Event> events_of(const FilmRecord& film) {
  std::vector<Found> found;
  for (const Book& book : film.books) add_book(found, book, film.frames);
  for (const FilmRecord::Expectation& expectation : film.expectations) {
    const std::string says = sentence(expectation.says);
    if (!says.empty() && expectation.met) found.push_back({expectation.frame, "", says});
  }
  std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.frame < b.frame; });

  const int first = film.first_frame;
  std::vector<Event> events;
  for (auto from = found.begin(); from != found.end();) {
    auto to = from;
    while (to != found.end() && to->frame - from->frame < together * film.fps) ++to;
    if (from->frame >= first && from->frame < first + film.drawn_frames) {
      events.push_back({static_cast<double>(from->frame - first) / film.fps, told({from, to}, film.books.size() > 1)});
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
