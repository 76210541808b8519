#include "page/cues.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

namespace bookspin {
namespace {

using Book = FilmRecord::Book;
using Cue = FilmRecord::Cue;
using Frames = std::vector<bool>;  // one a frame of the clip: whether it holds there

constexpr double least_seconds = 1.0;      // seconds that a cue stands at least
constexpr double longest = 5.0;            // seconds
constexpr double most_pulsations = 100.0;  // that are told
constexpr double vibration_seconds = 0.5;  // of the film, a period of any vibration and more

// What may hold of a book. Every sentence begins with "The book".
struct Statement {
  std::string sentence;
  std::function<Frames(const Book&)> where;
};

// Where a statement holds, and of whom.
struct Run {
  const Statement* statement;
  std::vector<std::string> who;
  int first;
  int end;  // the first frame where it does not
};

// Where `holds` of a quantity, until the book explodes; nowhere when the film does not have it.
template <typename Holds>
Frames where(const Book& book, const std::string& quantity, const Holds& holds) {
  const auto found = book.data.find(quantity);
  if (found == book.data.end()) return {};
  Frames frames(found->second.size());
  const auto end = static_cast<std::size_t>(book.exploded_frame.value_or(static_cast<int>(frames.size())));
  for (std::size_t n = 0; n < end; ++n) frames[n] = holds(found->second[n]);
  return frames;
}

enum Turn { none, steady, turning_over, over, turning_back, back };

// Steady: until the axis first tips by 10 degrees. Over: once it has come to 150 degrees as long as it is past 120;
// back: once it has come to 30 as long as it is within 60. Turning: since it left the other side for good.
std::vector<Turn> turns_of(const std::vector<double>& tilt) {
  std::vector<Turn> turns(tilt.size(), none);
  Turn side = steady;
  for (std::size_t n = 0; n < tilt.size(); ++n) {
    if (side == over ? tilt[n] <= 30.0 : tilt[n] >= 150.0) {
      side = side == over ? back : over;
      for (std::size_t k = n; k-- > 0 && (side == over ? tilt[k] > 20.0 : tilt[k] < 160.0);) {
        turns[k] = side == over ? turning_over : turning_back;
      }
    }
    if (side == steady && !(tilt[n] <= 10.0)) side = none;
    if (side == over ? tilt[n] > 120.0 : tilt[n] < 60.0) turns[n] = side;
  }
  return turns;
}

Statement turned(Turn turn, const char* sentence) {
  return {sentence, [turn](const Book& book) {
            const auto tilt = book.data.find("tilt");
            if (tilt == book.data.end()) return Frames();
            const std::vector<Turn> turns = turns_of(tilt->second);
            auto now = turns.begin();
            return where(book, "tilt", [&](double) { return *now++ == turn; });
          }};
}

Statement at_least(const char* quantity, double bound, const char* sentence) {
  return {sentence, [=](const Book& book) { return where(book, quantity, [=](double v) { return v >= bound; }); }};
}

Statement at_most(const char* quantity, double bound, const char* sentence) {
  return {sentence, [=](const Book& book) { return where(book, quantity, [=](double v) { return v <= bound; }); }};
}

// A book that vibrates passes through its shape, and is out of it all the same.
Frames out_of_shape(const Book& book, int frames_after) {
  int since = frames_after + 1;
  return where(book, "stretch", [&](double v) {
    since = v >= 0.1 ? 0 : since + 1;
    return since <= frames_after;
  });
}

// What begins together is told in this order.
std::vector<Statement> statements_for(const FilmRecord& film) {
  const int vibration = static_cast<int>(vibration_seconds * film.fps);
  std::vector<Statement> all{
      turned(steady, "The book spins steadily about its axis."),
      turned(turning_over, "The book is turning over."),
      turned(over, "The book has turned over."),
      turned(turning_back, "The book is turning back."),
      turned(back, "The book has turned back."),
      at_least("energy_ratio", 2.0, "The book has twice its energy and more."),
      at_least("energy_ratio", 10.0, "The book has ten times its energy and more."),
      at_least("energy_ratio", 100.0, "The book has a hundred times its energy and more."),
      at_most("angular_momentum_ratio", 0.5, "The book slows down: half of its angular momentum is lost."),
      at_most("angular_momentum_ratio", 0.1, "The book has lost nine tenths of its angular momentum."),
      at_least("angle_error", std::numbers::pi / 2.0, "The book is a right angle and more away from the exact motion."),
      {"The book is out of shape: lengths change by a tenth and more.",
       [=](const Book& book) { return out_of_shape(book, vibration); }},
  };
  double most = 0.0;
  for (const Book& book : film.books) {
    const auto counts = book.data.find("pulsations");
    if (counts != book.data.end() && book.method != "springs") most = std::max(most, std::ranges::max(counts->second));
  }
  for (int count = 1; count <= std::min(most, most_pulsations); ++count) {
    const std::string times = count == 1 ? "once" : count == 2 ? "twice" : fmt::format("{} times", count);
    all.push_back({fmt::format("The book has swollen and shrunk {}.", times), [count](const Book& book) {
                     // Springs do so too, but too fast for words.
                     return where(book, "pulsations", [&](double v) { return v == count && book.method != "springs"; });
                   }});
  }
  all.push_back({"The book has exploded: a corner is twice as far out as at rest.", [&film](const Book& book) {
                   Frames frames(static_cast<std::size_t>(film.frames));
                   std::fill(frames.begin() + book.exploded_frame.value_or(film.frames), frames.end(), true);
                   return frames;
                 }});
  return all;
}

// One for each time that a statement becomes true of a book: of all of which it is true then, as long as it is.
void add_runs(std::vector<Run>& runs, const Statement& statement, const FilmRecord& film) {
  std::vector<Frames> holds;
  for (const Book& book : film.books) {
    holds.push_back(statement.where(book));
    holds.back().resize(static_cast<std::size_t>(film.frames));
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(film.frames); ++n) {
    if (std::none_of(holds.begin(), holds.end(), [n](const Frames& h) { return h[n] && (n == 0 || !h[n - 1]); }))
      continue;
    Run run{&statement, {}, static_cast<int>(n), film.frames};
    for (std::size_t b = 0; b < holds.size(); ++b) {
      if (!holds[b][n]) continue;
      run.who.push_back(film.books[b].name);
      const auto end = std::find(holds[b].begin() + static_cast<std::ptrdiff_t>(n), holds[b].end(), false);
      run.end = std::min(run.end, static_cast<int>(end - holds[b].begin()));
    }
    runs.push_back(run);
  }
}

std::vector<Cue> found_in(const FilmRecord& film) {
  const std::vector<Statement> statements = statements_for(film);
  std::vector<Run> runs;
  for (const Statement& statement : statements) add_runs(runs, statement, film);
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.first < b.first; });

