// The book at rest and what a script may say about how it moves.
//
// One body serves every method: eight particles of equal mass m at the corners of an a x b x c cuboid. Its principal
// moments are 2 m (b^2 + c^2, a^2 + c^2, a^2 + b^2): three times those of the solid cuboid of the same mass, and twice
// those that the original program used, so that from equal angular velocities the torque-free motion is the same for
// all of them. Units are the scene's own (length, time, mass); energies and angular momenta follow from them. Source:
// paper sections 3.1 and 4.
#pragma once

#include <Eigen/Core>

#include "dynamics/corners.h"

namespace bookspin {

// Which method takes which: scene/scene_file.cpp. What each does: spring_book.h, rigid_book.h, rigid_steps.h.
enum class Integrator {
  explicit_euler,
  semi_implicit_euler,
  velocity_verlet,
  rk4,
  composition8,
  splitting2,
  splitting4,
  dmv2,
  dmv6,
  dmv10
};

struct BookOptions {
  Eigen::Vector3d size{1.878, 2.9085, 0.5};  // full edge lengths a, b, c along the body axes, > 0
  Eigen::Vector3d omega_W{0.0, 0.0,
                          0.0};  // angular velocity at the start, radians per unit of time, world = body frame
  Integrator integrator = Integrator::explicit_euler;  // how the state is stepped
  bool normalize = true;                               // springs: energy and drift; matrix: U V^T; quaternion: q / |q|
  int normalize_every = 1;                             // steps between two normalizations, >= 1
  double damping = 1.0;                                // springs only: multiple of the critical 2 sqrt(k m), >= 0
  double stiffness = 10.0;                             // springs only: k of each of the 28 springs, > 0
  double particle_mass = 1.0;                          // m of each of the eight particles, > 0
};

// Corners of the book at rest, centred on the origin, body frame.
[[nodiscard]] Corners corners_at_rest(const Eigen::Vector3d& size);

// Principal moments of inertia of the eight particles, mass times length squared.
[[nodiscard]] Eigen::Vector3d principal_moments(const Eigen::Vector3d& size, double particle_mass);

}  // namespace bookspin
