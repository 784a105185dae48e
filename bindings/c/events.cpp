// bindings/c/events.cpp: following an ft_world: what happens in it.
#include "bindings/c/include/foretouch/events.h"

#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"
#include "middleware/events/told_depth.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(EventKind::Leave) == FT_EVENT_LEAVE);
static_assert(static_cast<int>(EventKind::UnresolvedTo) == FT_EVENT_UNRESOLVED_TO);
static_assert(static_cast<int>(EventKind::StartsInside) == FT_EVENT_STARTS_INSIDE);
static_assert(static_cast<int>(EventKind::Enter) == FT_EVENT_ENTER);
static_assert(static_cast<int>(EventKind::UnresolvedFrom) == FT_EVENT_UNRESOLVED_FROM);
static_assert(static_cast<int>(LeaveCause::Apart) == FT_LEAVE_APART);
static_assert(static_cast<int>(LeaveCause::NotAsked) == FT_LEAVE_NOT_ASKED);
static_assert(static_cast<int>(LeaveCause::Moved) == FT_LEAVE_MOVED);
static_assert(kEveryBody == FT_EVERY_BODY);

ft_follow_options defaultFollowOptions() {
  const FollowOptions defaults;
  ft_follow_options options{};
  options.size = sizeof options;
  options.threads = defaults.threads;
  options.cut_us = defaults.cutUs;
  return options;
}

ft_status checkedFollower(const ft_world* world) {
  if (const auto s = checked(world); s != FT_OK) return s;
  if (world->follower) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_world_follow_from() before");
}

ft_status checkedFollowed(const ft_world* world) {
  if (const auto s = checkedFollower(world); s != FT_OK) return s;
  if (world->hasEvents) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_world_follow() to be done before");
}

template <typename Done>
ft_status ended(const Done& done) {
  return done.ok() ? ft_status{FT_OK} : worldFailure(done.error());
}

/// `object`: what the event is about.
ft_world_side eventSideOf(const ft_world& world, const ContactSide& side, ObjectId object) {
  const bool hasObjects =
      side.body == kStillScene || (side.body >= 0 && world.bodies[slotOf(side.body)].mesh);
  return sideOf(side, hasObjects ? object : -1);
}

ft_event_point pointOf(const EventPoint& point) {
  ft_event_point c{};
  Eigen::Map<Eigen::Vector3d>(c.point_a) = point.p_WA;
  Eigen::Map<Eigen::Vector3d>(c.point_b) = point.p_WB;
  c.separation = point.separation;
  return c;
}

ft_event eventOf(const ft_world& world, const WorldEvent& event) {
  ft_event c{};
  c.kind = static_cast<std::int32_t>(event.kind);
  c.cause = static_cast<std::int32_t>(event.cause);
  c.reason = static_cast<std::int32_t>(event.reason);
  c.time_us = event.time.us;
  c.time_fraction = event.time.fraction;
  c.since_us = event.since.us;
  c.since_fraction = event.since.fraction;
  c.separation = event.separation;
  c.penetration = toldDepth(event);
  Eigen::Map<Eigen::Vector3d>(c.normal) = event.nhat_BA_W;
  Eigen::Map<Eigen::Vector3d>(c.velocity) = event.velocity_W;
  c.approach_speed = event.approachSpeed;
  c.approach_lower = event.approachLower;
  c.approach_upper = event.approachUpper;
  c.effective_mass = event.effectiveMass;
  c.a = eventSideOf(world, event.a, event.object);
  c.b = eventSideOf(world, event.b, event.object);
  c.is_assumed = event.isAssumed ? 1 : 0;
  c.point_count = static_cast<std::int32_t>(event.numPoints);
  for (std::size_t i = 0; i < event.numPoints; ++i) c.points[i] = pointOf(event.points[i]);
  return c;
}

ft_part partOf(const ft_world& world, const WorldPart& part) {
  ft_part c{};
  c.is_contact = part.kind == PartKind::Contact ? 1 : 0;
  c.reason = static_cast<std::int32_t>(part.reason);
  c.is_assumed = part.isAssumed ? 1 : 0;
  c.began_before = part.beganBefore ? 1 : 0;
  c.goes_on = part.goesOn ? 1 : 0;
  c.from_us = part.from.us;
  c.from_fraction = part.from.fraction;
  c.to_us = part.to.us;
  c.to_fraction = part.to.fraction;
  c.since_us = part.since.us;
  c.since_fraction = part.since.fraction;
  c.a = eventSideOf(world, part.a, part.object);
  c.b = eventSideOf(world, part.b, part.object);
  return c;
}

/// A part that has not ended, up to where the world is followed.
WorldPart partOf(const OpenPart& open, std::int64_t untilUs) {
  WorldPart part;
  part.kind = open.kind;
  part.reason = open.reason;
  part.isAssumed = open.isAssumed;
  part.goesOn = true;
  part.a = open.a;
  part.b = open.b;
  part.object = open.object;
  part.from = part.since = open.since;
  part.to = {untilUs, 0.0};
  return part;
}

