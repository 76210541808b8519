// Explicit Euler of the rigid books against exact motion: first order, and the growth rate of the unstable spin.
//
// The literal samples are of the closed form, computed with 30 digits and more.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>

#include "dynamics/rigid_book.h"
#include "dynamics/shape.h"
#include "dynamics/spring_book.h"
#include "tolerance.h"

namespace bookspin {
namespace {

// The book about its intermediate axis, L = (1, 1e-3, 5e-4) in the original's units (half those of unit particles).
BookOptions reference_book() {
  BookOptions o;
  o.particle_mass = 0.5;
  o.omega_W = Eigen::Vector3d(1.0, 0.001, 0.0005).cwiseQuotient(body_of(o).I_B);
  return o;
}

struct Sample {
  int t;
  Eigen::Quaterniond q_WB;
};

const std::array<Sample, 4>& samples() {
  static const std::array<Sample, 4> table{
      {{10,
        {0.839683636677942870625204946530, 0.543073789348356138358639241581, 0.00138705328220844615979021993955,
         0.000570702474194761388922854777902}},
       {20,
        {0.410136983805845973894235007489, 0.912017646607093201270364379474, 0.00254514516704189870561376338939,
         0.00223361321208028446431715676667}},
       {30,
        {-0.150909474726285445154013197198, 0.988528912199793136444399299595, 0.00214922954797033042202406043182,
         0.00568339645638222996212140069242}},
       {40,
        {-0.663534529529499509663925589256, 0.748062143359557072677757541015, -0.00278769946241120701980735191137,
         0.0108252725637046996388779266741}}}};
  return table;
}

// Largest error over the samples, radians, with `per_unit` steps in a unit of time.
template <class Book>
double error_of(Book book, int per_unit, const std::function<Eigen::Quaterniond(const Book&)>& orientation) {
  double worst = 0.0;
  int t = 0;
  for (const Sample& sample : samples()) {
    for (; t < sample.t; ++t) {
      for (int n = 0; n < per_unit; ++n) book.step(1.0 / per_unit);
    }
    worst = std::max(worst, geodesic_angle(orientation(book), sample.q_WB));
  }
  return worst;
}

Eigen::Quaterniond of_matrix(const MatrixBook& book) {
  return Eigen::Quaterniond(book.R_WB());
}
Eigen::Quaterniond of_quaternion(const QuaternionBook& book) {
  return book.q_WB();
}

TEST(Convergence, OfTheMatrixIsOfFirstOrder) {
  const auto error = [](int n) { return error_of<MatrixBook>(MatrixBook(reference_book()), n, of_matrix); };
  const double coarse = error(100);
  const double fine = error(200);
  EXPECT_LE(fine, tolerance(2e-5));                             // measured: 5.8e-06
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, tolerance(0.05));  // measured: 0.014
}

TEST(Convergence, OfTheQuaternionIsOfFirstOrder) {
  const auto error = [](int n) { return error_of<QuaternionBook>(QuaternionBook(reference_book()), n, of_quaternion); };
  const double coarse = error(100);
  const double fine = error(200);
  EXPECT_LE(fine, tolerance(2e-5));                             // measured: 5.7e-06
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, tolerance(0.02));  // measured: 0.00012
}

// The corners of the unnormalized methods converge as well, while they are still close to a rotation.
TEST(Convergence, OfTheUnnormalizedMethodsIsOfFirstOrder) {
  BookOptions o = reference_book();
  o.normalize_every = 0;
  const Corners rest = body_of(o).corners_B;
  const Corners exact = samples()[0].q_WB.toRotationMatrix() * rest;
  const auto error = [&](auto book, int per_unit) {
    for (int n = 0; n < 10 * per_unit; ++n) book.step(1.0 / per_unit);
    return (book.corners_W() - exact).cwiseAbs().maxCoeff();
  };
  const double matrix = error(MatrixBook(o), 200);
  EXPECT_LE(matrix, tolerance(1e-3));                                                // measured: 0.00047
  EXPECT_NEAR(std::log2(error(MatrixBook(o), 100) / matrix), 1.0, tolerance(0.02));  // measured: 9.5e-05
  const double quaternion = error(QuaternionBook(o), 200);
  EXPECT_LE(quaternion, tolerance(1e-3));                                                    // measured: 0.00024
  EXPECT_NEAR(std::log2(error(QuaternionBook(o), 100) / quaternion), 1.0, tolerance(0.02));  // measured: 3.5e-05
}

