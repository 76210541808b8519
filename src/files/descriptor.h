// A file descriptor that is closed at its end. Below 0: none.
#pragma once

#include <unistd.h>

namespace bookspin {

struct Descriptor {
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  const int number;
};

}  // namespace bookspin
