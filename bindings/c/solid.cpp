// bindings/c/solid.cpp: ft_solid.
#include <memory>
#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/solid_handle.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

ft_status checkedTick(const ft_solid* solid) {
  if (const auto s = checked(solid); s != FT_OK) return s;
  if (solid->hasTick) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_solid_follow() to be answered before");
}

/// Makes anew what an exception left half written; it goes on from where it was.
ft_status mended(ft_solid& solid) {
  if (!solid.isSuspect) return FT_OK;
  FORETOUCH_TRY_OR(solidFailure, auto made,
                   SolidAvatar::build(solid.avatar->avatar, solid.scene, solid.solid.options()));
  // Refused if the scene was changed around it: then it begins at the next pose.
  if (solid.hasLast && !made.reset(solid.last).ok()) solid.hasLast = false;
  solid.solid = std::move(made);
  solid.isSuspect = false;
  return FT_OK;
}

/// Calls a function of the solid avatar that may throw half-way.
template <typename Call>
ft_status change(ft_solid& solid, const char* place, const Call& call) {
  if (const auto s = mended(solid); s != FT_OK) return s;
  solid.isSuspect = true;
  const Result<Done> done = inFile(call(solid.solid), place);
  solid.isSuspect = false;
  return done.ok() ? ft_status{FT_OK} : solidFailure(done.error());
}

void copyTracked(const std::uint8_t* given, std::size_t joints, std::vector<std::uint8_t>& flags) {
  flags.clear();
  if (given != nullptr) flags.assign(given, given + joints);
}

/// Writes the tick that is done. Cannot fail: `last` has its size from the beginning.
void takeTick(ft_solid& solid) {
  std::swap(solid.tick, solid.next);
  solid.hasTick = true;
  solid.hasLast = solid.tick.state != SolidState::Placing;
  if (solid.hasLast) solid.last = solid.tick.shown;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_solid_create(const ft_scene* scene, const ft_avatar* avatar,
                          const ft_solid_options* options, ft_solid** solid) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(solid); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    SolidOptions read;
    if (const auto s = readSolidOptions(options, read); s != FT_OK) return s;
    FORETOUCH_TRY_OR(solidFailure, auto made,
                     SolidAvatar::build(avatar->parts->avatar, scene->scene, read));
    *solid = new ft_solid(avatar->parts, scene->scene, std::move(made));
    return FT_OK;
  });
}

ft_status ft_solid_follow(ft_solid* solid, const ft_pose* tracked, const uint8_t* is_tracked,
                          double dt_s, ft_solid_tick* tick) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(solid); s != FT_OK) return s;
    std::size_t size = 0;
    if (const auto s = readSize(tick, "ft_solid_tick", size); s != FT_OK) return s;
    const Skeleton& skeleton = solid->avatar->avatar.skeleton();
    if (const auto s = copyPose(tracked, "tracked", skeleton, solid->given); s != FT_OK) return s;
    copyTracked(is_tracked, countOf(skeleton.numJoints()), solid->isTracked);
    const SolidTarget target{solid->given, dt_s,
                             is_tracked == nullptr ? nullptr : &solid->isTracked};
    const auto s = change(*solid, "tracked",
                          [&](SolidAvatar& avatar) { return avatar.follow(target, solid->next); });
    if (s != FT_OK) return s;
    takeTick(*solid);
    return writeTick(solid->tick, tick);
  });
}

ft_status ft_solid_shown(const ft_solid* solid, double* rotations, double* translations,
                         size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTick(solid); s != FT_OK) return s;
    return writePose(solid->tick.shown, rotations, translations, capacity, required);
  });
}

ft_status ft_solid_joints(const ft_solid* solid, ft_solid_joint* joints, size_t capacity,
                          size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTick(solid); s != FT_OK) return s;
    return writeJoints(solid->tick, joints, capacity, required);
  });
}

ft_status ft_solid_contacts(const ft_solid* solid, ft_solid_contact* contacts, size_t capacity,
                            size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTick(solid); s != FT_OK) return s;
    return writeContacts(solid->tick, solid->scene, contacts, capacity, required);
  });
}

ft_status ft_solid_way(const ft_solid* solid, size_t index, double* time, double* rotations,
                       double* translations, size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTick(solid); s != FT_OK) return s;
    return writeWay(solid->tick, index, time, rotations, translations, capacity, required);
  });
}

ft_status ft_solid_reset(ft_solid* solid) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(solid); s != FT_OK) return s;
    const auto s = change(*solid, "", [](SolidAvatar& avatar) -> Result<Done> {
      avatar.reset();
      return Done{};
    });
    if (s == FT_OK) solid->hasLast = solid->hasTick = false;
    return s;
  });
}

ft_status ft_solid_reset_at(ft_solid* solid, const ft_pose* place) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(solid); s != FT_OK) return s;
    const Skeleton& skeleton = solid->avatar->avatar.skeleton();
    if (const auto s = readPose(place, "place", skeleton, solid->given); s != FT_OK) return s;
    const auto s =
        change(*solid, "place", [&](SolidAvatar& avatar) { return avatar.reset(solid->given); });
    if (s != FT_OK) return s;
    solid->hasTick = false;
    solid->hasLast = true;
    std::swap(solid->last, solid->given);
    return FT_OK;
  });
}

ft_status ft_solid_change_scene(ft_solid* solid, const ft_scene* scene) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(solid); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    const auto s = change(*solid, "scene",
                          [&](SolidAvatar& avatar) { return avatar.changeScene(scene->scene); });
    if (s != FT_OK) return s;
    solid->scene = scene->scene;
    solid->hasTick = false;
    return FT_OK;
  });
}

void ft_solid_destroy(ft_solid* solid) {
  destroy(__func__, solid);
}
