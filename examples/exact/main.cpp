// exact T...: the orientation w x y z of a tumbling book at each time T, in closed form.

#include <bookspin/dynamics/rigid_motion.h>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv) {
  bookspin::BookOptions book;
  book.size = {1.878, 2.9085, 0.5};
  book.omega_W = {0.11482, 1e-4, -2e-4};  // about the middle axis, nearly
  const bookspin::TorqueFree motion = bookspin::exact_motion(book);
  for (int i = 1; i < argc; ++i) {
    const Eigen::Quaterniond q_WB = motion.at(std::strtod(argv[i], nullptr)).q_WB;
    std::printf("%.17g %.17g %.17g %.17g\n", q_WB.w(), q_WB.x(), q_WB.y(), q_WB.z());
  }
}
