// The report in the making: what its sections share while they run. For the .cpp files of this room, its tests and the
// bench. What reads a reference throws std::runtime_error when it cannot be read.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "report/measure.h"
#include "report/plots.h"
#include "report/report.h"
#include "scene/judge.h"

namespace bookspin {

// Springs against the rigid body: what the step's size adds, and what the springs themselves do. In half diagonals of
// the book, the largest over the samples; infinite: exploded.
struct ModelError {
  double stiffness;
  bool damped;
  bool normalized;
  Integrator integrator;
  double integration;  // from the springs' own motion
  double model;        // of the springs' own motion from the rigid one
  double all;          // of the run from the rigid motion
};

// A rigid case a to d of data/reference. Methods of the program run it as a script runs them, normalized after every
// step; Boost.Odeint's solve q' = q omega / 2, L' = L x omega. Error: the geodesic angle, radians.
struct RigidCase {
  Problem problem;
  std::string letter;  // a, b, c, d
  Eigen::Vector3d I_B = Eigen::Vector3d::Zero();
  Eigen::Vector3d L_W = Eigen::Vector3d::Zero();
  double T = 0.0;
  std::vector<Eigen::Quaterniond> q_WB;  // at the samples T / n, 2 T / n, ... T

  // The same motion as options of the program's books: particles of mass 1/2 on a cuboid with these moments.
  [[nodiscard]] BookOptions options() const;
};
[[nodiscard]] std::vector<RigidCase> read_rigid_cases(const std::filesystem::path& reference);

// At rest the springs are oscillators: the modes of the stiffness matrix K (see stability.cpp).
using Matrix24 = Eigen::Matrix<double, 24, 24>;
[[nodiscard]] Matrix24 stiffness_matrix(const Eigen::Vector3d& size);  // K m / k on the positions, corner by corner
struct SpringModes {
  Eigen::VectorXd mu;       // of K m / k, ascending: 24, of which six are 0 (the rigid motions)
  Eigen::MatrixXd vectors;  // column by column, |v| = 1, corner by corner
};
[[nodiscard]] SpringModes spring_modes(const Eigen::Vector3d& size);
// Largest stable step, from the modes; 0 when there is none, or when no matrix of the integrator's step is known here.
[[nodiscard]] double predicted_step_limit(const BookOptions& options);

// What a frame of a film costs, stage by stage: CPU milliseconds of the process, each the least of several passes over
// the same frames from the film's middle. Conversion: RGB to I420.
struct FrameCost {
  double dynamics, drawing, conversion, encoding;
  int frames;            // drawn and encoded
  std::string renderer;  // the OpenGL that drew
};
struct FrameCostOrder {
  int width, height;
  int most_frames;
  int passes;
  std::filesystem::path assets;   // folder of shaders/ and textures/
  std::filesystem::path scratch;  // folder for the film, which is removed again
};
[[nodiscard]] FrameCost frame_cost(const Scene& scene, const FrameCostOrder& order);

struct Draft {
  const ReportOrder& order;
  Effort effort;
  Tell say;
  Runs runs{};  // of all work-precision ladders
  std::vector<ModelError> model_errors{};
  nlohmann::ordered_json tables{};  // for report.json
  nlohmann::json page{};            // what page.html shows
  std::map<std::vector<std::string>, Trajectory> motions{};
  std::map<std::string, std::string> files{};  // name -> text: all of the report but the page, until it is published

  // Keeps a table under this name: as CSV, in the JSON, and in the page's `tables`.
  void keep(const std::string& name, const Table& table);
  void plot(const std::string& name, const Plot& plot);  // as NAME.svg
  // What `bookspin check videos/SCRIPT.toml --set ... --set 'expect=[...]'` finds; trial: the script and what is set. A
  // motion that several trials share is simulated once.
  struct Judged {
    Clip clip;
    std::vector<Verdict> verdicts;
  };
  [[nodiscard]] Judged judge(const std::vector<std::string>& trial);
};

// Each section computes, keeps its tables and plots, and says its numbers to the page; in this order.
void work_precision(Draft& draft);
void spring_precision(Draft& draft);
void stability(Draft& draft);
void explosion(Draft& draft);
void instability(Draft& draft);
void hard_cases(Draft& draft);
void frame_costs(Draft& draft);
void claims(Draft& draft);

// The plot of error over cost.
[[nodiscard]] Plot work_precision_plot(const Ladders& ladders, const std::string& y_label, double lowest);

}  // namespace bookspin
