// tests/middleware/reference/random_step.h: bodies and steps for the rungs above the links: random
// trees with bare links and several roots, near half turns, drifting joints, far places.
#pragma once

#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "judge/plain_motion.h"
#include "tests/reference/rungs.h"
#include "tests/support/random_geometry.h"
#include "tests/support/random_motion.h"

namespace foretouch::test {

struct RandomStep {
  Avatar avatar;
  Pose from, to;
  [[nodiscard]] ChainMotion motion() const { return ChainMotion(avatar.skeleton(), from, to); }
  [[nodiscard]] std::vector<oracle::Joint> precise() const {
    return plainJoints(avatar.skeleton(), from, to);
  }
};

/// `calm`: turns and drifts of an ordinary step, near `center`; else anything goes.
inline RandomStep randomStep(Random& random, int links, bool calm, const Eigen::Vector3d& center) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int j = 0; j < links; ++j) {
    const bool isRoot = j == 0 || random.chance(0.05);
    const JointId parent = isRoot ? kNoParent : (random.chance(0.7) ? j - 1 : random.below(j));
    const Eigen::Vector3d offset =
        isRoot ? Eigen::Vector3d(center + random.inBox(0.5))
               : Eigen::Vector3d(random.uniform(0.0, 0.4) * random.direction());
    raw.joints.push_back({"link" + std::to_string(j), parent, offset, random.rotation()});
    lss.emplace_back();
    const int count = j > 0 && random.chance(0.15) ? 0 : 1 + random.below(2);
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector3d a = random.inBox(0.15);
      lss.back().push_back({a, random.chance(0.1) ? a : random.inBox(0.15),
                            random.chance(0.1) ? 0.0 : random.magnitude(1e-3, 0.1)});
    }
  }
  RandomStep step{Avatar::build(Skeleton::build(raw).value(), lss).value(), {}, {}};
  step.from = step.to = restPose(step.avatar.skeleton());
  if (random.chance(0.1)) return step;  // nothing moves
  for (std::size_t j = 0; j < step.to.rotations.size(); ++j) {
    const double angle = calm ? random.uniform(0.0, 0.6) : randomAngle(random);
    step.to.rotations[j] = step.from.rotations[j] * random.turn(angle);
    if (!calm && random.chance(0.3)) step.to.translations[j] += random.inBox(0.3);
  }
  step.to.translations[0] += random.inBox(0.4);
  return step;
}

/// Instants to look at: random ones, and both ends.
inline std::vector<double> instants(Random& random, int count) {
  std::vector<double> times{0.0, 1.0};
  for (int i = 0; i < count; ++i) times.push_back(random.uniform(0.0, 1.0));
  return times;
}

}  // namespace foretouch::test
