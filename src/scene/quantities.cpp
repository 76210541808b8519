#include "scene/quantities.h"

#include <algorithm>
#include <array>

namespace bookspin {
namespace {

constexpr std::array table{
    Quantity{"tilt", "degrees", "angle between the book's spin axis and where it was at the start", "tilt", "{:.1f}°",
             [](const BookFrame& f) { return f.tilt; }},
    Quantity{"flips", "", "flips so far: the tilt went from below 10 to above 170 degrees, or back", "flips", "{:.0f}",
             [](const BookFrame& f) { return static_cast<double>(f.flips); }},
    Quantity{"stretch", "", "largest relative change of a distance between two corners", "stretch", "{:.4f}",
             [](const BookFrame& f) { return f.stretch; }},
    Quantity{"kinetic_energy", "", "energy of motion", "kinetic", "{:.4f}",
             [](const BookFrame& f) { return f.kinetic_energy; }},
    Quantity{"elastic_energy", "", "energy in the springs", "elastic", "{:.4f}",
             [](const BookFrame& f) { return f.elastic_energy; }},
    Quantity{"energy_ratio", "", "total energy, relative to the start", "E/E₀", "{:.3f}",
             [](const BookFrame& f) { return f.energy_ratio; }},
    Quantity{"angular_momentum_ratio", "", "length of the angular momentum, relative to the start", "|L|/L₀", "{:.3f}",
             [](const BookFrame& f) { return f.angular_momentum_ratio; }},
    Quantity{"norm", "", "|q| of the quaternion", "|q|", "{:.4f}", [](const BookFrame& f) { return f.norm; }},
    Quantity{"largest_singular_value", "", "how much the book has grown where it has grown most", "growth", "{:.3f}",
             [](const BookFrame& f) { return f.largest_singular_value; }},
    Quantity{"orthogonality_defect", "", "largest entry of |F^T F - 1|, F the deformation", "|FᵀF − 1|", "{:.1e}",
             [](const BookFrame& f) { return f.orthogonality_defect; }},
    Quantity{"blend_defect", "", "largest entry of |F - ((1 - s^2) 1 + s^2 R)|, s = |q|", "blend defect", "{:.1e}",
             [](const BookFrame& f) { return f.blend_defect; }},
    Quantity{"pulsations", "", "swellings by 10 % or more so far, each with its shrinking", "pulsations", "{:.0f}",
             [](const BookFrame& f) { return static_cast<double>(f.pulsations); }},
    Quantity{"angle_error", "radians", "angle to the exact rigid motion from the same start", "error", "{:.3f} rad",
             [](const BookFrame& f) { return f.angle_error; }},
    Quantity{"extent", "", "farthest corner, relative to rest", "extent", "{:.3f}",
             [](const BookFrame& f) { return f.extent; }},
    Quantity{"floor_hits", "", "how often the normalization's floor of 0.1 E0 has bitten so far", "floor hits",
             "{:.0f}", [](const BookFrame& f) { return static_cast<double>(f.floor_hits); }},
    Quantity{"exploded", "", "1 once the book has exploded, 0 before", "exploded", "{:.0f}",
             [](const BookFrame& f) { return f.exploded ? 1.0 : 0.0; }},
};

}  // namespace

std::span<const Quantity> quantities() {
  return table;
}

const Quantity* find_quantity(std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const Quantity& q) { return q.name == name; });
  return found == table.end() ? nullptr : &*found;
}

}  // namespace bookspin
