// Scene + Trajectory -> what each frame shows: title, camera, books, names and figures, and the notice
// that a book has exploded. Overlays (film/overlays.h) are drawn where the script asks for them.
//
// The camera stands still. It looks from the scene's direction at the middle of the books, from the distance at which
// the whole motion of every book stays in view: the sphere about each book that its farthest corner touches in any
// frame shown. A book that has exploded is held at the frame before.
#pragma once

#include "render/shot.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

class Storyboard {
 public:
  // Both must outlive the storyboard. aspect: width / height of the picture.
  Storyboard(const Scene& scene, const Trajectory& trajectory, double aspect);

  [[nodiscard]] Shot shot(int frame) const;  // frame: 0 ... scene.clip.frames - 1

 private:
  void add_head_up(Shot& shot, int frame, double y) const;  // y: of the first line, frame heights

  const Scene* scene_;
  const Trajectory* trajectory_;
  Camera camera_;
  int last_moving_frame_ = 0;  // when every book has exploded the clock stops
};

}  // namespace bookspin
