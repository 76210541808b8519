// The chart under a film: panels, one above the other, over the film's own time, as data for the template.
//
// `panels` names them: "tilt, energy_ratio+angular_momentum_ratio" makes two, the second with two curves a book. Empty:
// a choice by default. A panel holds title, heading, unit, low, high, log, ticks (at: percent from below, label), tick_unit and
// curves (label, color 0 ... 4, path); beside the panels stand times (at: percent from the left, label: the scene's t),
// marks of explosions (at, late: far to the right, label), seconds of the film, and from and span of t. A path is drawn
// in a square of 1000 x 1000, x the film's time, y downwards; it ends where its book explodes, and has no more points than a screen can show: of each stretch of
// time the smallest and the largest value, so that a vibration keeps its height. The axis is logarithmic where
// something grows more than thirtyfold. Throws std::invalid_argument for a quantity that the film does not have.
#pragma once

#include <nlohmann/json.hpp>
#include <string_view>

#include "page/film_record.h"

namespace bookspin {

[[nodiscard]] nlohmann::json chart_of(const FilmRecord& film, std::string_view panels);

}  // namespace bookspin
