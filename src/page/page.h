// Writes the course page, index.html, beside the films that it shows: every NAME.json in the folder that is a film's
// data (page/film_record.h), whoever's script it was; and each film's captions, NAME.vtt. All take their names together.
//
// The page needs nothing but films and posters: style, script, captions and drawings (*.svg of the templates) are
// written into it, the charts are drawn here. In template.html, {{film NAME: panels}} is the place of NAME, panels as
// chart.h says. When half of these are there, the template's {{#story}} is told: the others' places say what is missing,
// films without a place follow under {{#more}}. Else all are under {{#more}}. film.html is one film on the page,
// figure.html the snippet for one's own page; see fill.h. {{#live}} is the panel, docs/LIVE.md; {{#speed}} a table of
// report/report.json; both where they are there. Throws as read_film_record does, and std::runtime_error (file,
// operation, the library's text) when there is no film, a product of one is missing, or a file cannot be written; an
// older page then survives.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace bookspin {

struct LiveParts {
  std::filesystem::path module;    // live.wasm
  std::filesystem::path shaders;   // folder
  std::filesystem::path textures;  // folder of *.svg
};

struct PageOrder {
  std::filesystem::path site;          // folder of NAME.json, NAME.png and NAME.mp4; index.html goes there
  std::filesystem::path templates;     // folder of template.html and what it takes in
  std::optional<LiveParts> live = {};  // none: the page is whole without its panel
};

struct PageReceipt {
  std::filesystem::path file;
  int films = 0;             // and stills
  std::uintmax_t bytes = 0;  // of the page itself
};

PageReceipt write_page(const PageOrder& order);

}  // namespace bookspin