// sigma = omega sqrt((I2 - I1) (I3 - I2) / (I1 I3)), I1 < I2 < I3: a small part of omega off the intermediate axis is a
// combination of e^(sigma t) and e^(-sigma t), whatever it starts from, so that f(t - d) + f(t + d) = 2 cosh(sigma d)
// f(t).
constexpr double sigma_of_the_original = 0.0686;

double theory(double omega, const Eigen::Vector3d& I) {  // x is the intermediate axis, y the one of least moment
  return omega * std::sqrt((I.x() - I.y()) * (I.z() - I.x()) / (I.y() * I.z()));
}

template <class Book>
double growth_rate(Book book, double h, const std::function<Eigen::Matrix3d(const Book&)>& orientation) {
  const int steps = static_cast<int>(std::lround(20.0 / h));
  std::array<double, 3> L_y{};  // body frame
  for (double& value : L_y) {
    for (int n = 0; n < steps; ++n) book.step(h);
    value = (orientation(book).transpose() * book.angular_momentum_W()).y();
  }
  return std::acosh((L_y[0] + L_y[2]) / (2.0 * L_y[1])) / (steps * h);
}

BookOptions unstable_start(double omega) {
  BookOptions o;
  o.omega_W = omega * Eigen::Vector3d(1.0, 1e-5, 2e-5);
  return o;
}

TEST(IntermediateAxis, GrowthRateIsThatOfTheoryForEveryMethod) {
  const BookOptions o = unstable_start(0.11482);
  const double sigma = theory(0.11482, body_of(o).I_B);
  EXPECT_NEAR(sigma, sigma_of_the_original, 5e-5);  // the printed digits

  const std::function<Eigen::Matrix3d(const MatrixBook&)> matrix = [](const MatrixBook& b) { return b.R_WB(); };
  const std::function<Eigen::Matrix3d(const QuaternionBook&)> quaternion = [](const QuaternionBook& b) {
    return b.q_WB().toRotationMatrix();
  };
  const Corners rest = body_of(o).corners_B;
  const std::function<Eigen::Matrix3d(const SpringBook&)> springs = [&rest](const SpringBook& b) {
    return best_fit_orientation(b.corners_W(), rest).toRotationMatrix();
  };
  // Explicit Euler's own error is of first order in h.
  EXPECT_NEAR(growth_rate<MatrixBook>(MatrixBook(o), 1e-3, matrix) / sigma, 1.0, tolerance(1e-3));  // measured: 1.5e-05
  EXPECT_NEAR(growth_rate<QuaternionBook>(QuaternionBook(o), 1e-3, quaternion) / sigma, 1.0,
              tolerance(1e-3));  // measured: 1.5e-05
  // The springs give way by the centrifugal pull, 1e-4 of a length, and with them the moments.
  EXPECT_NEAR(growth_rate<SpringBook>(SpringBook(o), 1e-3, springs) / sigma, 1.0,
              tolerance(5e-3));  // measured: 0.00075
}

// About the other two axes there is no growth: cosh becomes cos, and the off-axis part stays as small as it was.
TEST(StableAxes, KeepASmallErrorOfAimSmall) {
  for (const int axis : {1, 2}) {
    BookOptions o;
    o.omega_W = 0.1 * (Eigen::Vector3d::Unit(axis) + Eigen::Vector3d(1e-4, 1e-4, 1e-4));
    MatrixBook book(o);
    const double aim = std::asin(book.angular_momentum_W().cross(Eigen::Vector3d::Unit(axis)).norm() /
                                 book.angular_momentum_W().norm());
    double widest = 0.0;
    for (int n = 0; n < 300000; ++n) {
      book.step(1e-3);
      widest = std::max(widest, angle_between(book.R_WB().col(axis), book.angular_momentum_W()));
    }
    EXPECT_LE(widest, tolerance(4.0 * aim)) << axis;  // measured: 0.00042
  }
}

}  // namespace
}  // namespace bookspin
