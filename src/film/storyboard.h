// Scene + Trajectory -> what each frame shows: title, camera, books, names and figures, and the notice
// that a book has exploded. Overlays (film/overlays.h) are drawn where the script asks for them. Text whose widest line
// in the film would be cut, or meet that below another book, is set smaller throughout.
//
// The camera stands still. It looks from the scene's direction at the middle of the books, from the distance at which
// the whole motion of every book stays in view: the sphere about each book that its farthest corner touches in any
// frame shown. A book that has exploded is held at the frame before.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/shot.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

class Storyboard {
 public:
  // Both must outlive the storyboard. width, height: of the picture, pixels.
  Storyboard(const Scene& scene, const Trajectory& trajectory, int width, int height);

  [[nodiscard]] Shot shot(int frame) const;  // frame: 0 ... scene.clip.frames - 1

 private:
  [[nodiscard]] std::vector<Label> text(int frame) const;  // as large as it should be
  void fit_text(int width, int height);

  const Scene* scene_;
  const Trajectory* trajectory_;
  Camera camera_;
  int last_moving_frame_ = 0;            // when every book has exploded the clock stops
  std::map<double, double> set_height_;  // of text, by the height that it should have
};

// "book.0.name: '漢', '字'": what the font lacks and is drawn as boxes.
[[nodiscard]] std::vector<std::string> lacking_characters(const Scene& scene);

}  // namespace bookspin
