// The three methods once more, straight from the paper's formulas: the second opinion that every step is checked
// against.
//
// Plain arrays and loops, no Eigen; every F_ij computed on its own, without Newton's third law (an 8 x 8 matrix of
// forces); SVD normalization replaced by what it computes, the orthogonal factor of the polar decomposition, by
// Newton's iteration X <- (X + X^-T) / 2; quaternion product by Hamilton's table. Same units and frames as
// dynamics/book.h. Sources: paper sections 3 and 4; Higham, SIAM J. Sci. Stat. Comput. 7 (1986) 1160.
#pragma once

#include <array>

#include "dynamics/book.h"

namespace bookspin {

using Vector = std::array<double, 3>;
using Matrix = std::array<Vector, 3>;  // row by row

Vector naive_cross(const Vector& a, const Vector& b);
Matrix naive_polar(Matrix X);

struct NaiveSprings {
  explicit NaiveSprings(const BookOptions& options);
  void step(double h);
  double kinetic_energy() const;
  double elastic_energy() const;
  Vector force(int i) const;

  BookOptions options;
  std::array<Vector, 8> x{};  // world frame
  std::array<Vector, 8> v{};
  std::array<std::array<double, 8>, 8> rest_length{};
  double E0 = 0.0;
  int steps = 0;
  long floor_hits = 0;
};

struct NaiveRigid {
  explicit NaiveRigid(const BookOptions& options);
  Vector omega_W(const Matrix& R_WB) const;

  BookOptions options;
  Vector I_B{};
  Vector L_W{};
  int steps = 0;
};

struct NaiveMatrix : NaiveRigid {
  using NaiveRigid::NaiveRigid;
  void step(double h);

  Matrix R_WB{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};

struct NaiveQuaternion : NaiveRigid {
  using NaiveRigid::NaiveRigid;
  void step(double h);
  Matrix R_WB() const;  // the usual formula, whatever |q|

  std::array<double, 4> q{1, 0, 0, 0};  // w, x, y, z
};

}  // namespace bookspin
