// A scene: what a script in videos/*.toml says, as plain data with its defaults.
//
// Lengths, times and masses are in the scene's own units; angles that a script reads or writes are in degrees, except
// angle errors, which are in radians. Frame n shows the time n time_per_frame; frame 0 is the start.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/book.h"
#include "scene/quantities.h"

namespace bookspin {

enum class Method { springs, matrix, quaternion, exact };
inline constexpr std::array<std::string_view, 4> method_names{"springs", "matrix", "quaternion",
                                                              "exact"};  // in scripts
[[nodiscard]] constexpr std::string_view name_of(Method method) {
  return method_names[static_cast<std::size_t>(method)];
}

enum class Style { solid, ghost };

struct Clip {
  int frames = 900;             // 1 ... 100000; one frame makes a still picture instead of a film
  int fps = 60;                 // film frames per second, 1 ... 240
  double time_per_frame = 0.1;  // simulated time from one frame to the next, > 0
  int substeps = 6;             // integration steps per frame, 1 ... 1000000; the step is h = time_per_frame / substeps
};

struct ViewSetup {
  Eigen::Vector3d from{0.35, 0.3, 1.0};  // direction from the origin to the camera, world frame, any length > 0
  std::vector<Q> head_up;                // shown with the time while the film runs; none: no time either
};

// What can be drawn with a book, beside the book itself, in this order; how: film/overlays.cpp.
enum class Overlay { axes, angular_velocity, angular_momentum, trace, springs, exact, unrotated, polhode, count };

struct OverlayInfo {
  std::string_view name;  // in scripts
  std::string_view meaning;
};

inline constexpr std::array overlay_table{
    OverlayInfo{"axes", "the body axes, labeled x, y, z"},
    OverlayInfo{"angular_velocity", "an arrow; a line: what it was at the start"},
    OverlayInfo{"angular_momentum", "an arrow; a line: what it was at the start"},
    OverlayInfo{
        "trace",
        "the spin axis (the one that tilt is measured of) as an arrow, and the path of its tip, fading with age"},
    OverlayInfo{"springs", "all 28, colored by their tension"},
    OverlayInfo{"exact", "a ghost: the exact book from the same start"},
    OverlayInfo{"unrotated", "a ghost: the book as it was at the start"},
    OverlayInfo{
        "polhode",
        "the ellipsoid on which the energy keeps the tip of the angular velocity, as the book sees it, with the "
        "curves on which the angular momentum keeps it (red: the separatrix), and the tip's path"},
};
static_assert(overlay_table.size() == static_cast<std::size_t>(Overlay::count));

struct BookSetup {
  std::string name;  // printed under the book and in the data; may be empty
  Method method = Method::springs;
  BookOptions options;                      // omega_W without the jiggle; W as if the book began unturned
  std::optional<Eigen::Quaterniond> q_WB0;  // at the start, |q| = 1: turns the whole motion; none: W = B there
  double jiggle = 0.0;  // length of the seeded vector added to omega_W, in units of |omega_W|, 0 ... 1
  Eigen::Vector3d position_W = Eigen::Vector3d::Zero();  // where its picture is put; it moves about the origin
  Style style = Style::solid;
  std::set<Overlay> show;
};

struct Expectation {
  std::string says;                // what the caption claims, in words
  Q quantity = Q::tilt;            // what is measured
  int book = 0;                    // index of the book
  int first_frame = 0;             // judged from this frame
  std::optional<int> last_frame;   // to this one, included; none: to the end
  std::optional<double> at_least;  // bound for every frame
  std::optional<double> at_most;   // bound for every frame
  std::optional<double> rises_to;  // reached or passed upwards by some frame
  std::optional<double> falls_to;  // reached or passed downwards by some frame
};

// A caption that the script itself gives.
struct Cue {
  std::string says;
  int first_frame = 0;
  int last_frame = 0;  // included
};

struct Scene {
  std::string title;
  std::string caption;
  std::uint64_t seed = 1;  // of the jiggle
  Clip clip;
  ViewSetup view;
  std::vector<BookSetup> books;  // 1 ... 8
  std::vector<Expectation> expectations;
  std::vector<Cue> cues;  // in order, without overlap; none: the page finds them in the motion
};

}  // namespace bookspin
