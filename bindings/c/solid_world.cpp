// bindings/c/solid_world.cpp: an ft_world with solid avatars in it.
#include "bindings/c/include/foretouch/solid_world.h"

#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/solid_handle.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(SolidReach::Skin) == FT_SOLID_REACH_SKIN);
static_assert(static_cast<int>(SolidReach::Surface) == FT_SOLID_REACH_SURFACE);

ft_status checkedSolids(const ft_world* world) {
  if (const auto s = checked(world); s != FT_OK) return s;
  if (world->solids) return FT_OK;
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "world: expected one of ft_solid_world_create(), found one of ft_world_create()");
}

/// Null, and the failure, if the last tick has none.
const SolidBodyTick* tickOf(const ft_world* world, std::int32_t body, ft_status& status) {
  status = checkedSolids(world);
  if (status == FT_OK) status = checkedBody(*world, body);
  if (status != FT_OK) return nullptr;
  for (const SolidBodyTick& tick : world->solids->ticks) {
    if (tick.body == body) return &tick;
  }
  status = failure(FT_ERROR_NO_STEP, body,
                   "body: expected a solid avatar that has had a target, found %d", body);
  return nullptr;
}

/// Answers with what `write` makes of the body's last tick.
template <typename Write>
ft_status ofTick(const char* function, const ft_world* world, std::int32_t body,
                 const Write& write) {
  return guarded(function, [&]() -> ft_status {
    ft_status status = FT_OK;
    const SolidBodyTick* const tick = tickOf(world, body, status);
    return tick == nullptr ? status : write(*tick);
  });
}

/// Copies the targets; the library checks them.
ft_status readTargets(ft_world& world, const ft_solid_target* given, std::size_t count) {
  const auto s = neededArray(given, count, world.bodies.size(), "targets");
  if (s != FT_OK) return s;
  ft_world::Solids& solids = *world.solids;
  if (solids.poses.size() < count) solids.poses.resize(count);
  if (solids.tracked.size() < count) solids.tracked.resize(count);
  solids.targets.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const ft_solid_target& one = given[i];
    if (const auto t = zero(static_cast<std::uint32_t>(one.reserved), "reserved"); t != FT_OK) {
      return t;
    }
    if (const auto t = copyBodyPose(world, one.body, one.pose, solids.poses[i]); t != FT_OK) {
      return t;
    }
    SolidBodyTarget target{one.body, &solids.poses[i], nullptr};
    if (one.is_tracked != nullptr) {
      const std::size_t joints = solids.poses[i].rotations.size();
      solids.tracked[i].assign(one.is_tracked, one.is_tracked + joints);
      target.isTracked = &solids.tracked[i];
    }
    solids.targets.push_back(target);
  }
  return FT_OK;
}

ft_solid_body_contact contactOf(const ft_world& world, const SolidBodyContact& contact) {
  const std::optional<Scene>& mesh = world.bodies[slotOf(contact.body)].mesh;
  ft_solid_body_contact c{};
  c.body = contact.body;
  c.link = contact.link;
  c.lss = contact.lss;
  c.triangle = contact.triangle;
  c.object = contact.triangle < 0 || !mesh ? -1 : mesh->object(contact.triangle);
  copyPress(contact, c);
  return c;
}

ft_solid_crush crushOf(const SolidCrush& crush) {
  ft_solid_crush c{};
  c.body = crush.body;
  c.link = crush.link;
  c.is_over = crush.isOver ? 1 : 0;
  c.since_us = crush.sinceUs;
  c.depth = crush.depth;
  return c;
}

/// What hands hold: all of the first list, then of the second, then of the third.
ft_solid_held heldOf(const SolidBodyTick& tick, std::size_t i) {
  ft_solid_held c{};
  for (const auto* const list : {&tick.tools, &tick.looseTools, &tick.letGo}) {
    if (i < list->size()) {
      c.body = (*list)[i];
      break;
    }
    i -= list->size();
    ++c.state;
  }
  return c;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_solid_world_create(const ft_scene* still, int64_t begin_us, int32_t reach,
                                const ft_world_options* options, ft_world** world) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(world); s != FT_OK) return s;
    if (const auto s = checked(still); s != FT_OK) return s;
    WorldOptions read;
    if (const auto s = readWorldOptions(options, read); s != FT_OK) return s;
    if (reach != FT_SOLID_REACH_SKIN && reach != FT_SOLID_REACH_SURFACE) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                     "reach: expected one of FT_SOLID_REACH_*, found %d", reach);
    }
    FORETOUCH_TRY_OR(
        worldFailure, auto made,
        SolidWorld::build(still->scene, begin_us, read, static_cast<SolidReach>(reach)));
    FORETOUCH_TRY_OR(worldFailure, auto follower, WorldFollower::start(begin_us));
    *world = new ft_world(still->scene, std::move(made), std::move(follower));
    return FT_OK;
  });
}

