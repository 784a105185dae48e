// tools/world/body_stretches.h: where the bodies of a world are over all of its time, kept for what
// shows them: pose after pose between two changes of a body's carrier.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "articulated/skeleton.h"
#include "articulated/track.h"
#include "middleware/world/world.h"

namespace foretouch::tools {

/// A body between two changes of its carrier. Its poses are in the frame of the carrier's link, or
/// in W; what is held fast has one.
struct BodyStretch {
  std::int64_t beginUs = 0;
  std::optional<Carrier> carrier;
  Track track;

  [[nodiscard]] bool isHeldFast() const { return carrier && !carrier->movesInFrame; }
};

/// The stretches of one body, by time.
using BodyStretches = std::vector<BodyStretch>;

/// The pose of a track at an instant from its first one on; after its last one it stays.
[[nodiscard]] Pose poseOn(const Track& track, std::int64_t utimeUs);

/// The stretch of an instant; null before the first one. O(log stretches).
[[nodiscard]] const BodyStretch* stretchAt(const BodyStretches& stretches, std::int64_t utimeUs);

/// Where bodies are at instants, by their in-between motion; after its last pose a body stays.
/// Rounded, and so for pictures and for poses that users leave to the program, not for proofs.
class BodyPlaces {
 public:
  /// `bodies`, one per body, outlives it.
  explicit BodyPlaces(const std::vector<const BodyStretches*>& bodies) : bodies_(bodies) {}

  /// In the frame of its stretch. Precondition of all: the body and its carriers are there.
  [[nodiscard]] Pose poseAt(BodyId body, std::int64_t utimeUs) const;
  /// A link's frame in W.
  [[nodiscard]] RigidPose linkAt(BodyId body, LinkId link, std::int64_t utimeUs) const;
  /// The frame of the body's carrier, in W; the identity if it has none.
  [[nodiscard]] RigidPose carrierAt(BodyId body, std::int64_t utimeUs) const;
  /// Whether the body and all its carriers are there.
  [[nodiscard]] bool isThere(BodyId body, std::int64_t utimeUs) const;

 private:
  const std::vector<const BodyStretches*>& bodies_;
};

/// `inner`, given in the frame `outer`, in the frame in which `outer` is given.
[[nodiscard]] RigidPose composed(const RigidPose& outer, const RigidPose& inner);
/// The frame in which `frame` is given, seen from `frame`.
[[nodiscard]] RigidPose inverse(const RigidPose& frame);
/// The pose, its roots moved by `frame`.
[[nodiscard]] Pose movedBy(const RigidPose& frame, const Skeleton& skeleton, Pose pose);

}  // namespace foretouch::tools
