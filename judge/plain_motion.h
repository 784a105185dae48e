// judge/plain_motion.h: the in-between motion by textbook formulas, in fifty digits: quaternions by
// slerp's sine weights, frames from the roots down. The reference for motion.h, which turns by axis
// and angle, and the tests' yardstick for rounding. Slow on purpose.
#pragma once

#include <vector>

#include "judge/motion.h"
#include "judge/plain_distance.h"
#include "judge/precise.h"
#include "judge/quaternion.h"

namespace foretouch::oracle {

using Precise3 = Vec3<Precise>;
using PreciseQuaternion = Quaternion<Precise>;

struct PreciseFrame {
  PreciseQuaternion rotation;
  Precise3 origin;
  [[nodiscard]] Precise3 at(const Precise3& p_L) const { return origin + rotate(rotation, p_L); }
  /// For any vector type.
  template <typename Other>
  [[nodiscard]] Precise3 at(const Other& p_L) const {
    return at(Precise3(p_L));
  }
};
/// World frames of all joints at t, parents before children.
[[nodiscard]] std::vector<PreciseFrame> preciseFrames(const std::vector<Joint>& joints,
                                                      const Precise& t);

}  // namespace foretouch::oracle
