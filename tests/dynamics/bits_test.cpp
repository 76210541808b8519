// The same bits on every machine, from what needs no more than + - * / and the root, which IEEE 754 rounds for all.
//
// No vector unit, contraction or reordered sum may change one of them. Left out: damping and the normalizations of
// matrix and springs, whose sums Eigen 3.4 and 5 take in different orders.
#include <gtest/gtest.h>

#include "dynamics/rigid_book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/spring_book.h"

namespace bookspin {
namespace {

// A sum, term by term, that no two corners share the weight of.
template <class Book>
double fingerprint(Book book) {
  for (int n = 0; n < 1000; ++n) book.step(0.01);
  const Corners& corners_W = book.corners_W();
  double sum = book.kinetic_energy();
  for (int i = 0; i < 24; ++i) sum += (i + 1) * corners_W.data()[i];
  return sum;
}

BookOptions tumbling(Integrator integrator) {
  return {.size = {1.2, 2.1, 0.4},
          .omega_W = {0.5, 0.2, -0.1},
          .integrator = integrator,
          .normalize_every = 0,
          .damping = 0.0};
}

TEST(Bits, AreTheSameOnEveryMachine) {
  EXPECT_EQ(fingerprint(MatrixBook(tumbling(Integrator::explicit_euler))), -0x1.be14a42855c0ep+3);
  EXPECT_EQ(fingerprint(QuaternionBook(tumbling(Integrator::explicit_euler))), -0x1.ea190fcbe3d11p+3);
  EXPECT_EQ(fingerprint(FreeBook(tumbling(Integrator::rk4))), -0x1.dbb157c3f33fcp+3);
  EXPECT_EQ(fingerprint(FreeBook(tumbling(Integrator::dmv))), -0x1.dbb157c402ep+3);
  EXPECT_EQ(fingerprint(SpringBook(tumbling(Integrator::velocity_verlet))), -0x1.ba810d23ab077p+3);
  EXPECT_EQ(fingerprint(SpringBook(tumbling(Integrator::rk4))), -0x1.ba7510ee1ff93p+3);
  EXPECT_EQ(fingerprint(SpringBook(tumbling(Integrator::rkn6))), -0x1.ba75151e68908p+3);
  EXPECT_EQ(fingerprint(SpringBook(tumbling(Integrator::stoermer10))), -0x1.ba75151e694b3p+3);
}

}  // namespace
}  // namespace bookspin
