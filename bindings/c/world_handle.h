// bindings/c/world_handle.h: the struct behind ft_world.
#pragma once

#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bindings/c/handles.h"
#include "bindings/c/include/foretouch/world.h"
#include "middleware/depth/world_depth.h"
#include "middleware/events/world_follower.h"
#include "middleware/triggers/triggers.h"
#include "middleware/world/world_query.h"

/// For one thread. Answers a window beside the last one, which it replaces once done.
struct ft_world {
  static constexpr auto kMark = foretouch::c::Mark::World;
  static constexpr const char* kName = "world";

  /// Of an avatar or of a mesh.
  struct Body {
    std::shared_ptr<const foretouch::c::AvatarParts> avatar;
    std::optional<foretouch::Scene> mesh;
  };

  ft_world(std::optional<foretouch::Scene> ofStill, foretouch::World made)
      : still(std::move(ofStill)), world(std::move(made)) {}

  foretouch::c::Mark mark = kMark;
  std::optional<foretouch::Scene> still;
  foretouch::World world;
  std::vector<Body> bodies;
  foretouch::Pose given;
  std::optional<foretouch::WorldScratch> scratch;
  bool isScratchSuspect = true;  // an exception left it half written, or it is not made yet
  foretouch::WorldContacts answer, next;
  bool hasAnswer = false;
  std::optional<foretouch::WorldFollower> follower;
  foretouch::WorldEvents events, nextEvents;
  bool hasEvents = false;
  foretouch::Triggers triggers;
  foretouch::TriggerEvents triggerEvents;
};

namespace foretouch::c {

/// As WorldOptions and BodyOptions have them.
[[nodiscard]] ft_world_options defaultWorldOptions();
[[nodiscard]] ft_body_options defaultBodyOptions();
/// NULL: the usual ones. The library itself checks the values.
[[nodiscard]] ft_status readWorldOptions(const ft_world_options* given, WorldOptions& options);
/// `avatar`: the body's; null of a mesh.
[[nodiscard]] ft_status readBodyOptions(const ft_body_options* given, const AvatarParts* avatar,
                                        BodyOptions& options);
/// 0 or 1; `name`: of the argument.
[[nodiscard]] ft_status readTruth(std::int32_t given, const char* name, bool& truth);

/// Of a body of one joint, as meshes and triggers are.
[[nodiscard]] const Skeleton& skeletonOfMesh();

/// An error about an option or argument names it as C does.
[[nodiscard]] ft_status worldFailure(Error error);

}  // namespace foretouch::c
