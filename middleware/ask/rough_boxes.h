// middleware/ask/rough_boxes.h: a box around all that a body may reach in a stretch of world time,
// without any pose of it: around the ways of its roots, grown by the lengths of its arms. Metres,
// W. Not installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "middleware/world/world_parts.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Stretches of world time: 2^18 us each, a quarter of a second.
inline constexpr int kStretchShift = 18;
/// The boxes of so many stretches are kept per body: the last two seconds.
inline constexpr std::size_t kStretchesKept = 8;

/// How far a body reaches in any of some poses, and in between.
class PosesReach {
 public:
  void clear();
  void add(const Skeleton& skeleton, const Pose& pose);
  [[nodiscard]] Aabb box(const BodyKind& kind);

 private:
  std::vector<double> squares_;  // of each joint's longest arm
  std::vector<double> reaches_;  // memory: of each joint's origin from its root's
  Aabb roots_;
};

/// The boxes of one body.
class RoughBoxes {
 public:
  /// A box that holds the body at the instant, and in most of the stretch around it; null if
  /// it is carried then, or has no later pose. O(1) where it is kept; else O(joints)
  /// for each pose of the stretch that came since.
  [[nodiscard]] const Aabb* at(const WorldBody& body, const BodyKind& kind, std::int64_t utimeUs);

 private:
  struct Kept {
    std::int64_t stretch = std::numeric_limits<std::int64_t>::min();
    std::int64_t lastEpisodeUs = 0;  ///< The body's: the world has not changed it since.
    std::int64_t episodeUs = 0;
    std::int64_t fromUs = 0, untilUs = 0;  ///< The box holds from here to before there.
    PosesReach reach;
    Aabb box;
  };
  std::array<Kept, kStretchesKept> kept_;
};

}  // namespace foretouch::internal
