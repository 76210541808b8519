// Scene + Trajectory -> what each frame shows: title, camera, books, names and figures, and the notice that a book has
// exploded. Text whose widest line in the film would be cut, or meet that below another book, is set smaller throughout.
//
// The camera stands still and looks from the scene's direction at each book's own center. The books' pictures are put
// where the scene has them, side by side: equal poses look alike. All that moves stays in view: the sphere about each
// book that its farthest corner ever touches; of one that explodes, only as long as it is little larger than at rest.
// That one is dimmed, lest it flash, and drawn until its numbers end or it comes as near as the camera; its ghosts stay.
// When all have gone, the film ends a second later.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/shot.h"
#include "scene/doubts.h"
#include "scene/scene.h"
#include "scene/trajectory.h"

namespace bookspin {

class Storyboard {
 public:
  // Both must outlive the storyboard. width, height: of the picture, pixels.
  Storyboard(const Scene& scene, const Trajectory& trajectory, int width, int height);

  [[nodiscard]] int frames() const;          // of the film: scene.clip.frames, or fewer
  [[nodiscard]] Shot shot(int frame) const;  // frame: 0 ... scene.clip.frames - 1

 private:
  [[nodiscard]] std::vector<Label> text(int frame) const;  // as large as it should be
  void fit_text(int width, int height);

  const Scene* scene_;
  const Trajectory* trajectory_;
  Camera camera_;
  std::vector<Eigen::Vector2d> shifts_;  // of each book's picture, as in a Shot
  std::vector<int> last_frames_;         // in which each book is drawn
  std::vector<Doubt> doubts_;
  std::map<double, double> set_height_;  // of text, by the height that it should have
};

// "book.0.name: '漢', '字'": what the font lacks and is drawn as boxes.
[[nodiscard]] std::vector<std::string> lacking_characters(const Scene& scene);

}  // namespace bookspin
