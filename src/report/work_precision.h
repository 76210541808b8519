// The rigid cases a to d of data/reference, by which solvers are measured: the geodesic angle, radians.
//
// Methods of the program run as a script runs them, normalized after every step; Boost.Odeint's solve q' = q omega / 2,
// L' = L x omega. Throws std::runtime_error when a reference cannot be read.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <string>
#include <vector>

#include "report/runs.h"

namespace bookspin {

struct RigidCase {
  Problem problem;
  std::string letter;  // a, b, c, d
  Eigen::Vector3d I_B;
  Eigen::Vector3d L_W;
  double T = 0.0;
  std::vector<Eigen::Quaterniond> q_WB;  // at the samples T / n, 2 T / n, ... T

  // The same motion as options of the program's books: particles of mass 1/2 on a cuboid with these moments.
  [[nodiscard]] BookOptions options() const;
};

[[nodiscard]] std::vector<RigidCase> read_rigid_cases(const std::filesystem::path& reference);

}  // namespace bookspin
