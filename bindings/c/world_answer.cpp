// bindings/c/world_answer.cpp: a window of an ft_world, and its answer.
#include <utility>

#include "articulated/try.h"
#include "bindings/c/sized_struct.h"
#include "bindings/c/world_handle.h"
#include "lss/index.h"
#include "middleware/events/told_depth.h"

namespace foretouch::c {
namespace {

static_assert(kStillScene == FT_STILL_SCENE);
static_assert(kEveryLink == FT_EVERY_LINK);

ft_status checkedAnswer(const ft_world* world) {
  if (const auto s = checked(world); s != FT_OK) return s;
  if (world->hasAnswer) return FT_OK;
  return failure(FT_ERROR_NO_STEP, kNoIndex, "expected ft_world_answer() to be answered before");
}

/// -1 where no triangle is touched, or a link's.
std::int32_t objectOf(const ft_world& world, const ContactSide& side) {
  if (side.triangle < 0) return -1;
  if (side.body == kStillScene) return world.still->object(side.triangle);
  const std::optional<Scene>& mesh = world.bodies[slotOf(side.body)].mesh;
  return mesh ? mesh->object(side.triangle) : -1;
}

ft_world_contact worldContactOf(const ft_world& world, const WorldContact& contact) {
  ft_world_contact c{};
  c.verdict = static_cast<std::int32_t>(contact.verdict);
  c.reason = static_cast<std::int32_t>(contact.reason);
  c.is_assumed = contact.isAssumed ? 1 : 0;
  c.time_us = contact.time.us;
  c.time_fraction = contact.time.fraction;
  c.separation = contact.separation;
  c.penetration = toldDepth(contact);
  Eigen::Map<Eigen::Vector3d>(c.normal) = contact.nhat_BA_W;
  c.a = sideOf(contact.a, objectOf(world, contact.a));
  c.b = sideOf(contact.b, objectOf(world, contact.b));
  return c;
}

ft_silent_body silentOf(const SilentBody& silent) {
  ft_silent_body c{};
  c.body = silent.body;
  c.since_us = silent.sinceUs;
  c.taken_to = static_cast<std::int32_t>(silent.takenTo);
  return c;
}

ft_world_counters countersOf(const WorldCounters& counted) {
  ft_world_counters c{};
  c.bodies = counted.bodies;
  c.pairs = counted.pairs;
  c.near_pairs = counted.nearPairs;
  c.spans = counted.spans;
  c.nodes = counted.queries.nodes;
  c.leaves = counted.queries.leaves;
  c.candidates = counted.queries.candidates;
  c.cluster_steps = counted.queries.clusterSteps;
  c.lane_steps = counted.queries.laneSteps;
  c.part_steps = counted.queries.partSteps;
  c.advancements = counted.queries.advancements;
  c.hierarchy_tests = counted.queries.hierarchyTests;
  c.plane_tests = counted.queries.planeTests;
  c.leaf_tests = counted.queries.leafTests;
  c.states = counted.queries.states;
  c.rung_tests = counted.queries.rungTests;
  return c;
}

}  // namespace

ft_world_side sideOf(const ContactSide& side, ObjectId object) {
  ft_world_side c{};
  c.body = side.body;
  c.link = side.link;
  c.lss = side.lss;
  c.triangle = side.triangle;
  c.object = object;
  Eigen::Map<Eigen::Vector3d>(c.point) = side.p_W;
  return c;
}

}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_world_answer(ft_world* world, int64_t from_us, int64_t to_us) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(world); s != FT_OK) return s;
    const Result<Done> done = world->withScratch([&](Scratch& scratch) {
      return world->world.contacts(from_us, to_us, scratch, world->next);
    });
    FORETOUCH_CHECK_OR(worldFailure, done);
    std::swap(world->answer, world->next);
    world->hasAnswer = true;
    return FT_OK;
  });
}

ft_status ft_world_contacts(const ft_world* world, ft_world_contact* contacts, size_t capacity,
                            size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAnswer(world); s != FT_OK) return s;
    const auto& all = world->answer.contacts;
    const auto at = [&](std::size_t i) { return worldContactOf(*world, all[i]); };
    return writeList("ft_world_contact", "contacts", all.size(), at, contacts, capacity, required);
  });
}

ft_status ft_world_silent(const ft_world* world, ft_silent_body* bodies, size_t capacity,
                          size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAnswer(world); s != FT_OK) return s;
    const auto& all = world->answer.silent;
    const auto at = [&](std::size_t i) { return silentOf(all[i]); };
    return writeList("ft_silent_body", "bodies", all.size(), at, bodies, capacity, required);
  });
}

ft_status ft_world_get_counters(const ft_world* world, ft_world_counters* counters) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedAnswer(world); s != FT_OK) return s;
    return writeStruct(counters, "ft_world_counters", countersOf(world->answer.counters));
  });
}
