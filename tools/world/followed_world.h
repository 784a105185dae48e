// tools/world/followed_world.h: a world file's world, followed from enter to leave, and what is in
// its triggers.
#pragma once

#include <cstdint>
#include <functional>

#include "articulated/result.h"
#include "middleware/events/world_event.h"
#include "middleware/triggers/triggers.h"
#include "tools/world/loaded_world.h"

namespace foretouch::tools {

/// The events of a stretch of time. Contacts include those with triggers: isOfTrigger().
struct FollowedStretch {
  const WorldEvents& contacts;
  const TriggerEvents& triggers;
};

/// One of the two sides of an event or a part is a trigger, which nothing touches.
template <typename TwoSided>
[[nodiscard]] bool isOfTrigger(const LoadedWorld& world, const TwoSided& of) {
  return world.isTrigger(of.a.body) || world.isTrigger(of.b.body);
}

/// Refuses a world whose contacts are not followed: one in which meshes may meet. Errors name the
/// file and the place in it.
[[nodiscard]] Result<Done> checkFollowed(const LoadedWorld& world);

/// Follows all of [fromUs, untilUs], stretch after stretch, until `take` returns false. What is
/// reported does not depend on where stretches end. Errors name the body.
[[nodiscard]] Result<Done> followWorld(LoadedWorld& world, std::int64_t fromUs,
                                       std::int64_t untilUs,
                                       const std::function<bool(const FollowedStretch&)>& take);

}  // namespace foretouch::tools
