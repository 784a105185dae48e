// bindings/c/triggers.cpp: an ft_world's triggers, and how deep its bodies are in each other.
#include "bindings/c/include/foretouch/triggers.h"

#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"
#include "middleware/triggers/triggers.h"

namespace foretouch::c {
namespace {

ft_trigger_options defaultTriggerOptions() {
  const TriggerOptions defaults;
  ft_trigger_options options{};
  options.size = sizeof options;
  options.group = defaults.group;
  options.when_silent = static_cast<std::int32_t>(defaults.whenSilent);
  options.by_link = defaults.byLink ? 1 : 0;
  return options;
}

ft_status readTriggerOptions(const ft_trigger_options* given, TriggerOptions& options) {
  if (given == nullptr) return FT_OK;
  ft_trigger_options known = defaultTriggerOptions();
  if (const auto s = readStruct(given, "ft_trigger_options", known); s != FT_OK) return s;
  if (known.when_silent < FT_SILENT_WAIT || known.when_silent > FT_SILENT_UNDECIDED) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "when_silent: expected one of FT_SILENT_*, found %d", known.when_silent);
  }
  if (known.by_link != 0 && known.by_link != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "by_link: expected 0 or 1, found %d",
                   known.by_link);
  }
  options.group = known.group;
  options.whenSilent = static_cast<WhenSilent>(known.when_silent);
  options.byLink = known.by_link == 1;
  return FT_OK;
}

/// `shape`: the trigger's, if events may name its triangles.
ft_status add(ft_world& world, const Result<TriggerVolume>& volume, std::optional<Scene> shape,
              const ft_trigger_options* given, std::int32_t* trigger, std::int32_t* body) {
  FORETOUCH_CHECK_OR(worldFailure, volume);
  TriggerOptions options;
  if (const auto s = readTriggerOptions(given, options); s != FT_OK) return s;
  return addBody(world, {nullptr, std::move(shape)}, body, [&]() -> Result<BodyId> {
    FORETOUCH_TRY(const TriggerId added, world.triggers.add(world.world, volume.value(), options));
    if (trigger != nullptr) *trigger = added;
    return world.triggers.body(added);
  });
}

ft_status checkedTriggerEvents(const ft_world* world) {
  if (const auto s = checked(world); s != FT_OK) return s;
  if (world->hasEvents) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_world_follow() to be done before");
}

ft_trigger_event eventOf(const TriggerEvent& event) {
  ft_trigger_event c{};
  c.kind = static_cast<std::int32_t>(event.kind);
  c.trigger = event.trigger;
  c.body = event.body;
  c.link = event.link;
  c.is_assumed = event.isAssumed ? 1 : 0;
  c.time_us = event.time.us;
  c.time_fraction = event.time.fraction;
  c.since_us = event.since.us;
  c.since_fraction = event.since.fraction;
  return c;
}

ft_occupant occupantOf(const Occupant& occupant) {
  ft_occupant c{};
  c.trigger = occupant.trigger;
  c.body = occupant.body;
  c.link = occupant.link;
  c.is_unresolved = occupant.isUnresolved ? 1 : 0;
  c.since_us = occupant.since.us;
  c.since_fraction = occupant.since.fraction;
  return c;
}

ft_depth depthOf(const WorldDepth& found) {
  ft_depth c{};
  const Depth& depth = found.depth;
  const bool hasPair = depth.deepestMoved >= 0;
  c.is_certified = depth.isCertified ? 1 : 0;
  c.lower = depth.lower;
  c.upper = depth.upper;
  Eigen::Map<Eigen::Vector3d>(c.way_out) = depth.wayOut;
  c.pair_count = depth.numPairs;
  c.is_assumed = found.isAssumed ? 1 : 0;
  c.link = hasPair ? found.a.link : -1;
  c.lss = hasPair ? found.a.lss : -1;
  c.from_link = hasPair ? found.b.link : -1;
  c.from_lss = hasPair ? found.b.lss : -1;
  c.from_triangle = hasPair ? found.b.triangle : -1;
  return c;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_trigger_options_init(ft_trigger_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_trigger_options", defaultTriggerOptions());
}

ft_status ft_world_add_trigger_box(ft_world* world, const double half_extents[3],
                                   const ft_trigger_options* options, int32_t* trigger,
                                   int32_t* body) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(half_extents, "half_extents"); s != FT_OK) return s;
    const Eigen::Vector3d half = Eigen::Map<const Eigen::Vector3d>(half_extents);
    return add(*world, TriggerVolume::box(half), std::nullopt, options, trigger, body);
  });
}

ft_status ft_world_add_trigger_sphere(ft_world* world, double radius,
                                      const ft_trigger_options* options, int32_t* trigger,
                                      int32_t* body) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    return add(*world, TriggerVolume::sphere(radius), std::nullopt, options, trigger, body);
  });
}

ft_status ft_world_add_trigger_mesh(ft_world* world, const ft_scene* closed,
                                    const ft_trigger_options* options, int32_t* trigger,
                                    int32_t* body) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = needed(closed, "closed"); s != FT_OK) return s;
    if (const auto s = checked(closed); s != FT_OK) return s;
    return add(*world, TriggerVolume::mesh(closed->scene), closed->scene, options, trigger, body);
  });
}

ft_status ft_world_watch(ft_world* world, int32_t trigger, int32_t body, int32_t link) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    FORETOUCH_CHECK_OR(worldFailure, world->triggers.watch(world->world, trigger, {body, link}));
    return FT_OK;
  });
}

ft_status ft_world_stand_trigger(ft_world* world, int32_t trigger, int64_t from_us,
                                 const ft_pose* pose) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    if (const auto s = readPose(pose, "pose", skeletonOfMesh(), world->given); s != FT_OK) return s;
    const RigidPose at{world->given.rotations.front(), world->given.translations.front()};
    const auto stood = world->triggers.stand(world->world, trigger, from_us, at);
    FORETOUCH_CHECK_OR(worldFailure, stood);
    return FT_OK;
  });
}

ft_status ft_world_trigger_events(const ft_world* world, ft_trigger_event* events, size_t capacity,
                                  size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTriggerEvents(world); s != FT_OK) return s;
    const auto& all = world->triggerEvents.events;
    const auto at = [&](std::size_t i) { return eventOf(all[i]); };
    return writeList("ft_trigger_event", "events", all.size(), at, events, capacity, required);
  });
}

ft_status ft_world_occupants(const ft_world* world, ft_occupant* occupants, size_t capacity,
                             size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedTriggerEvents(world); s != FT_OK) return s;
    const auto& all = world->triggers.occupants();
    const auto at = [&](std::size_t i) { return occupantOf(all[i]); };
    return writeList("ft_occupant", "occupants", all.size(), at, occupants, capacity, required);
  });
}

ft_status ft_world_depth(ft_world* world, const ft_depth_question* question, ft_depth* depth) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    ft_depth_question asked{};
    if (const auto s = readStruct(question, "ft_depth_question", asked); s != FT_OK) return s;
    const DepthQuestion who{asked.body, asked.link, asked.from_body, asked.from_link};
    Scratch scratch;
    FORETOUCH_TRY_OR(worldFailure, const WorldDepth found,
                     world->world.depth({asked.time_us, asked.time_fraction}, who, scratch));
    return writeStruct(depth, "ft_depth", c::depthOf(found));
  });
}
