// tools/stream/world_publisher.h: sends the bodies of a world file like live senders: avatars by
// skeleton_t and pose_t, props by body_t and rigid_pose_t, each on time.
#pragma once

#include <cstdint>

#include "articulated/result.h"
#include "tools/stream/clip_publisher.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// Refuses what messages cannot express: an avatar that is carried.
[[nodiscard]] Result<Done> checkPublished(const LoadedWorld& world);

/// Sends the world once, or in a loop, from its begin to its end; numbers are numberInMessages().
/// PublishOptions::sender has the start, and the source. The speed changes the world: what is sent
/// has that speed, stamps of capture included. Above 0.
///
/// Every pose of the file is sent, and between poses farther apart than kMostQuietUs the motion in
/// between, so that no receiver takes the body to be silent. Changes of carriers are said
/// kAnnouncedUs before their instants, at them, and every second. At the end, and where it is
/// stopped, props are gone.
[[nodiscard]] Result<PublishReport> publishWorld(const LoadedWorld& world,
                                                 const PublishOptions& options, Pace& pace,
                                                 const MessageSink& sink);
inline constexpr std::int64_t kMostQuietUs = 50'000, kAnnouncedUs = 100'000;

}  // namespace foretouch::tools
