// A scene as JSON: what moves and how it is seen, every number to its last digit and with the defaults filled in.
//
//   title, seed, from       of the scene and its view
//   frames, fps, time_per_frame, substeps   of the clip
//   books                   keys as in scripts, but normalize_every 0 where nothing is normalized, damping a number, and
//                           ghost for the style; moments of particles of mass 1, [0, 0, 0]: those of size;
//                           orientation null: none, else angular_velocity as if the book began unturned
#pragma once

#include <string>

#include "scene/scene.h"

namespace bookspin {

[[nodiscard]] std::string scene_json(const Scene& scene);  // one line

}  // namespace bookspin
