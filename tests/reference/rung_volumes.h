// tests/reference/rung_volumes.h: one step's volumes at the rungs above the links: one LSS per
// limb, in the frame of the limb's first link, and one per tree, in the root's frame. Each contains
// the volumes of the rung below at every t in [0,1]. Proof: tests/reference/rungs.md. Metres.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "tests/reference/limbs.h"
#include "tests/reference/relative_points.h"

namespace foretouch::internal {

/// A ball fixed in a link, on its way through a carrier's frame.
struct CarriedBall {
  RelativePoint path;  ///< Its centre at the nodes.
  double radius;
  /// The centre is at most stray + perLength * (its distance from the carrier's origin) from the
  /// chords of its path, rounding included.
  double stray, perLength;
};

/// Volumes of one step after another; keeps its memory. For one thread.
class RungVolumes {
 public:
  /// Computes the limbs' volumes and, if `withTrees`, the trees'. `nodes` are of `motion` over
  /// [0,1]. O(LSS).
  void evaluate(const Avatar& avatar, const ChainMotion& motion, const ChainNodes& nodes,
                bool withTrees);

  [[nodiscard]] const Limbs& limbs() const { return limbs_; }
  /// By the limb's number; meaningless for a limb without links.
  [[nodiscard]] const Lss& limb(std::size_t limb) const { return limbVolumes_[limb]; }
  [[nodiscard]] const Lss& tree(std::size_t tree) const { return treeVolumes_[tree]; }

 private:
  /// Bounds on a link's motion in its carrier's frame, like ChainSums' in the world.
  struct RelativeSums {
    double angularSpeed = 0.0, angularAcceleration = 0.0, acceleration = 0.0;
    [[nodiscard]] RelativeSums with(const ChainMotion::JointBounds& joint) const;
    [[nodiscard]] double accelerationAt(double rho) const {
      return ChainSums::kChainInflation *
             (acceleration + (angularAcceleration + angularSpeed * angularSpeed) * rho);
    }
  };

  void boundRelativeMotion(const ChainMotion& motion, bool withTrees);
  void addBall(const ChainNodes& nodes, LinkId carrier, const AxisPoint& point,
               const RelativeSums& sums);
  [[nodiscard]] Lss volumeOf(const Avatar& avatar, const ChainNodes& nodes, const Limb& limb);
  [[nodiscard]] Lss volumeOf(const ChainNodes& nodes, const LimbTree& tree);

  std::uint64_t avatar_ = 0;  // whose limbs these are
  Limbs limbs_;
  std::vector<RelativeSums> toLimb_, toRoot_;  // per link
  double chord_ = 0.0;                         // an eighth of the widest gap between nodes, squared
  std::vector<CarriedBall> balls_;             // of the current volume
  std::vector<Lss> limbVolumes_, treeVolumes_;
};

/// The axis of an LSS around the balls at `node`, not shorter than needed and not much longer; a
/// proposal, without a radius.
[[nodiscard]] Lss axisAround(const std::vector<CarriedBall>& balls, int node);

}  // namespace foretouch::internal
