// What happens when in a film, in words: for its captions and for those who cannot see it.
//
// Found in the film's data: flips, pulsations, the explosion, energy doubled, angular momentum lost, the exact motion
// left behind; and where each expectation of the script was decided. Seconds of the film, ascending; events within half
// a second of each other become one. The WebVTT text has a cue for each event that lasts until the next one, at most
// 4 s; whatever a script says, a cue is one line. Source: WebVTT, W3C.
#pragma once

#include <string>
#include <vector>

#include "page/film_record.h"

namespace bookspin {

struct Event {
  double seconds = 0.0;  // from the start of the film
  std::string what;      // one or more sentences
};

[[nodiscard]] std::vector<Event> events_of(const FilmRecord& film);

[[nodiscard]] std::string web_vtt(const std::vector<Event>& events, double film_seconds);

}  // namespace bookspin
