#include "scene/did_you_mean.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

namespace bookspin {
namespace {

// The fewest letters to insert, delete, replace or swap with their neighbor. Source: Damerau and Levenshtein, as optimal
// string alignment.
std::size_t edits(std::string_view from, std::string_view to) {
  std::vector<std::vector<std::size_t>> d(from.size() + 1, std::vector<std::size_t>(to.size() + 1));
  for (std::size_t i = 0; i <= from.size(); ++i) {
    for (std::size_t j = 0; j <= to.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1]) {
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
      }
    }
  }
  return d[from.size()][to.size()];
}

}  // namespace

std::optional<std::string> near_match(std::string_view word, std::span<const std::string> known) {
  constexpr std::size_t longest = 64;  // a longer one is no word
  if (known.empty() || word.size() > longest) return {};
  const auto near = std::min_element(known.begin(), known.end(), [&](const std::string& a, const std::string& b) {
    return edits(word, a) < edits(word, b);
  });
  if (edits(word, *near) > word.size() / 3) return {};
  return *near;
}

std::string did_you_mean(std::string_view word, std::span<const std::string> known) {
  if (const auto near = near_match(word, known)) return fmt::format("did you mean {}?", *near);
  return fmt::format("allowed: {}", fmt::join(known, ", "));
}

}  // namespace bookspin
