// What this program is made of, for who reports a fault: its version, the commit of its sources when it was built from a
// checkout ("+": and changes since), the compiler, and the libraries that it runs with.
#pragma once

#include <string>

namespace bookspin {

[[nodiscard]] std::string version();  // "bookspin 1.0"
[[nodiscard]] std::string version_text();
[[nodiscard]] std::string commit();  // alone; empty when not built from a checkout

}  // namespace bookspin
