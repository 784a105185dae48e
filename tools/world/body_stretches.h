// tools/world/body_stretches.h: where the bodies of a world are over all of its time, kept for who
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

/// Of one body, by time.
using BodyStretches = std::vector<BodyStretch>;

/// The pose of a track at an instant from its first one on; after its last one it stays.
[[nodiscard]] Pose poseOn(const Track& track, std::int64_t utimeUs);

/// The stretch of an instant; null before the first one. O(log stretches).
[[nodiscard]] const BodyStretch* stretchAt(const BodyStretches& stretches, std::int64_t utimeUs);

/// Where bodies are at instants, by their in-between motion; after its last pose a body stays.
/// Rounded, and so for pictures and for poses that somebody leaves to the program, not for proofs.
class BodyPlaces {
 public:
  /// `bodies`, one per body, outlives it.
  explicit BodyPlaces(const std::vector<const BodyStretches*>& bodies) : bodies_(bodies) {}

  /// In the frame of its stretch. Precondition of all: the body, and who carries it, is there.
  [[nodiscard]] Pose poseAt(BodyId body, std::int64_t utimeUs) const;
  /// A link's frame in W.
  [[nodiscard]] RigidPose linkAt(BodyId body, LinkId link, std::int64_t utimeUs) const;
  /// The frame of who carries the body: in W; the identity if nobody does.
  [[nodiscard]] RigidPose carrierAt(BodyId body, std::int64_t utimeUs) const;
  /// Whether it and all who carry it are there.
  [[nodiscard]] bool isThere(BodyId body, std::int64_t utimeUs) const;

 private:
  const std::vector<const BodyStretches*>& bodies_;
};

/// `inner`, which is in the frame of `outer`, in that of `outer`.
[[nodiscard]] RigidPose composed(const RigidPose& outer, const RigidPose& inner);
/// The frame of whom `frame` is about, seen from it.
[[nodiscard]] RigidPose inverse(const RigidPose& frame);
/// The pose, its roots moved by `frame`.
[[nodiscard]] Pose movedBy(const RigidPose& frame, const Skeleton& skeleton, Pose pose);

}  // namespace foretouch::tools
