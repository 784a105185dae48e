// bindings/c/answer.cpp: the answer of a query's last step.
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "bindings/c/contact.h"
#include "bindings/c/last_step.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"
#include "middleware/events/told_depth.h"

namespace foretouch::c {

ft_contact contactOf(const LinkContact& contact, const Scene& scene) {
  ft_contact c{};
  c.link = contact.link;
  c.verdict = static_cast<std::int32_t>(contact.verdict);
  c.reason = static_cast<std::int32_t>(contact.reason);
  c.toi = contact.toi;
  c.free_until = contact.freeUntil;
  c.separation = contact.separation;
  c.penetration = toldDepth(contact);
  Eigen::Map<Eigen::Vector3d>(c.point_scene) = contact.p_WScene;
  Eigen::Map<Eigen::Vector3d>(c.point_link) = contact.p_WLink;
  Eigen::Map<Eigen::Vector3d>(c.normal) = contact.nhat_SL_W;
  c.triangle = contact.triangle;
  c.object = contact.triangle < 0 ? -1 : scene.object(contact.triangle);
  c.lss = contact.lss;
  c.link_triangle = contact.linkTriangle;
  c.link_feature = static_cast<std::int32_t>(contact.linkFeature);
  c.scene_feature = static_cast<std::int32_t>(contact.sceneFeature);
  return c;
}

ft_contact contactOf(PairContact contact, const Scene& scene) {
  const TriangleId triangle = std::exchange(contact.triangle, -1);
  ft_contact c = contactOf(static_cast<const LinkContact&>(contact), scene);
  c.triangle = triangle;
  return c;
}

namespace {

static_assert(static_cast<int>(Verdict::Clear) == FT_VERDICT_CLEAR);
static_assert(static_cast<int>(Verdict::Contact) == FT_VERDICT_CONTACT);
static_assert(static_cast<int>(Verdict::StartsInContact) == FT_VERDICT_STARTS_IN_CONTACT);
static_assert(static_cast<int>(Verdict::Undecided) == FT_VERDICT_UNDECIDED);
static_assert(static_cast<int>(UndecidedReason::None) == FT_REASON_NONE);
static_assert(static_cast<int>(UndecidedReason::WorkBudget) == FT_REASON_WORK_BUDGET);
static_assert(static_cast<int>(UndecidedReason::Resolution) == FT_REASON_RESOLUTION);
static_assert(static_cast<int>(UndecidedReason::AfterFirst) == FT_REASON_AFTER_FIRST);
static_assert(static_cast<int>(FeatureKind::Vertex) == FT_FEATURE_VERTEX);
static_assert(static_cast<int>(FeatureKind::Edge) == FT_FEATURE_EDGE);
static_assert(static_cast<int>(FeatureKind::Face) == FT_FEATURE_FACE);

ft_status checkedTime(double t) {
  if (t >= 0.0 && t <= 1.0) return FT_OK;
  return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "t: expected 0 to 1, found %g", t);
}

/// Writes `count` contacts; `at(i)` returns the i-th. Precondition: there is room.
template <typename At>
ft_status fillContacts(const Scene& scene, std::size_t count, const At& at, ft_contact* contacts) {
  const auto contact = [&](std::size_t i) { return contactOf(at(i), scene); };
  return writeStructs("ft_contact", count, contact, contacts);
}

/// The same with the check for room.
template <typename At>
ft_status writeContacts(const Scene& scene, std::size_t count, const At& at, ft_contact* contacts,
                        std::size_t capacity, std::size_t* required) {
  const Room room = roomFor(count, contacts, capacity, required, "contacts");
  if (room.status != FT_OK || room.isAsking || count == 0) return room.status;
  return fillContacts(scene, count, at, contacts);
}

ft_transform transformOf(const LinkState& state) {
  ft_transform transform{};
  const Eigen::Quaterniond q(state.R_WL);
  const double wxyz[] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(std::begin(wxyz), std::end(wxyz), transform.rotation);
  Eigen::Map<Eigen::Vector3d>(transform.translation) = state.p_WL;
  Eigen::Map<Eigen::Vector3d>(transform.angular_velocity) = state.w_WL;
  Eigen::Map<Eigen::Vector3d>(transform.velocity) = state.v_WL;
  return transform;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_query_links(const ft_query* query, ft_contact* links, size_t capacity,
                         size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    const auto& all = query->step.answer.links;
    const auto at = [&](std::size_t i) -> const LinkContact& { return all[i]; };
    return writeContacts(query->question->scene(), all.size(), at, links, capacity, required);
  });
}

