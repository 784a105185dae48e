// bindings/c/solid_tick.cpp: what a tick of a solid avatar says, as C has it.
#include "bindings/c/sized_struct.h"
#include "bindings/c/solid_handle.h"
#include "bindings/snake_case.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(SolidState::Placing) == FT_SOLID_PLACING);
static_assert(static_cast<int>(SolidState::Equal) == FT_SOLID_EQUAL);
static_assert(static_cast<int>(SolidState::Following) == FT_SOLID_FOLLOWING);
static_assert(static_cast<int>(SolidState::Sliding) == FT_SOLID_SLIDING);
static_assert(static_cast<int>(SolidState::Held) == FT_SOLID_HELD);
static_assert(static_cast<int>(SolidState::Around) == FT_SOLID_AROUND);
static_assert(static_cast<int>(SolidState::Snapped) == FT_SOLID_SNAPPED);
static_assert(static_cast<int>(SolidJointState::Free) == FT_SOLID_JOINT_FREE);
static_assert(static_cast<int>(SolidJointState::Sliding) == FT_SOLID_JOINT_SLIDING);
static_assert(static_cast<int>(SolidJointState::Held) == FT_SOLID_JOINT_HELD);
static_assert(static_cast<int>(SolidJointState::Lost) == FT_SOLID_JOINT_LOST);
static_assert(static_cast<int>(SolidLimit::None) == FT_SOLID_LIMIT_NONE);
static_assert(static_cast<int>(SolidLimit::Budget) == FT_SOLID_LIMIT_BUDGET);
static_assert(static_cast<int>(SolidLimit::CatchUp) == FT_SOLID_LIMIT_CATCH_UP);
static_assert(static_cast<int>(SolidLimit::Inside) == FT_SOLID_LIMIT_INSIDE);

ft_solid_tick tickOf(const SolidTick& tick) {
  ft_solid_tick c{};
  c.state = static_cast<std::int32_t>(tick.state);
  c.limit = static_cast<std::int32_t>(tick.limit);
  c.is_certified = tick.isCertified ? 1 : 0;
  c.has_appeared = tick.hasAppeared ? 1 : 0;
  c.deviation = tick.deviation;
  c.lift = tick.lift;
  c.clearance = tick.clearance;
  c.snap_in_s = tick.snapInS;
  c.joint_count = tick.joints.size();
  c.contact_count = tick.contacts.size();
  c.way_count = tick.numWay;
  c.queries = tick.counters.queries;
  c.iterations = tick.counters.iterations;
  c.features = tick.counters.features;
  c.rows = tick.counters.rows;
  c.around_queries = tick.counters.aroundQueries;
  c.placing_queries = tick.counters.placingQueries;
  c.work = tick.counters.work;
  return c;
}

ft_solid_joint jointOf(const SolidTick& tick, std::size_t joint) {
  ft_solid_joint c{};
  c.state = static_cast<std::int32_t>(tick.joints[joint]);
  c.deviation = tick.linkDeviation[joint];
  return c;
}

ft_solid_contact solidContactOf(const SolidContact& contact, const Scene& scene) {
  ft_solid_contact c{};
  c.link = contact.link;
  c.lss = contact.lss;
  c.triangle = contact.triangle;
  c.object = contact.triangle < 0 ? -1 : scene.object(contact.triangle);
  c.other = contact.other;
  copyPress(contact, c);
  return c;
}

}  // namespace

ft_status solidFailure(Error error) {
  error.file = snakeCase(error.file);
  return failure(error);
}

ft_status writeTick(const SolidTick& tick, ft_solid_tick* written) {
  return writeStruct(written, "ft_solid_tick", tickOf(tick));
}

ft_status writeJoints(const SolidTick& tick, ft_solid_joint* joints, std::size_t capacity,
                      std::size_t* required) {
  const auto at = [&](std::size_t i) { return jointOf(tick, i); };
  return writeList("ft_solid_joint", "joints", tick.joints.size(), at, joints, capacity, required);
}

ft_status writeContacts(const SolidTick& tick, const Scene& scene, ft_solid_contact* contacts,
                        std::size_t capacity, std::size_t* required) {
  const auto at = [&](std::size_t i) { return solidContactOf(tick.contacts[i], scene); };
  return writeList("ft_solid_contact", "contacts", tick.contacts.size(), at, contacts, capacity,
                   required);
}

ft_status writeWay(const SolidTick& tick, std::size_t index, double* time, double* rotations,
                   double* translations, std::size_t capacity, std::size_t* required) {
  if (index >= tick.numWay) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex,
                   "index: expected a piece of the way, which has %zu, found %zu", tick.numWay,
                   index);
  }
  const auto s = writePose(tick.way[index], rotations, translations, capacity, required);
  if (s == FT_OK && time != nullptr) *time = tick.times[index];
  return s;
}

}  // namespace foretouch::c
