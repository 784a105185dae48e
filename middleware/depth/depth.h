// middleware/depth/depth.h: how deep one rigid set of LSS is in another or in triangles, a body of
// a world in another or in what stands still, and which way out, or an avatar's own links in each
// other where their surfaces are triangles: bounds from below and from above, and a translation
// that is proven to clear. What each proves: depth.md 4 and 7; the promise: docs/guarantees.md 18.
// Metres, in W; world time in microseconds.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"
#include "middleware/surface/avatar_surface.h"
#include "middleware/world/world.h"
#include "middleware/world/world_contacts.h"

namespace foretouch {

/// The depth is the infimum of the lengths of all translations of what is moved that leave it
/// without a point in common with the rest; for triangles, with their surface.
struct Depth {
  /// No translation shorter than this one clears: the largest depth of a pair.
  double lower = 0.0;
  /// Moved by `wayOut`, it is proven clear of everything; |wayOut| <= upper. Infinite if nothing
  /// that was tried could be certified; then the way is zero.
  double upper = std::numeric_limits<double>::infinity();
  Eigen::Vector3d wayOut = Eigen::Vector3d::Zero();
  bool isCertified = false;   ///< `upper` and `wayOut` mean something.
  std::int32_t numPairs = 0;  ///< Pairs of pieces that have, or may have, a point in common.
  /// Those of the deepest pair; -1 if there is none: which LSS of those that are moved, and which
  /// LSS or triangle of the others.
  std::int32_t deepestMoved = -1, deepestOther = -1;
};

/// At most so many pairs of pieces are looked at in the search for a way out (each look costs some
/// hundred nanoseconds); after these, the best way so far is the answer.
inline constexpr std::int64_t kMostDepthLooks = 200'000;

/// `moved` as one against `others`, both where they are. `rounding`: no point of either is farther
/// from where it is given (m, >= 0). Coordinates finite, below 1e100; |coordinate| <= 1e7 for a
/// scene. The same answer for the same input. O(pairs that are near, times the looks it takes).
[[nodiscard]] Depth depthAmong(const std::vector<Lss>& moved, const std::vector<Lss>& others,
                               Scratch& scratch, double rounding = 0.0);
[[nodiscard]] Depth depthIn(const std::vector<Lss>& moved, const Scene& scene, Scratch& scratch,
                            double rounding = 0.0);

/// What is moved, and out of what: whole bodies, or a link of each.
struct DepthQuestion {
  BodyId a = 0;
  LinkId linkOfA = kEveryLink;
  BodyId b = kStillScene;
  LinkId linkOfB = kEveryLink;
};

struct WorldDepth {
  Depth depth;  ///< a's, which `depth.wayOut` moves, in W; the bounds hold where they truly are.
  /// The deepest pair, without witness points; if there is none, the bodies that were asked.
  ContactSide a, b;
  bool isAssumed = false;  ///< As WorldContact::isAssumed.
};

/// The depth of two links is the infimum of the lengths of all translations of the one that leave
/// it without a point in common with the other: with its surface, and with what that encloses.
struct LinkDepth {
  /// No translation shorter than this one parts them. 0: nothing is proven, as for links whose
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

  /// The depth of two links with a surface, at `t` in [0,1] of a motion of the avatar. For two
  /// convex ones the bounds are within 1e-6 m, or the share of their size by which they are not
  /// convex; others are bounded from below by the balls that both have room for: such a place is
  /// found sooner with a point where they meet, as contacts have it, in W; null: none is known.
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