ft_status ft_query_contacts(const ft_query* query, ft_contact* contacts, size_t capacity,
                            size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    const auto& reported = query->step.reported;
    const auto at = [&](std::size_t i) -> const LinkContact& {
      return query->step.answer.links[slotOf(reported[i])];
    };
    return writeContacts(query->question->scene(), reported.size(), at, contacts, capacity,
                         required);
  });
}

ft_status ft_query_objects(const ft_query* query, ft_contact* contacts, size_t capacity,
                           size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedObjects(query); s != FT_OK) return s;
    const auto& all = query->step.answer.perObject;
    const auto at = [&](std::size_t i) -> const LinkContact& { return all[i]; };
    return writeContacts(query->question->scene(), all.size(), at, contacts, capacity, required);
  });
}

ft_status ft_query_pairs(const ft_query* query, ft_contact* contacts, ft_other_link* others,
                         size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedPairs(query); s != FT_OK) return s;
    const auto& pairs = query->step.answer.pairs;
    const Room room = roomFor(pairs.size(), contacts, capacity, required, "contacts");
    if (room.status != FT_OK || room.isAsking || pairs.empty()) return room.status;
    if (const auto s = needed(others, "others"); s != FT_OK) return s;
    const auto at = [&](std::size_t i) -> const PairContact& { return pairs[i]; };
    const auto s = fillContacts(query->question->scene(), pairs.size(), at, contacts);
    if (s != FT_OK) return s;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      others[i] = {pairs[i].other, pairs[i].otherLss};
    }
    return FT_OK;
  });
}

ft_status ft_motion_transforms(ft_query* query, double t, ft_transform* transforms, size_t capacity,
                               size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    if (const auto s = checkedTime(t); s != FT_OK) return s;
    const auto links = countOf(query->step.motion.numLinks());
    const Room room = roomFor(links, transforms, capacity, required, "transforms");
    if (room.status != FT_OK || room.isAsking) return room.status;
    query->step.motion.statesAt(t, query->states);
    for (std::size_t i = 0; i < links; ++i) transforms[i] = transformOf(query->states[i]);
    return FT_OK;
  });
}

ft_status ft_motion_pose(ft_query* query, double t, double* rotations, double* translations,
                         size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    if (const auto s = checkedTime(t); s != FT_OK) return s;
    query->step.motion.poseAt(t, query->pose);
    return writePose(query->pose, rotations, translations, capacity, required);
  });
}

ft_status ft_touches_at(ft_query* query, int32_t link, double t, int32_t* touches) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(touches, "touches"); s != FT_OK) return s;
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    if (const auto s = checkedTime(t); s != FT_OK) return s;
    const Avatar& avatar = query->avatar->avatar;
    if (link < 0 || link >= avatar.numLinks()) {
      return failure(FT_ERROR_OUT_OF_RANGE, link, "link: expected 0 to %d, found %d",
                     avatar.numLinks() - 1, link);
    }
    if (query->isScratchSuspect) query->scratch = Scratch();
    query->isScratchSuspect = true;
    const bool isTouching = query->question->touchesAt(query->step.motion, link, t, query->scratch);
    query->isScratchSuspect = false;
    *touches = isTouching ? 1 : 0;
    return FT_OK;
  });
}

ft_status ft_query_counters(const ft_query* query, ft_counters* counters) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedStep(query); s != FT_OK) return s;
    const QueryCounters& counted = query->step.answer.counters;
    ft_counters known{};
    known.nodes = counted.nodes;
    known.leaves = counted.leaves;
    known.candidates = counted.candidates;
    known.cluster_steps = counted.clusterSteps;
    known.lane_steps = counted.laneSteps;
    known.part_steps = counted.partSteps;
    known.advancements = counted.advancements;
    known.hierarchy_tests = counted.hierarchyTests;
    known.plane_tests = counted.planeTests;
    known.leaf_tests = counted.leafTests;
    known.states = counted.states;
    known.rung_tests = counted.rungTests;
    return writeStruct(counters, "ft_counters", known);
  });
}
