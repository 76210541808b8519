// What a frame of a film costs, stage by stage: CPU time, milliseconds.
//
// CPU time of the process, not wall time: what other programs do on the machine shows in the second and hardly in the
// first. Each stage is the least of several passes over the same frames from the film's middle. Conversion: RGB to
// I420.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace bookspin {

struct FrameCost {
  double dynamics = 0.0;
  double drawing = 0.0;
  double conversion = 0.0;
  double encoding = 0.0;
  int frames = 0;        // drawn and encoded
  std::string renderer;  // the OpenGL that drew
};

struct FrameCostOrder {
  int width = 1280;
  int height = 720;
  int most_frames = 480;
  int passes = 3;
  std::filesystem::path assets;   // folder of shaders/ and textures/
  std::filesystem::path scratch;  // folder for the film, which is removed again
};

[[nodiscard]] FrameCost frame_cost(const Scene& scene, const FrameCostOrder& order);

}  // namespace bookspin
