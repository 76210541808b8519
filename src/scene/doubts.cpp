#include "scene/doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dynamics/integrators.h"

namespace bookspin {
namespace {

bool compares(Q quantity) {
  return quantity == Q::angle_error || quantity == Q::exact_tilt || quantity == Q::exact_flips;
}

bool is_said(const Scene& scene, std::size_t book) {
  return scene.books[book].show.contains(Overlay::exact) ||
         std::any_of(scene.books.begin(), scene.books.end(),
                     [](const BookSetup& b) { return b.method == Method::exact; }) ||
         std::any_of(scene.view.head_up.begin(), scene.view.head_up.end(), compares) ||
         std::any_of(scene.expectations.begin(), scene.expectations.end(), [&](const Expectation& e) {
           return static_cast<std::size_t>(e.book) == book && compares(e.quantity);
         });
}

std::string why(const BookSetup& book, const Clip& clip, const BookTrack& track, std::size_t frame) {
  if (book.method == Method::springs) return "springs have a motion of their own";
  double fastest = 0.0;
  for (std::size_t n = 0; n <= frame; ++n) fastest = std::max(fastest, track.frames[n].omega_W.norm());
  const double turn = fastest * clip.time_per_frame / clip.substeps;
  if (turn > 1.0) return fmt::format("a step turns it by {:.1f} rad", turn);
  // 2 E I_b / L^2 - 1, which tells one side of the separatrix from the other.
  Eigen::Vector3d I_B = body_of(book.options).I_B;
  std::sort(I_B.begin(), I_B.end());
  const auto side = [&](const BookFrame& f) { return 2.0 * f[Q::kinetic_energy] * I_B(1) / f.L_W.squaredNorm() - 1.0; };
  const double start = side(track.frames.front());
  const double moved = std::abs(side(track.frames[frame]) - start);
  if (std::abs(start) < 1e-14) return "it starts so near to the separatrix that rounding decides when it flips";
  if (moved > 0.5 * std::abs(start)) {
    return fmt::format("it started {:.0e} from the separatrix (2 E I / L^2 - 1) and has moved by {:.0e}",
                       std::abs(start), moved);
  }
  return fmt::format("the error of {} has added up", info_of(book.options.integrator).name);
}

}  // namespace

std::vector<Doubt> doubts_about(const Scene& scene, const Trajectory& trajectory) {
  std::vector<Doubt> doubts;
  for (std::size_t b = 0; b < scene.books.size(); ++b) {
    const BookTrack& track = trajectory.books[b];
    const auto end = track.exploded_frame ? track.frames.begin() + *track.exploded_frame : track.frames.end();
    const auto first =
        std::find_if(track.frames.begin(), end, [](const BookFrame& f) { return f[Q::angle_error] > visible_error; });
    if (first == end || is_said(scene, b)) continue;
    const auto frame = static_cast<std::size_t>(first - track.frames.begin());
    const double largest = (*std::max_element(first, end, [](const BookFrame& f, const BookFrame& g) {
      return f[Q::angle_error] < g[Q::angle_error];
    }))[Q::angle_error];
    doubts.push_back({b, static_cast<int>(frame), largest, why(scene.books[b], scene.clip, track, frame)});
  }
  return doubts;
}

}  // namespace bookspin
