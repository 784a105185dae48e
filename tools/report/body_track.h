// tools/report/body_track.h: the poses of a body of a world in time, as a view document has them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "articulated/result.h"
#include "tools/report/track_builder.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Stands for a body of triangles where an avatar is expected: for bounds; it is not shown at
/// all. Errors: those of Avatar::build().
[[nodiscard]] Result<Avatar> standInOf(const BodyShape& shape);

/// The poses of a body in time, and between which of them its motion is known or taken to be.
class BodyTrack {
 public:
  /// All outlive it.
  BodyTrack(const LoadedWorld& world, BodyId body, const Avatar& shownAs,
            const std::vector<const BodyStretches*>& stretches)
      : world_(world),
        id_(body),
        body_(world.bodies[slotOf(body)]),
        places_(stretches),
        builder_(shownAs, std::nullopt) {}

  /// Returns whether there was room for all.
  bool addAll(std::size_t mostPoses);

  [[nodiscard]] const TrackBuilder& builder() const { return builder_; }
  [[nodiscard]] ViewTrack finish() { return builder_.finish(); }

 private:
  bool addStretch(const BodyStretch& stretch, std::int64_t endUs, std::size_t mostPoses);
  /// The body's own in [fromUs, untilUs]; while it is held fast, those of its holder: its steps
  /// are then the holder's.
  void addKnots(BodyId body, std::int64_t fromUs, std::int64_t untilUs, int depth,
                std::set<std::int64_t>& instants) const;

  const LoadedWorld& world_;
  BodyId id_;
  const LoadedBody& body_;
  BodyPlaces places_;
  TrackBuilder builder_;
};

}  // namespace foretouch::tools
