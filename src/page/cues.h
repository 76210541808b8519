// What happens when in a film, in words: its captions, and its story for those who cannot see it.
//
// The script's own cues, or else found in the motion: the book spins steadily, turns over and back, gains or loses
// energy and angular momentum, leaves its shape, pulsates, leaves the exact motion, explodes. A cue is one sentence; it
// begins when the sentence becomes true, and ends when it ceases to hold, when the next begins, or after five seconds.
// Cues do not overlap, and each stands for a second at least, but for one at the film's end. Source: WebVTT, W3C.
#pragma once

#include <string>
#include <vector>

#include "page/film_record.h"

namespace bookspin {

// In order, within the drawn frames.
[[nodiscard]] std::vector<FilmRecord::Cue> cues_of(const FilmRecord& film);

// The seconds are those of the film.
[[nodiscard]] std::string web_vtt(const FilmRecord& film, const std::vector<FilmRecord::Cue>& cues);

}  // namespace bookspin