ft_status checkedWeighed(const ft_world* world, std::int32_t body) {
  if (const auto s = checkedFollower(world); s != FT_OK) return s;
  return checkedBody(*world, body);
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_follow_options_init(ft_follow_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_follow_options", defaultFollowOptions());
}

ft_status ft_world_follow_from(ft_world* world, int64_t from_us, const ft_follow_options* options) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    ft_follow_options known = defaultFollowOptions();
    if (options != nullptr) {
      if (const auto s = readStruct(options, "ft_follow_options", known); s != FT_OK) return s;
    }
    if (known.cut_us < 0 || known.cut_us > kMostCutUs) {
      return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "cut_us: expected 0 to %lld, found %lld",
                     static_cast<long long>(kMostCutUs), static_cast<long long>(known.cut_us));
    }
    FollowOptions read;
    read.threads = known.threads;
    read.cutUs = known.cut_us;
    FORETOUCH_TRY_OR(worldFailure, auto made, WorldFollower::start(from_us, read));
    world->follower = std::move(made);
    world->triggers.beginAnew();
    world->hasEvents = false;
    return FT_OK;
  });
}

ft_status ft_world_weigh(ft_world* world, int32_t body, double kg, const double* center,
                         const double* inertia) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedWeighed(world, body); s != FT_OK) return s;
    if (const auto s = needed(center, "center"); s != FT_OK) return s;
    if (const auto s = needed(inertia, "inertia"); s != FT_OK) return s;
    const auto& avatar = world->bodies[slotOf(body)].avatar;
    if (avatar && avatar->avatar.numLinks() != 1) {
      return failure(FT_ERROR_MISMATCH, body, "body: expected one of one joint, found %d",
                     avatar->avatar.numLinks());
    }
    Mass mass;
    mass.kg = kg;
    mass.center_B = Eigen::Map<const Eigen::Vector3d>(center);
    mass.inertia_B = Eigen::Map<const Eigen::Matrix3d>(inertia).transpose();
    return ended(world->follower->weigh(body, mass));
  });
}

ft_status ft_world_weigh_avatar(ft_world* world, int32_t body, double kg) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedWeighed(world, body); s != FT_OK) return s;
    const auto& avatar = world->bodies[slotOf(body)].avatar;
    if (!avatar) return failure(FT_ERROR_MISMATCH, body, "body: expected an avatar, found a mesh");
    FORETOUCH_TRY_OR(worldFailure, auto masses, massesOfLinks(avatar->avatar, kg));
    FORETOUCH_TRY_OR(worldFailure, auto mass,
                     AvatarMass::build(avatar->avatar.skeleton(), std::move(masses)));
    return ended(world->follower->weigh(body, std::move(mass)));
  });
}

ft_status ft_world_follow(ft_world* world, int64_t until_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedFollower(world); s != FT_OK) return s;
    const Result<Done> done = world->follower->follow(world->world, until_us, world->nextEvents);
    FORETOUCH_CHECK_OR(worldFailure, done);
    std::swap(world->events, world->nextEvents);
    world->hasEvents = true;
    FORETOUCH_CHECK_OR(worldFailure,
                       world->triggers.update(world->world, world->events, world->triggerEvents));
    return FT_OK;
  });
}

ft_status ft_world_followed(const ft_world* world, int64_t* from_us, int64_t* until_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedFollowed(world); s != FT_OK) return s;
    if (from_us != nullptr) *from_us = world->events.fromUs;
    if (until_us != nullptr) *until_us = world->events.toUs;
    return FT_OK;
  });
}

ft_status ft_world_events(const ft_world* world, ft_event* events, size_t capacity,
                          size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedFollowed(world); s != FT_OK) return s;
    const auto& all = world->events.events;
    const auto at = [&](std::size_t i) { return eventOf(*world, all[i]); };
    return writeList("ft_event", "events", all.size(), at, events, capacity, required);
  });
}

ft_status ft_world_parts(const ft_world* world, ft_part* parts, size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedFollowed(world); s != FT_OK) return s;
    const auto& all = world->events.parts;
    const auto at = [&](std::size_t i) { return partOf(*world, all[i]); };
    return writeList("ft_part", "parts", all.size(), at, parts, capacity, required);
  });
}

ft_status ft_world_open_parts(const ft_world* world, ft_part* parts, size_t capacity,
                              size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedFollower(world); s != FT_OK) return s;
    const auto& all = world->follower->open();
    const std::int64_t untilUs = world->follower->followedUntilUs();
    const auto at = [&](std::size_t i) { return partOf(*world, partOf(all[i], untilUs)); };
    return writeList("ft_part", "parts", all.size(), at, parts, capacity, required);
  });
}
