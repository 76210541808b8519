// What changes while a free rigid body moves: its orientation, and its angular momentum as the body sees it.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace bookspin {

struct RigidState {
  Eigen::Quaterniond q_WB;
  Eigen::Vector3d L_B;  // angular momentum, body frame
};

}  // namespace bookspin