ft_status ft_solid_world_add(ft_world* world, const ft_avatar* avatar,
                             const ft_solid_options* options, const ft_body_options* body,
                             int32_t* number) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedSolids(world); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    if (const auto s = needed(number, "number"); s != FT_OK) return s;
    SolidOptions solid;
    if (const auto s = readSolidOptions(options, solid); s != FT_OK) return s;
    BodyOptions read;
    if (const auto s = readBodyOptions(body, avatar->parts.get(), read); s != FT_OK) return s;
    return addBody(*world, {avatar->parts, std::nullopt}, number,
                   [&] { return world->solids->world.add(avatar->parts->avatar, solid, read); });
  });
}

ft_status ft_solid_world_tick(ft_world* world, int64_t utime_us, const ft_solid_target* targets,
                              size_t count) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedSolids(world); s != FT_OK) return s;
    ft_world::Solids& solids = *world->solids;
    if (solids.isBroken) {
      return failure(FT_ERROR_OUT_OF_MEMORY, kNoIndex,
                     "memory ran out within an earlier tick; expected a new world");
    }
    if (const auto s = readTargets(*world, targets, count); s != FT_OK) return s;
    solids.isBroken = true;
    const Result<Done> done = solids.world.tick(utime_us, solids.targets, solids.next);
    solids.isBroken = false;
    FORETOUCH_CHECK_OR(worldFailure, done);
    std::swap(solids.ticks, solids.next);
    return FT_OK;
  });
}

ft_status ft_solid_world_at(const ft_world* world, int64_t* utime_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedSolids(world); s != FT_OK) return s;
    if (const auto s = needed(utime_us, "utime_us"); s != FT_OK) return s;
    *utime_us = world->solids->world.utimeUs();
    return FT_OK;
  });
}

ft_status ft_solid_world_get_tick(const ft_world* world, int32_t body, ft_solid_tick* tick,
                                  int32_t* is_assumed) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    const auto s = writeTick(of.tick, tick);
    if (s == FT_OK && is_assumed != nullptr) *is_assumed = of.isAssumed ? 1 : 0;
    return s;
  });
}

ft_status ft_solid_world_shown(const ft_world* world, int32_t body, double* rotations,
                               double* translations, size_t capacity, size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    return writePose(of.tick.shown, rotations, translations, capacity, required);
  });
}

ft_status ft_solid_world_joints(const ft_world* world, int32_t body, ft_solid_joint* joints,
                                size_t capacity, size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    return writeJoints(of.tick, joints, capacity, required);
  });
}

ft_status ft_solid_world_contacts(const ft_world* world, int32_t body, ft_solid_contact* contacts,
                                  size_t capacity, size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    return writeContacts(of.tick, *world->still, contacts, capacity, required);
  });
}

ft_status ft_solid_world_way(const ft_world* world, int32_t body, size_t index, double* time,
                             double* rotations, double* translations, size_t capacity,
                             size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    return writeWay(of.tick, index, time, rotations, translations, capacity, required);
  });
}

ft_status ft_solid_world_body_contacts(const ft_world* world, int32_t body,
                                       ft_solid_body_contact* contacts, size_t capacity,
                                       size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    const auto at = [&](std::size_t i) { return contactOf(*world, of.contacts[i]); };
    return writeList("ft_solid_body_contact", "contacts", of.contacts.size(), at, contacts,
                     capacity, required);
  });
}

ft_status ft_solid_world_crushes(const ft_world* world, int32_t body, ft_solid_crush* crushes,
                                 size_t capacity, size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    const auto at = [&](std::size_t i) { return crushOf(of.crushes[i]); };
    return writeList("ft_solid_crush", "crushes", of.crushes.size(), at, crushes, capacity,
                     required);
  });
}

ft_status ft_solid_world_held(const ft_world* world, int32_t body, ft_solid_held* held,
                              size_t capacity, size_t* required) {
  return ofTick(__func__, world, body, [&](const SolidBodyTick& of) {
    const std::size_t count = of.tools.size() + of.looseTools.size() + of.letGo.size();
    const auto at = [&](std::size_t i) { return heldOf(of, i); };
    return writeList("ft_solid_held", "held", count, at, held, capacity, required);
  });
}
