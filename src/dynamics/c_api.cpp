#include "dynamics/c_api.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>

#include "dynamics/book.h"
#include "dynamics/rigid_motion.h"
#include "dynamics/torque_free.h"

struct bookspin_motion {
  Eigen::Vector3d I_B;
  bookspin::TorqueFree motion;
};

namespace {

thread_local std::string last_error;

// No exception may reach C.
template <class Action>
int guarded(const Action& action) noexcept {
  try {
    try {
      action();
      return bookspin_ok;
    } catch (const std::invalid_argument& error) {
      last_error = error.what();
      return bookspin_invalid_argument;
    }
  } catch (const std::bad_alloc&) {
    return bookspin_out_of_memory;
  }
}

void require(bool given, const char* what) {
  if (!given) throw std::invalid_argument(what);
}

}  // namespace

extern "C" {

int bookspin_create(const double I_B[3], const double q_WB[4], const double L_W[3], bookspin_motion** motion) {
  return guarded([=] {
    require(I_B && q_WB && L_W && motion, "bookspin_create: a pointer is NULL");
    const Eigen::Vector3d moments(I_B);
    const Eigen::Quaterniond start(q_WB[0], q_WB[1], q_WB[2], q_WB[3]);
    *motion = new bookspin_motion{moments, bookspin::TorqueFree(moments, start, Eigen::Vector3d(L_W))};
  });
}

int bookspin_create_book(const double size[3], const double omega_W[3], bookspin_motion** motion) {
  return guarded([=] {
    require(size && omega_W && motion, "bookspin_create_book: a pointer is NULL");
    require(std::all_of(size, size + 3, [](double edge) { return edge > 0 && std::isfinite(edge); }),
            "bookspin_create_book: an edge is not positive and finite");
    bookspin::BookOptions options;
    options.size = Eigen::Vector3d(size);
    options.omega_W = Eigen::Vector3d(omega_W);
    *motion = new bookspin_motion{bookspin::body_of(options).I_B, bookspin::exact_motion(options)};
  });
}

int bookspin_at(const bookspin_motion* motion, size_t count, const double* t, double* q_WB, double* L_B,
                double* omega_B) {
  return guarded([=] {
    require(motion && (t || count == 0), "bookspin_at: a pointer is NULL");
    require(std::all_of(t, t + count, [](double time) { return std::isfinite(time); }),
            "bookspin_at: a time is not finite");
    std::array<bookspin::RigidState, 64> states;
    for (size_t i = 0; i < count; ++i) {
      if (i % states.size() == 0) motion->motion.at(std::min(count - i, states.size()), t + i, states.data());
      const auto& [q, L] = states[i % states.size()];
      if (q_WB) Eigen::Map<Eigen::Vector4d>(q_WB + 4 * i) = Eigen::Vector4d(q.w(), q.x(), q.y(), q.z());
      if (L_B) Eigen::Map<Eigen::Vector3d>(L_B + 3 * i) = L;
      if (omega_B) Eigen::Map<Eigen::Vector3d>(omega_B + 3 * i) = L.cwiseQuotient(motion->I_B);
    }
  });
}

void bookspin_destroy(bookspin_motion* motion) {
  delete motion;
}

const char* bookspin_error(void) {
  return last_error.c_str();
}

}  // extern "C"
