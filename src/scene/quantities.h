// The measured quantities: one table for all that a script can name, a film's data and a trajectory's table hold, and a
// chart draws. A new one is a word in Q, a row here, and a line in Recorder (scene/simulate.cpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace bookspin {

enum class Q {
  tilt,
  flips,
  stretch,
  kinetic_energy,
  elastic_energy,
  energy_ratio,
  angular_momentum_ratio,
  norm,
  largest_singular_value,
  orthogonality_defect,
  blend_defect,
  pulsations,
  angle_error,
  exact_tilt,
  exact_flips,
  extent,
  floor_hits,
  exploded,
  omega_Bx,
  omega_By,
  omega_Bz,
  L_Bx,
  L_By,
  L_Bz,
  count
};

// What a chart's axis holds whatever the data, as shown, so that a quantity that stays put is seen to.
struct ChartAxis {
  double low;
  double high;
  double most = 0.0;  // what cannot be exceeded, 0: nothing. From its half on the axis shows it all
};

struct Quantity {
  Q id;
  std::string_view name;     // as written in a script
  std::string_view unit;     // empty: a pure number
  std::string_view meaning;  // one line
  std::string_view symbol;   // short, as printed in a picture
  std::string_view format;   // of a value in a picture, as fmt reads it
  std::string_view title;    // of a chart
  std::string_view shown_unit;
  double shown_scale;  // value in a chart / value
  ChartAxis axis;
  bool count = false;  // stays what it was where numbers end; all others become NaN
};

// clang-format off
inline constexpr std::array quantities{
    Quantity{Q::tilt, "tilt", "degrees", "angle between the book's spin axis and where it was at the start",
             "tilt", "{:.1f}°", "Tilt of the spin axis", "°", 1.0, {0.0, 5.0, 180.0}},
    Quantity{Q::flips, "flips", "", "flips so far: the tilt went from below 30 to above 150 degrees, or back",
             "flips", "{:.0f}", "Flips so far", "", 1.0, {0.0, 1.0}, true},
    Quantity{Q::stretch, "stretch", "", "largest relative change of a distance between two corners",
             "stretch", "{:.4f}", "Stretch", "%", 100.0, {0.0, 1.0}},
    Quantity{Q::kinetic_energy, "kinetic_energy", "", "energy of motion",
             "kinetic", "{:.4f}", "Kinetic energy", "", 1.0, {0.0, 0.0}},
    Quantity{Q::elastic_energy, "elastic_energy", "", "energy in the springs",
             "elastic", "{:.4f}", "Elastic energy", "", 1.0, {0.0, 0.0}},
    Quantity{Q::energy_ratio, "energy_ratio", "", "total energy, relative to the start",
             "E/E₀", "{:.3f}", "Energy E/E₀", "", 1.0, {0.95, 1.05}},
    Quantity{Q::angular_momentum_ratio, "angular_momentum_ratio", "", "length of the angular momentum, relative to the start",
             "|L|/L₀", "{:.3f}", "Angular momentum |L|/|L₀|", "", 1.0, {0.95, 1.05}},
    Quantity{Q::norm, "norm", "", "|q| of the quaternion",
             "|q|", "{:.4f}", "Norm |q| of the quaternion", "", 1.0, {0.98, 1.02}},
    Quantity{Q::largest_singular_value, "largest_singular_value", "", "how much the book has grown where it has grown most",
             "growth", "{:.3f}", "Size, where the book has grown most", "", 1.0, {0.95, 1.05}},
    Quantity{Q::orthogonality_defect, "orthogonality_defect", "", "largest entry of |F^T F - 1|, F the deformation",
             "|FᵗF − 1|", "{:.1e}", "Deformation |FᵀF − 1|", "", 1.0, {0.0, 0.01}},
    Quantity{Q::blend_defect, "blend_defect", "", "largest entry of |F - ((1 - s^2) 1 + s^2 R)|, s = |q|",
             "blend defect", "{:.1e}", "Distance from a blend with the unrotated book", "", 1.0, {0.0, 0.01}},
    Quantity{Q::pulsations, "pulsations", "", "swellings by 10 % or more so far, each with its shrinking",
             "pulsations", "{:.0f}", "Pulsations so far", "", 1.0, {0.0, 1.0}, true},
    Quantity{Q::angle_error, "angle_error", "radians", "angle to the exact rigid motion from the same start",
             "error", "{:.3f} rad", "Error of the orientation", "rad", 1.0, {0.0, 0.1, 3.14}},
    Quantity{Q::exact_tilt, "exact_tilt", "degrees", "tilt of the exact book from the same start",
             "exact book's tilt", "{:.1f}°", "Tilt of the exact book", "°", 1.0, {0.0, 5.0, 180.0}},
    Quantity{Q::exact_flips, "exact_flips", "", "flips so far of the exact book from the same start",
             "exact book's flips", "{:.0f}", "Flips of the exact book so far", "", 1.0, {0.0, 1.0}, true},
    Quantity{Q::extent, "extent", "", "farthest corner, relative to rest",
             "extent", "{:.3f}", "Farthest corner, relative to rest", "", 1.0, {0.95, 1.05}},
    Quantity{Q::floor_hits, "floor_hits", "", "how often the normalization's floor of 0.1 E0 has bitten so far",
             "floor hits", "{:.0f}", "Hits of the floor of 0.1 E₀ so far", "", 1.0, {0.0, 1.0}, true},
    Quantity{Q::exploded, "exploded", "", "1 once the book has exploded, 0 before",
             "exploded", "{:.0f}", "Exploded", "", 1.0, {0.0, 1.0}, true},
    Quantity{Q::omega_Bx, "omega_Bx", "radians per unit of time", "angular velocity about the book's own x",
             "ωx", "{:.4f}", "Angular velocity about the book's x", "", 1.0, {0.0, 0.0}},
    Quantity{Q::omega_By, "omega_By", "radians per unit of time", "angular velocity about the book's own y",
             "ωy", "{:.4f}", "Angular velocity about the book's y", "", 1.0, {0.0, 0.0}},
    Quantity{Q::omega_Bz, "omega_Bz", "radians per unit of time", "angular velocity about the book's own z",
             "ωz", "{:.4f}", "Angular velocity about the book's z", "", 1.0, {0.0, 0.0}},
    Quantity{Q::L_Bx, "L_Bx", "", "angular momentum about the book's own x",
             "Lx", "{:.4f}", "Angular momentum about the book's x", "", 1.0, {0.0, 0.0}},
    Quantity{Q::L_By, "L_By", "", "angular momentum about the book's own y",
             "Ly", "{:.4f}", "Angular momentum about the book's y", "", 1.0, {0.0, 0.0}},
    Quantity{Q::L_Bz, "L_Bz", "", "angular momentum about the book's own z",
             "Lz", "{:.4f}", "Angular momentum about the book's z", "", 1.0, {0.0, 0.0}},
};
// clang-format on

inline constexpr auto quantity_count = static_cast<std::size_t>(Q::count);

static_assert(quantities.size() == quantity_count);
static_assert(std::all_of(quantities.begin(), quantities.end(),
                          [](const Quantity& row) { return row.id == static_cast<Q>(&row - quantities.data()); }));

[[nodiscard]] constexpr const Quantity& quantity(Q id) {
  return quantities[static_cast<std::size_t>(id)];
}

}  // namespace bookspin
