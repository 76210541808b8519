#include "scene/trajectory_csv.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace bookspin {

std::string trajectory_csv_header() {
  std::string header = "frame,t,book";
  for (int i = 0; i < 8; ++i) header += fmt::format(",c{0}x,c{0}y,c{0}z", i);
  return header + ",qw,qx,qy,qz,Lx,Ly,Lz,kinetic_energy,elastic_energy,stretch,angle_error";
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
    for (const double value : {f.kinetic_energy, f.elastic_energy, f.stretch, f.angle_error}) append(value);
    rows += '\n';
  }
  return rows;
}

}  // namespace bookspin
