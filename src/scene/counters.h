// What is counted along a motion, one value a frame, in the order of the frames.
#pragma once

#include <cmath>

namespace bookspin {

// Passages of a value between two levels: up past `high`, then down past `low`, and so on. It starts below.
class Passages {
 public:
  Passages(double low, double high) : low_(low), high_(high) {}

  int count(double value) {  // so far, with this value
    if (upper_ ? value < low_ : value > high_) {
      upper_ = !upper_;
      ++count_;
    }
    return count_;
  }

 private:
  double low_, high_;
  bool upper_ = false;
  int count_ = 0;
};

// Swellings: a rise to 1.1 times the least size since the last one, then a fall to 1 / 1.1 of the largest. It starts
// at 1.
class Pulsations {
 public:
  int count(double size) {  // so far, with this size
    least_ = std::fmin(least_, size);
    largest_ = std::fmax(largest_, size);
    if (!swollen_ && size >= 1.1 * least_) {
      swollen_ = true;
      largest_ = size;
    } else if (swollen_ && size <= largest_ / 1.1) {
      swollen_ = false;
      least_ = size;
      ++count_;
    }
    return count_;
  }

 private:
  double least_ = 1.0;
  double largest_ = 1.0;
  bool swollen_ = false;
  int count_ = 0;
};

}  // namespace bookspin
