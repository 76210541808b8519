// The measured quantities that a script can name, that a film's data holds and a chart draws: one table for all of
// them.
#pragma once

#include <span>
#include <string_view>

#include "scene/trajectory.h"

namespace bookspin {

struct Quantity {
  std::string_view name;     // as written in a script
  std::string_view unit;     // empty: a pure number
  std::string_view meaning;  // one line
  std::string_view symbol;   // short, as printed in a picture
  std::string_view format;   // of a value in a picture, as fmt reads it
  double (*of)(const BookFrame&);
};

[[nodiscard]] std::span<const Quantity> quantities();

[[nodiscard]] const Quantity* find_quantity(std::string_view name);  // nullptr: there is none of that name

}  // namespace bookspin
