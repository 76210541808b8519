// Writes the course page, index.html, beside the films that it shows: every NAME.json in the folder that is a film's
// data (page/film_record.h), whoever's script it was.
//
// One file that needs nothing but the films and posters beside it: style and script are written into it, the captions
// are data: addresses, the charts are drawn here (a browser reads no other file's data from a folder opened as
// file://). The captions are written as NAME.vtt too, for pages elsewhere; all take their names together. In template.html, {{film NAME: panels}} is the place of NAME, panels as chart.h says. When at least half of
// these are there, the template's {{#story}} is told: the others' places say what is missing, and films without a place
// follow under {{#more}}. Else all films are under {{#more}}, sorted by name. film.html is one film on the page,
// missing.html the place of one that is not there, figure.html the snippet for one's own page; see fill.h.
// Throws as read_film_record does, and std::runtime_error (file, operation, the library's text) when there is no film,
// a product of one is missing, or the page cannot be written; an older page then survives.
#pragma once

#include <cstdint>
#include <filesystem>

namespace bookspin {

struct PageOrder {
  std::filesystem::path site;       // folder of NAME.json, NAME.png and NAME.mp4; index.html goes there
  std::filesystem::path templates;  // folder of template.html, film.html, missing.html, figure.html, page.css, page.js
};

struct PageReceipt {
  std::filesystem::path file;
  int films = 0;             // and stills
  std::uintmax_t bytes = 0;  // of the page itself
};

PageReceipt write_page(const PageOrder& order);

}  // namespace bookspin
