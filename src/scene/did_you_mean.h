// The near match for a word that is not known.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace bookspin {

[[nodiscard]] std::optional<std::string> near_match(std::string_view word, std::span<const std::string> known);

// "did you mean render?", or "allowed: list, render, ..." when nothing known is near.
[[nodiscard]] std::string did_you_mean(std::string_view word, std::span<const std::string> known);

}  // namespace bookspin
