#include "scene/judge.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

namespace bookspin {
namespace {

struct Bound {
  std::string_view words;  // in the script, with spaces
  double value;
  bool from_below;  // the value must be at least the bound
  bool every;       // in every frame, or in some
};

std::vector<Bound> bounds_of(const Expectation& e) {
  std::vector<Bound> bounds;
  if (e.at_least) bounds.push_back({"at least", *e.at_least, true, true});
  if (e.at_most) bounds.push_back({"at most", *e.at_most, false, true});
  if (e.rises_to) bounds.push_back({"rises to", *e.rises_to, true, false});
  if (e.falls_to) bounds.push_back({"falls to", *e.falls_to, false, false});
  return bounds;
}

// To four digits, or as many as show on which side of the bound it lies.
std::string found_text(double found, double bound) {
  std::string text;
  for (int digits = 4; digits <= 17; ++digits) {
    text = fmt::format("{:.{}g}", found, digits);
    const double shown = std::strtod(text.c_str(), nullptr);
    if ((shown < bound) == (found < bound) && (shown > bound) == (found > bound)) break;
  }
  return text;
}

Verdict judge_bound(const Expectation& e, const Bound& bound, const std::vector<BookFrame>& frames) {
  const int end = static_cast<int>(frames.size());
  const int last = e.last_frame.value_or(end - 1);
  Verdict verdict;
  verdict.says = e.says;
  verdict.quantity = e.quantity;
  const std::string range =
      e.first_frame == last ? fmt::format("in frame {}", last) : fmt::format("in frames {} to {}", e.first_frame, last);
  const Quantity& q = quantity(e.quantity);
  const std::string wanted =
      fmt::format("{} {} {}{}{}", q.name, bound.words, bound.value, q.unit.empty() ? "" : " ", q.unit);
  if (e.first_frame >= end || last >= end) {
    verdict.found = std::nan("");
    verdict.frame = end - 1;
    verdict.text = fmt::format("{} {}: the film ends at frame {}", wanted, range, end - 1);
    return verdict;
  }
  // The value that decides is the smallest for "at least" and "falls to", else the largest; for bounds on every frame a
  // NaN decides.
  const bool smallest = bound.from_below == bound.every;
  verdict.found = frames[static_cast<std::size_t>(e.first_frame)][e.quantity];
  verdict.frame = e.first_frame;
  for (int n = e.first_frame + 1; n <= last; ++n) {
    const double value = frames[static_cast<std::size_t>(n)][e.quantity];
    const bool worse = smallest ? value < verdict.found : value > verdict.found;
    const bool nan_decides =
        bound.every ? std::isnan(value) && !std::isnan(verdict.found) : !std::isnan(value) && std::isnan(verdict.found);
    if (worse || nan_decides) {
      verdict.found = value;
      verdict.frame = n;
    }
  }
  verdict.met = bound.from_below ? verdict.found >= bound.value : verdict.found <= bound.value;
  verdict.text = fmt::format("{} {}: found {}{}", wanted, range, found_text(verdict.found, bound.value),
                             e.first_frame == last ? "" : fmt::format(" in frame {}", verdict.frame));
  return verdict;
}

}  // namespace

std::vector<Verdict> judge(const Scene& scene, const Trajectory& trajectory) {
  std::vector<Verdict> verdicts;
  for (const Expectation& e : scene.expectations) {
    for (const Bound& bound : bounds_of(e)) {
      verdicts.push_back(judge_bound(e, bound, trajectory.books[static_cast<std::size_t>(e.book)].frames));
    }
  }
  return verdicts;
}

}  // namespace bookspin
