// Random books and directions for tests: the same on every machine, since only the generator itself is the library's.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "dynamics/book.h"

namespace bookspin {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double least, double most) {
    return least + (most - least) * static_cast<double>(random_() >> 11U) * 0x1p-53;
  }
  Eigen::Vector3d vector(double most) {
    const double x = between(-most, most);
    const double y = between(-most, most);
    return {x, y, between(-most, most)};
  }
  Eigen::Quaterniond rotation() {
    Eigen::Quaterniond q(between(-1, 1), between(-1, 1), between(-1, 1), between(-1, 1));
    return q.normalized();
  }
  Corners corners(double most) {
    Corners corners;
    for (int i = 0; i < 8; ++i) corners.col(i) = vector(most);
    return corners;
  }

 private:
  std::mt19937_64 random_;
};

// A book of any proportions, stiffness and mass, about a general axis.
inline BookOptions random_options(std::uint64_t seed) {
  Dice dice(seed);
  BookOptions options;
  for (int d = 0; d < 3; ++d) options.size(d) = dice.between(0.3, 3.3);
  options.omega_W = dice.vector(0.5);
  options.stiffness = dice.between(2.0, 40.0);
  options.particle_mass = dice.between(0.3, 3.0);
  options.damping = dice.between(0.2, 1.2);
  return options;
}

// A step in the proportion of the original's 0.1 / 6 to its springs, k = 10 and m = 1: damped and stable.
inline double spring_step(const BookOptions& options) {
  return 0.05 * std::sqrt(options.particle_mass / options.stiffness);
}

// An irregular body, tumbling: no symmetry that could hide an error of low order (the paper's book is close to a flat
// plate).
inline BookOptions tumbling(Integrator integrator) {
  BookOptions o;
  o.size = {1.0, 1.7, 2.2};
  o.omega_W = {0.6, 0.5, 0.4};
  o.integrator = integrator;
  return o;
}

}  // namespace bookspin
