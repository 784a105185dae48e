// bindings/c/world_handle.h: the struct behind ft_world.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "bindings/c/handles.h"
#include "bindings/c/include/foretouch/world.h"
#include "middleware/ask/ask.h"
#include "middleware/depth/depth.h"
#include "middleware/events/world_follower.h"
#include "middleware/solid_world/solid_world.h"
#include "middleware/triggers/triggers.h"
#include "middleware/world/world.h"

/// For one thread. Answers a window beside the last one, which it replaces once done.
struct ft_world {
  static constexpr auto kMark = foretouch::c::Mark::World;
  static constexpr const char* kName = "world";

  /// What a body is made of: an avatar or a mesh.
  struct Body {
    std::shared_ptr<const foretouch::c::AvatarParts> avatar;
    std::optional<foretouch::Scene> mesh;
  };

  /// What a solid world has for its solid avatars.
  struct Solids {
    explicit Solids(foretouch::SolidWorld made) : world(std::move(made)) {}
    foretouch::SolidWorld world;
    std::vector<foretouch::Pose> poses;              // of the targets
    std::vector<std::vector<std::uint8_t>> tracked;  // their joints
    std::vector<foretouch::SolidBodyTarget> targets;
    std::vector<foretouch::SolidBodyTick> ticks, next;
    bool isBroken = false;  // memory ran out within a tick
  };

  ft_world(std::optional<foretouch::Scene> ofStill, foretouch::World made)
      : still(std::move(ofStill)), own(std::move(made)), world(*own) {}
  ft_world(foretouch::Scene ofStill, foretouch::SolidWorld made, foretouch::WorldFollower follows)
      : still(std::move(ofStill)),
        solids(std::move(made)),
        world(solids->world.world()),
        follower(std::move(follows)) {}

  foretouch::c::Mark mark = kMark;
  std::optional<foretouch::Scene> still;
  std::optional<Solids> solids;
  std::optional<foretouch::World> own;
  foretouch::World& world;  // one of these two
  std::vector<Body> bodies;
  foretouch::Pose given;
  std::optional<foretouch::Scratch> scratch;
  bool isScratchSuspect = true;  // an exception left it half written, or it is not made yet
  foretouch::WorldContacts answer, next;
  bool hasAnswer = false;
  std::optional<foretouch::WorldFollower> follower;
  foretouch::WorldEvents events, nextEvents;
  bool hasEvents = false;
  foretouch::Triggers triggers;
  foretouch::TriggerEvents triggerEvents;

  /// Questions at an instant and through a time, and the last answers.
  struct Asked {
    foretouch::WorldQuestion question;
    std::vector<foretouch::WorldQuestion> questions;
    foretouch::WorldAnswer answer, next;  // many questions' answers: one after the other
    std::vector<foretouch::WorldAnswer> answers;
    foretouch::FlightQuestion flight;
    foretouch::FlightAnswer flown;
    std::vector<foretouch::UnknownBody> unknown;  // to the last of both
    bool hasAnswer = false, hasUnknown = false;
  };
  Asked asked;

  template <typename Ask>
  auto withScratch(const Ask& ask) {
    if (isScratchSuspect) scratch.emplace();
    isScratchSuspect = true;
    auto done = ask(*scratch);
    isScratchSuspect = false;
    return done;
  }
};

namespace foretouch::c {

/// As WorldOptions and BodyOptions have them.
[[nodiscard]] ft_world_options defaultWorldOptions();
[[nodiscard]] ft_body_options defaultBodyOptions();
/// NULL: the usual ones. The library itself checks the values.
[[nodiscard]] ft_status readWorldOptions(const ft_world_options* given, WorldOptions& options);
/// `avatar`: the body's; null for a mesh.
[[nodiscard]] ft_status readBodyOptions(const ft_body_options* given, const AvatarParts* avatar,
                                        BodyOptions& options);
/// Reads 0 or 1; `name`: the argument's.
[[nodiscard]] ft_status readTruth(std::int32_t given, const char* name, bool& truth);

/// The skeleton of a body of one joint, as meshes and triggers are.
[[nodiscard]] const Skeleton& skeletonOfMesh();

/// FT_ERROR_UNKNOWN_NAME with the body's number, unless it was added.
[[nodiscard]] ft_status checkedBody(const ft_world& world, std::int32_t body);
/// Copies the pose of a body, which the world itself checks.
[[nodiscard]] ft_status copyBodyPose(const ft_world& world, std::int32_t body, const ft_pose* given,
                                     Pose& pose);
/// `object`: its triangle's; -1: none.
[[nodiscard]] ft_world_side sideOf(const ContactSide& side, ObjectId object);
/// An error about an option or argument names it as C does.
[[nodiscard]] ft_status worldFailure(Error error);

/// Calls `call`, which adds a body to the library's world, and keeps what it is made of; nothing
/// has changed where memory runs out. `number` may be null.
template <typename Call>
[[nodiscard]] ft_status addBody(ft_world& world, ft_world::Body body, std::int32_t* number,
                                const Call& call) {
  auto& bodies = world.bodies;
  if (bodies.size() == bodies.capacity()) bodies.reserve(2 * bodies.size() + 8);
  const Result<BodyId> added = call();
  FORETOUCH_CHECK_OR(worldFailure, added);
  bodies.push_back(std::move(body));  // there is room
  if (number != nullptr) *number = added.value();
  return FT_OK;
}

}  // namespace foretouch::c
