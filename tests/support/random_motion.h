// tests/support/random_motion.h: random chains and poses, for both the product and the fifty-digit
// yardstick, with a share of half turns, tiny turns, flipped signs and far origins.
#pragma once

#include <vector>

#include "articulated/skeleton.h"
#include "judge/plain_motion.h"
#include "tests/support/judged.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

inline double asDouble(const oracle::Precise& x) {
  return static_cast<double>(x);
}

struct RandomMotion {
  Skeleton skeleton;
  Pose from, to;
  std::vector<oracle::Joint> precise;
};

/// A turn by an ordinary angle, or one of the awkward ones. Excludes angles within 1e-9 of a half
/// turn: there rounding of the input chooses the arc, which has its own test.
inline double randomAngle(Random& random) {
  switch (random.below(10)) {
    case 0: return 0.0;
    case 1: return random.magnitude(1e-16, 1e-3);
    case 2: return 3.14159265358979 - random.magnitude(1e-9, 1e-2);
    default: return random.uniform(0.0, 2.5);
  }
}

inline RandomMotion randomMotion(Random& random, int joints) {
  RandomMotion m;
  RawSkeleton raw;
  for (int j = 0; j < joints; ++j) {
    const bool chain = random.chance(0.7);
    const JointId parent = j == 0 ? kNoParent : (chain ? j - 1 : random.below(j));
    const double size = j == 0 && random.chance(0.2) ? 1e4 : random.magnitude(1e-2, 0.6);
    raw.joints.push_back(
        {"joint" + std::to_string(j), parent, size * random.direction(), random.rotation()});
    const Quaternion start = random.rotation();
    Quaternion end = start * random.turn(randomAngle(random));
    if (random.chance(0.3)) end.coeffs() = -end.coeffs();
    m.from.rotations.push_back(start);
    m.to.rotations.push_back(end);
    m.from.translations.push_back(raw.joints.back().offset);
    const bool drifts = j == 0 || random.chance(0.3);
    const Eigen::Vector3d away = random.direction();
    const double drift = drifts ? random.magnitude(1e-6, 0.5) : 0.0;
    m.to.translations.push_back(raw.joints.back().offset + drift * away);
  }
  m.skeleton = Skeleton::build(raw).value();
  m.precise = plainJoints(m.skeleton, m.from, m.to);
  return m;
}

}  // namespace foretouch::test
