#include "scene/trajectory_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace bookspin {
namespace {

constexpr std::array before_omega{Q::kinetic_energy, Q::elastic_energy, Q::stretch, Q::angle_error};

bool after_omega(const Quantity& q) {
  return std::find(before_omega.begin(), before_omega.end(), q.id) == before_omega.end();
}

}  // namespace

std::string trajectory_csv_header() {
  std::string header = "frame,t,book";
  for (int i = 0; i < 8; ++i) header += fmt::format(",c{0}x,c{0}y,c{0}z", i);
  header += ",qw,qx,qy,qz,Lx,Ly,Lz";
  for (const Q q : before_omega) header.append(",").append(quantity(q).name);
  header += ",omega_x,omega_y,omega_z";
  for (const Quantity& q : quantities) {
    if (after_omega(q)) header.append(",").append(q.name);
  }
  return header;
}

std::string trajectory_csv_rows(const Scene& scene, const Trajectory& trajectory, int frame) {
  std::string rows;
  const auto append = [&rows](double value) {
    if (std::isnan(value)) {
      rows += ",nan";  // whatever its sign bit
    } else {
      fmt::format_to(std::back_inserter(rows), ",{:.17g}", value);
    }
  };
  for (std::size_t b = 0; b < trajectory.books.size(); ++b) {
    const BookFrame& f = trajectory.books[b].frames[static_cast<std::size_t>(frame)];
    fmt::format_to(std::back_inserter(rows), "{}", frame);
    append(frame * scene.clip.time_per_frame);
    fmt::format_to(std::back_inserter(rows), ",{}", b);
    for (const double value : f.corners_W.reshaped()) append(value);  // column by column: corner by corner
    for (const double value : {f.q_WB.w(), f.q_WB.x(), f.q_WB.y(), f.q_WB.z()}) append(value);
    for (const double value : f.L_W) append(value);
    for (const Q q : before_omega) append(f[q]);
    for (const double value : f.omega_W) append(value);
    for (const Quantity& q : quantities) {
      if (after_omega(q)) append(f[q.id]);
    }
    rows += '\n';
  }
  return rows;
}

}  // namespace bookspin
