// The reference of scene scripts, of the keys that the reader declares and the tables of quantities, overlays and
// integrators: nothing in it is written twice.
#pragma once

#include <string>

namespace bookspin {

[[nodiscard]] std::string script_manual();  // Markdown that reads well as it is: videos/README.md
[[nodiscard]] std::string script_schema();  // JSON schema, for editors; `bookspin check` says what it cannot

}  // namespace bookspin
