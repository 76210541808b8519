// What a C++ library without exceptions and without a system lacks: see live.h.
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <typeinfo>

extern "C" {

__attribute__((import_module("bookspin"), import_name("fail"))) void bookspin_fail(const char* text, std::size_t size);

// NOLINTBEGIN(bugprone-reserved-identifier): the names are those of the C++ ABI
void* __cxa_allocate_exception(std::size_t size) noexcept {
  return std::malloc(size);
}

// Everything that this program throws is a std::exception with no second base.
[[noreturn]] void __cxa_throw(void* thrown, std::type_info*, void (*)(void*)) {
  const char* what = static_cast<const std::exception*>(thrown)->what();
  bookspin_fail(what, std::strlen(what));
  __builtin_trap();
}
// NOLINTEND(bugprone-reserved-identifier)
}