  const int least = static_cast<int>(least_seconds * film.fps);
  std::vector<Run> told;
  for (Run run : runs) {
    const bool is_explosion = run.statement == &statements.back();
    // The same of more books replaces what cannot be read before; so does an explosion, which can be the end.
    while (!told.empty() && run.first < told.back().first + least &&
           (is_explosion || run.statement == told.back().statement)) {
      told.pop_back();
    }
    if (!told.empty()) run.first = std::max(run.first, told.back().first + least);
    if (run.end - run.first < least && !is_explosion) continue;
    if (!told.empty()) told.back().end = std::min(told.back().end, run.first);
    told.push_back(run);
  }
  std::vector<Cue> cues;
  for (const Run& run : told) {
    const int end = std::min(run.end, run.first + static_cast<int>(longest * film.fps));
    cues.push_back({run.first, end, run.statement->sentence});
    if (film.books.size() == 1) continue;
    const char* subject = run.who.size() == 1 ? "the book" : "each book";
    cues.back().text.replace(0, std::strlen("The book"), fmt::format("{}: {}", fmt::join(run.who, ", "), subject));
  }
  return cues;
}

std::string vtt_time(const FilmRecord& film, int frame) {
  const auto ms = std::llround((frame - film.first_frame) * 1000.0 / film.fps);
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

std::vector<Cue> cues_of(const FilmRecord& film) {
  std::vector<Cue> cues;
  for (Cue cue : film.cues.empty() ? found_in(film) : film.cues) {
    cue.first = std::max(cue.first, film.first_frame);
    cue.end = std::min(cue.end, film.first_frame + film.drawn_frames);
    if (cue.first < cue.end) cues.push_back(cue);
  }
  return cues;
}

std::string web_vtt(const FilmRecord& film, const std::vector<Cue>& cues) {
  std::string out = "WEBVTT\n";
  for (const Cue& cue : cues) {
    out += fmt::format("\n{} --> {}\n{}\n", vtt_time(film, cue.first), vtt_time(film, cue.end), vtt_text(cue.text));
  }
  return out;
}

}  // namespace bookspin
