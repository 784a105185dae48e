// middleware/depth/link_depths.h: how deep an avatar's own links are in each other where their
// surfaces are triangles: bounds from below and from above. Proof: depth.md 7; the promise:
// docs/guarantees.md 18. Metres, in W.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/surface/avatar_surface.h"

namespace foretouch {

/// The depth of two links is the infimum of the lengths of all translations of the one that leave
/// it without a point in common with the other: with its surface, and with what that encloses.
struct LinkDepth {
  /// No translation shorter than this one parts them. 0: nothing is proven, as of links whose
  /// surfaces enclose nothing, or that are only just in each other.
  double lower = 0.0;
  /// One along nhat_BA_W that is this long parts even their convex hulls.
  double upper = std::numeric_limits<double>::infinity();
  Eigen::Vector3d nhat_BA_W = Eigen::Vector3d::Zero();  ///< Not longer than 1.
};

/// Immutable; safe to ask from many threads. What a link has inside is found by the first question
/// about it: O(its triangles times its corners) where it is convex.
class LinkDepths {
 public:
  LinkDepths(const Avatar& avatar, const AvatarSurface& surface);
  ~LinkDepths();
  LinkDepths(LinkDepths&&) noexcept;
  LinkDepths& operator=(LinkDepths&&) noexcept;

  /// Of two links with a surface, at `t` in [0,1] of a motion of the avatar. Of two convex ones the
  /// bounds are within 1e-6 m, or the share of their size by which they are not convex; others are
  /// bounded from below by the balls that both have room for: such a place is found sooner with a
  /// point where they meet, as contacts have it, in W; null: none is known.
  [[nodiscard]] LinkDepth at(const ChainMotion& motion, double t, LinkId a, LinkId b,
                             const Eigen::Vector3d* met_W = nullptr) const;
  /// Whether some closed surface is part of the link, or an LSS that is its own surface.
  [[nodiscard]] bool hasInside(LinkId link) const;

 private:
  class Solid;
  [[nodiscard]] const Solid& solid(LinkId link) const;

  std::vector<std::unique_ptr<Solid>> solids_;
};

}  // namespace foretouch
