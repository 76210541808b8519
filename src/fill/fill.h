// Fills a template with data, by the part of the Mustache language that the pages need.
//
//   {{key}}            the value, with & < > " ' escaped: safe as text and inside a quoted attribute
//   {{{key}}}          the value as it is
//   {{#key}}...{{/key}}  once for each entry of a list, once for a true or non-empty value, else not at all
//   {{^key}}...{{/key}}  once when {{#key}} would show nothing
//
// A key is looked up from the inside out; a dot enters an object (films.fig05), a lone dot is the entry itself. A
// section's key may be unknown: that is a false. Throws std::runtime_error with file and line for an unknown key and
// for tags that do not match. Source: mustache(5).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace bookspin {

[[nodiscard]] std::string fill(std::string_view text, const nlohmann::json& data, const std::string& file);

[[nodiscard]] std::string escape_html(std::string_view text);

}  // namespace bookspin
