// Speed against error: every method at ever finer steps, its largest error over 60 samples and the time it takes.
//
// Rigid methods: the geodesic angle (radians) to the reference trajectories of data/reference, cases a to d.
// Methods of the program run as a script runs them, normalized after every step; Boost.Odeint's solve q' = q omega / 2,
// L' = L x omega. Springs: the farthest that a corner is from where it should be, in half diagonals of the book, for
// the undamped springs of ref_springs.txt against that file, for others against the exact motion of the rigid body.
// Throws std::runtime_error when a reference cannot be read.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <vector>

#include "dynamics/book.h"
#include "report/measure.h"
#include "report/table.h"

namespace bookspin {

[[nodiscard]] int evaluations_a_step(Integrator integrator);

struct RigidCase {
  std::string letter;  // a, b, c, d
  Eigen::Vector3d I_B;
  Eigen::Vector3d L_W;
  double T = 0.0;
  std::vector<Eigen::Quaterniond> q_WB;  // at the samples T / n, 2 T / n, ... T

  // The same motion as options of the program's books: particles of mass 1/2 on a cuboid with these moments.
  [[nodiscard]] BookOptions options() const;
};

[[nodiscard]] std::vector<RigidCase> read_rigid_cases(const std::filesystem::path& reference);

void rigid_work_precision(const RigidCase& rigid_case, const Effort& effort, std::vector<Run>& runs);

// One evaluation of the exact motion, in nanoseconds: what a film's frame needs of it.
[[nodiscard]] double exact_evaluation_ns();

void spring_work_precision(const std::filesystem::path& reference, const Effort& effort, std::vector<Run>& runs);

void springs_against_rigid(const Effort& effort, std::vector<Run>& runs);

// Model error and integration error of the springs apart, over stiffness.
[[nodiscard]] Table spring_model_error(const Effort& effort);

// For each method of a problem the cheapest run that reaches each error: ns a unit of time, "never" when none does.
[[nodiscard]] Table cheapest(const std::vector<Run>& runs, const std::string& problem,
                             const std::vector<double>& errors);

[[nodiscard]] Table all_runs(const std::vector<Run>& runs);

}  // namespace bookspin
