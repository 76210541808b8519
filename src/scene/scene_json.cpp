#include "scene/scene_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <vector>

#include "dynamics/integrators.h"

namespace bookspin {
namespace {

std::string quoted(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20U) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
      continue;
    }
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string list(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

std::string book_json(const BookSetup& book) {
  const BookOptions& o = book.options;
  std::vector<std::string> show;
  for (const Overlay overlay : book.show) show.push_back(quoted(overlay_table[static_cast<std::size_t>(overlay)].name));
  const Eigen::Quaterniond q = book.q_WB0.value_or(Eigen::Quaterniond::Identity());
  const std::string orientation = book.q_WB0 ? fmt::format("[{}, {}, {}, {}]", q.w(), q.x(), q.y(), q.z()) : "null";
  return fmt::format(
      R"({{"name": {}, "method": {}, "integrator": {}, "size": {}, "moments": {}, "orientation": {}, )"
      R"("angular_velocity": {}, "jiggle": {}, )"
      R"("normalize_every": {}, "damping": {}, "stiffness": {}, "particle_mass": {}, "position": {}, "ghost": {}, )"
      R"("show": [{}]}})",
      quoted(book.name), quoted(name_of(book.method)), quoted(info_of(o.integrator).name), list(o.size),
      list(o.moments), orientation, list(o.omega_W), book.jiggle, o.normalize_every, o.damping, o.stiffness,
      o.particle_mass, list(book.position_W), book.style == Style::ghost, fmt::join(show, ", "));
}

}  // namespace

std::string scene_json(const Scene& scene) {
  std::vector<std::string> books;
  for (const BookSetup& book : scene.books) books.push_back(book_json(book));
  const Clip& clip = scene.clip;
  return fmt::format(
      R"({{"title": {}, "seed": {}, "frames": {}, "fps": {}, "time_per_frame": {}, "substeps": {}, "from": {}, )"
      R"("books": [{}]}})",
      quoted(scene.title), scene.seed, clip.frames, clip.fps, clip.time_per_frame, clip.substeps, list(scene.view.from),
      fmt::join(books, ", "));
}

}  // namespace bookspin
