#include "dynamics/naive_book.h"

#include <algorithm>
#include <cmath>

namespace bookspin {
namespace {

double length(const Vector& a) {
  return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

bool time_to_normalize(const BookOptions& options, int steps) {
  return options.normalize_every > 0 && steps % options.normalize_every == 0;
}

}  // namespace

Vector naive_cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

Matrix naive_polar(Matrix X) {
  for (int iteration = 0; iteration < 60; ++iteration) {
    // X^-T is the matrix of cofactors over the determinant; its rows are cross products of the rows of X.
    Matrix cofactors{naive_cross(X[1], X[2]), naive_cross(X[2], X[0]), naive_cross(X[0], X[1])};
    const double det = X[0][0] * cofactors[0][0] + X[0][1] * cofactors[0][1] + X[0][2] * cofactors[0][2];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) X[i][j] = 0.5 * (X[i][j] + cofactors[i][j] / det);
    }
  }
  return X;
}

NaiveSprings::NaiveSprings(const BookOptions& o) : options(o) {
  const Vector omega{o.omega_W[0], o.omega_W[1], o.omega_W[2]};
  for (std::size_t i = 0; i < 8; ++i) {
    x[i][0] = (i == 1 || i == 3 || i == 5 || i == 7) ? o.size[0] / 2 : -o.size[0] / 2;
    x[i][1] = (i == 2 || i == 3 || i == 6 || i == 7) ? o.size[1] / 2 : -o.size[1] / 2;
    x[i][2] = i >= 4 ? o.size[2] / 2 : -o.size[2] / 2;
    v[i] = naive_cross(omega, x[i]);
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) rest_length[i][j] = length(difference(x[i], x[j]));
  }
  E0 = kinetic_energy();
}

double NaiveSprings::kinetic_energy() const {
  double sum = 0.0;
  for (const Vector& vi : v) sum += options.particle_mass * length(vi) * length(vi) / 2;
  return sum;
}

double NaiveSprings::elastic_energy() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      const double r = length(difference(x[i], x[j])) - rest_length[i][j];
      sum += options.stiffness * r * r / 2 / 2;  // each spring is met twice
    }
  }
  return sum;
}

Vector NaiveSprings::force(int particle) const {
  const auto i = static_cast<std::size_t>(particle);
  const double c = options.damping * 2 * std::sqrt(options.stiffness * options.particle_mass);
  Vector F{};
  for (std::size_t j = 0; j < 8; ++j) {
    const Vector d = difference(x[i], x[j]);
    const Vector u = difference(v[i], v[j]);
    const double l = length(d);
    if (l == 0.0) continue;  // the particle itself, or one in the same place
    const double approach = (d[0] * u[0] + d[1] * u[1] + d[2] * u[2]) / l;
    for (std::size_t n = 0; n < 3; ++n) {
      F[n] += -options.stiffness * (l - rest_length[i][j]) * d[n] / l - c * approach * d[n] / l;
    }
  }
  return F;
}

void NaiveSprings::step(double h) {
  const double elastic_before = elastic_energy();
  std::array<Vector, 8> F;
  for (int i = 0; i < 8; ++i) F[static_cast<std::size_t>(i)] = force(i);
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t n = 0; n < 3; ++n) {
      x[i][n] = x[i][n] + h * v[i][n];
      v[i][n] = v[i][n] + h * F[i][n] / options.particle_mass;
    }
  }
  ++steps;
  if (!time_to_normalize(options, steps)) return;

  double wanted = E0 - elastic_before;
  if (wanted < 0.1 * E0) {
    wanted = 0.1 * E0;
    ++floor_hits;
  }
  const double now = kinetic_energy();
  const double factor = now > 0.0 ? std::sqrt(wanted / now) : 1.0;
  Vector mean_x{};
  Vector mean_v{};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t n = 0; n < 3; ++n) {
      v[i][n] *= factor;
      mean_x[n] += x[i][n] / 8;
      mean_v[n] += v[i][n] / 8;
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t n = 0; n < 3; ++n) {
      x[i][n] -= mean_x[n];
      v[i][n] -= mean_v[n];
    }
  }
}

NaiveRigid::NaiveRigid(const BookOptions& o) : options(o) {
  // I = sum m (r^2 1 - r r^T) over the eight corners: the definition; its other entries cancel.
  for (std::size_t i = 0; i < 3; ++i) {
    const double y = o.size[static_cast<long>(i + 1) % 3] / 2;
    const double z = o.size[static_cast<long>(i + 2) % 3] / 2;
    for (int corner = 0; corner < 8; ++corner) I_B[i] += o.particle_mass * (y * y + z * z);
    L_W[i] = I_B[i] * o.omega_W[static_cast<long>(i)];
  }
}

Vector NaiveRigid::omega_W(const Matrix& R) const {
  Vector omega{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t n = 0; n < 3; ++n) omega[i] += R[i][n] / I_B[n] * R[j][n] * L_W[j];
    }
  }
  return omega;
}

void NaiveMatrix::step(double h) {
  const Vector w = omega_W(R_WB);
  const Matrix star{{{0, -w[2], w[1]}, {w[2], 0, -w[0]}, {-w[1], w[0], 0}}};
  Matrix next = R_WB;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t n = 0; n < 3; ++n) next[i][j] += h * star[i][n] * R_WB[n][j];
    }
  }
  R_WB = next;
  ++steps;
  if (time_to_normalize(options, steps)) R_WB = naive_polar(R_WB);
}

Matrix NaiveQuaternion::R_WB() const {
  const auto [w, x, y, z] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}}};
}

void NaiveQuaternion::step(double h) {
  const Vector o = omega_W(R_WB());
  const auto [w, x, y, z] = q;
  // (0, omega) q by i^2 = j^2 = k^2 = ijk = -1.
  const std::array<double, 4> product{-o[0] * x - o[1] * y - o[2] * z, o[0] * w + o[1] * z - o[2] * y,
                                      o[1] * w + o[2] * x - o[0] * z, o[2] * w + o[0] * y - o[1] * x};
  for (std::size_t n = 0; n < 4; ++n) q[n] += h * 0.5 * product[n];
  ++steps;
  if (!time_to_normalize(options, steps)) return;
  const double norm = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  for (double& component : q) component /= norm;
}

}  // namespace bookspin
