// Writes the course page, index.html, beside the films that it shows.
//
// One file that needs nothing but the films and posters beside it: style and script are written into it, the captions
// are data: addresses, the charts are drawn here (a browser reads no other file's data from a folder opened as
// file://). In template.html, {{film NAME: panels}} is the place of the film videos/NAME.toml, panels as chart.h says;
// a film that has no place there follows under "more". A place whose film is not among `films` stays empty. film.html
// is one film on the page, figure.html the snippet for one's own page; fill.h says what else a template may hold.
// Throws std::runtime_error (file, operation, the library's text) when a product of a film is missing or cannot be
// read, or the page cannot be written; an older page then survives.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace bookspin {

struct PageOrder {
  std::filesystem::path site;       // folder of NAME.json, NAME.png and NAME.mp4; index.html goes there
  std::filesystem::path templates;  // folder of template.html, film.html, figure.html, page.css, page.js
  std::vector<std::string> films;   // names, in the order in which those without a place are shown
};

struct PageReceipt {
  std::filesystem::path file;
  int films = 0;             // and stills
  std::uintmax_t bytes = 0;  // of the page itself
};

PageReceipt write_page(const PageOrder& order);

}  // namespace bookspin
