// tests/network/simulated_world.h: small random bodies and scenes, for both the product and the
// oracle.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/skeleton.h"
#include "judge/capsule_prover.h"
#include "judge/motion.h"
#include "judge/scene.h"
#include "middleware/scene/scene.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

struct SimulatedBody {
  Avatar avatar;
  std::vector<std::vector<oracle::Capsule>> capsules;  ///< Per link.
};

/// A chain or a tree of two to six joints; some links have two LSS, some none.
[[nodiscard]] SimulatedBody randomBody(Random& random);

struct SimulatedScene {
  Scene scene;
  oracle::Scene oracle;
};

/// Three to twelve triangles around the world's origin.
[[nodiscard]] SimulatedScene randomScene(Random& random);

/// The true motion of a body's joints from pose to pose: smooth, or in leaps.
class TrueMotion {
 public:
  /// `moves`: per joint, whether it turns at all; `drifts`: whether its translation changes.
  TrueMotion(Random& random, const Skeleton& skeleton, std::vector<bool> moves,
             std::vector<bool> drifts);
  /// The next pose, validated.
  [[nodiscard]] Pose next(double seconds);

 private:
  void leap(std::size_t joint);

  Random& random_;
  const Skeleton& skeleton_;
  std::vector<bool> moves_, drifts_;
  double leapChance_;
  Pose pose_;
  struct Joint {
    Eigen::Vector3d axis, velocity;
    double turnRate;
  };
  std::vector<Joint> joints_;
};

/// The oracle's motion between two poses of a body.
[[nodiscard]] oracle::Motion oracleMotion(const Skeleton& skeleton, const Pose& from,
                                          const Pose& to);

}  // namespace foretouch::test
