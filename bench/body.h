// bench/body.h: one avatar with fewer or more links, to measure the cost of links.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"

namespace foretouch::tools {

inline constexpr int kMaxBenchLinks = 1024;

/// How an added joint turns: a swing about a fixed axis of its parent's frame.
struct AddedSwing {
  Eigen::Vector3d axis_P = Eigen::Vector3d::UnitX();
  double amplitude = 0.0;  ///< Radians.
  double phase = 0.0;      ///< Radians.
};

/// An avatar made from another, with the data to pose it.
struct BenchBody {
  Avatar avatar;
  std::vector<JointId> baseJoint;  ///< Per joint the one of the base avatar; kNoParent if added.
  std::vector<AddedSwing> swing;   ///< Per joint; for added ones.
};

/// The avatar with `links` links (1 to kMaxBenchLinks). Fewer: drops the leaf with the least
/// volume, repeatedly (thumbs, fingers, toes, hands, ...). More: five fingers of three joints on
/// each hand, then five toes on each foot, then strands of four joints hanging about the first
/// root, all moving on their own. Finds hands and toes by their names. Error if the rest has no
/// LSS.
[[nodiscard]] Result<BenchBody> bodyWithLinks(const Avatar& base, int links);

/// The body in a pose of the base avatar; added joints as they are at `timeS`.
[[nodiscard]] Pose poseOfBody(const BenchBody& body, const Pose& base, double timeS);

}  // namespace foretouch::tools
