#include "scene/scene_json.h"

#include <nlohmann/json.hpp>

#include "dynamics/integrators.h"

namespace bookspin {
namespace {

using Json = nlohmann::ordered_json;

Json list(const Eigen::Vector3d& v) {
  return {v.x(), v.y(), v.z()};
}

Json book_json(const BookSetup& book) {
  const BookOptions& o = book.options;
  Json show = Json::array();
  for (const Overlay overlay : book.show) show.push_back(overlay_table[static_cast<std::size_t>(overlay)].name);
  Json orientation;
  if (const auto& q = book.q_WB0) orientation = {q->w(), q->x(), q->y(), q->z()};
  return {{"name", book.name},
          {"method", name_of(book.method)},
          {"integrator", info_of(o.integrator).name},
          {"size", list(o.size)},
          {"moments", list(o.moments)},
          {"orientation", orientation},
          {"angular_velocity", list(o.omega_W)},
          {"jiggle", book.jiggle},
          {"normalize_every", o.normalize_every},
          {"damping", o.damping},
          {"stiffness", o.stiffness},
          {"particle_mass", o.particle_mass},
          {"position", list(book.position_W)},
          {"ghost", book.style == Style::ghost},
          {"show", show}};
}

}  // namespace

std::string scene_json(const Scene& scene) {
  Json json{{"title", scene.title},
            {"seed", scene.seed},
            {"frames", scene.clip.frames},
            {"fps", scene.clip.fps},
            {"time_per_frame", scene.clip.time_per_frame},
            {"substeps", scene.clip.substeps},
            {"from", list(scene.view.from)},
            {"books", Json::array()}};
  for (const BookSetup& book : scene.books) json["books"].push_back(book_json(book));
  return json.dump();
}

}  // namespace bookspin
