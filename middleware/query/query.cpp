#include "middleware/query/query.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "middleware/query/body.h"
#include "middleware/query/lane_query.h"
#include "middleware/query/link_options.h"
#include "middleware/query/reach.h"
#include "middleware/query/rung_query.h"
#include "middleware/query/scalar_query.h"
#include "middleware/query/scratch_parts.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch {

namespace {

Result<Done> checkedTolerance(double tolerance, LinkId link) {
  if (tolerance >= kMinTolerance && tolerance <= kMaxTolerance) return Done{};
  return Error{ErrorCode::OutOfRange, "tolerance", -1, link, "expected 1e-9 to 1e7 metres"};
}

/// One policy per link, each with a fidelity that answers links one by one.
Result<Done> checkedPolicies(const Avatar& avatar, const QueryOptions& options) {
  if (options.linkPolicies.empty()) return Done{};
  const auto isOfLinks = [](Fidelity fidelity) {
    return fidelity == Fidelity::Link || fidelity == Fidelity::Exact;
  };
  if (!isOfLinks(options.fidelity)) {
    return Error::in("linkPolicies", ErrorCode::Mismatch,
                     std::string("expected none at fidelity ") + toString(options.fidelity) +
                         ": only at link and exact fidelity has each link a surface of its own");
  }
  if (options.linkPolicies.size() != countOf(avatar.numLinks())) {
    return Error::in("linkPolicies", ErrorCode::Mismatch,
                     "expected none, or one per link of the avatar");
  }
  LinkId link = 0;
  for (const LinkPolicy& policy : options.linkPolicies) {
    auto tolerance = checkedTolerance(policy.tolerance, link);
    if (!tolerance.ok()) return tolerance;
    if (!isOfLinks(policy.fidelity)) {
      return Error{ErrorCode::OutOfRange, "linkPolicies", -1, link,
                   "expected link or exact fidelity"};
    }
    ++link;
  }
  return Done{};
}

bool isAnyExact(const QueryOptions& options) {
  const auto& policies = options.linkPolicies;
  if (policies.empty()) return options.fidelity == Fidelity::Exact;
  return std::any_of(policies.begin(), policies.end(),
                     [](const LinkPolicy& policy) { return policy.fidelity == Fidelity::Exact; });
}

Result<Done> checked(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
                     const QueryOptions& options) {
  auto tolerance = checkedTolerance(options.tolerance, -1);
  if (!tolerance.ok()) return tolerance;
  auto policies = checkedPolicies(avatar, options);
  if (!policies.ok()) return policies;
  if (!(options.deadlineUs >= 0.0)) {
    return Error::in("deadline", ErrorCode::OutOfRange, "expected microseconds, at least 0");
  }
  if (motion.numLinks() != avatar.numLinks()) {
    return Error::in(
        "motion", ErrorCode::Mismatch,
        "expected a motion of this avatar's skeleton, found one with a different number of joints");
  }
  if (isAnyExact(options) &&
      (!options.surface || options.surface->numLinks() != avatar.numLinks())) {
    return Error::in("fidelity", ErrorCode::Mismatch,
                     "expected the surface of this avatar, which exact fidelity needs");
  }
  if (options.fidelity == Fidelity::Skinned &&
      (!options.skin || options.skin->numLinks() != avatar.numLinks())) {
    return Error::in("fidelity", ErrorCode::Mismatch,
                     "expected the skin of this avatar, which skinned fidelity needs");
  }
  const auto numObjects = static_cast<ObjectId>(scene.objectNames().size());
  for (const IgnoredPair& pair : options.ignored) {
    if (pair.link < 0 || pair.link >= avatar.numLinks() ||
        pair.object < IgnoredPair::kEveryObject || pair.object >= numObjects) {
      return Error{ErrorCode::OutOfRange, "ignored", -1, pair.link,
                   "expected a link of the avatar and an object of the scene"};
    }
  }
  return Done{};
}

Result<const internal::TriangleCuller*> cullerOf(const Scene& scene, Culler which) {
  if (which == Culler::FlatBvh) {
    return static_cast<const internal::TriangleCuller*>(&scene.parts().bvh);
  }
  FORETOUCH_TRY(const auto built, scene.parts().pointQueryCuller());
  return static_cast<const internal::TriangleCuller*>(built);
}

/// Not for skins, which change shape, nor beyond the number of boxes of a walk.
bool inLanes(const Avatar& avatar, const QueryOptions& options, internal::LaneScratch& lanes) {
  return options.backtracking == Backtracking::Lanes && options.fidelity != Fidelity::Skinned &&
         internal::tableOf(avatar, lanes).size() <= internal::BoxLanes::kMaxBoxes;
}

/// At link, exact or skinned fidelity, by the way that the options choose.
void linkQuery(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
               const QueryOptions& options, const internal::TriangleCuller& culler,
               const internal::WorkMeter& meter, internal::ScratchParts& scratch,
               StepContacts& step) {
  const internal::Body body(avatar, options.ignored);
  if (options.descent == Descent::ByNeed && options.fidelity != Fidelity::Skinned &&
      internal::nothingInReach(internal::tableOf(avatar, scratch.lanes), motion, scene,
                               internal::tolerancesOf(options).largest, step.counters)) {
    for (LinkContact& contact : step.links) internal::answerClear(contact);
    return;
  }
  if (!inLanes(avatar, options, scratch.lanes)) {
    internal::scalarQuery(body, motion, scene, options, culler, meter, scratch, step);
    return;
  }
  internal::LaneQuery(body, internal::tableOf(avatar, scratch.lanes), motion, scene, options,
                      culler, meter, scratch)
      .run(step);
}

/// Every link has an answer.
[[maybe_unused]] bool isAnswered(const StepContacts& step) {
  return std::none_of(step.links.begin(), step.links.end(), [](const LinkContact& contact) {
    return contact.verdict == Verdict::Undecided && contact.reason == UndecidedReason::None;
  });
}

/// Links that touch nothing before the earliest contact of all become AfterFirst, except those
/// without a surface.
void keepFirst(const Avatar& avatar, const QueryOptions& options, StepContacts& step) {
  double first = 1.0;
  bool isTouched = false;
  for (const LinkContact& contact : step.links) {
    if (contact.verdict == Verdict::Clear) continue;
    isTouched = true;
    first = std::min(first, contact.freeUntil);
  }
  if (!isTouched) return;
  for (LinkContact& contact : step.links) {
    if (contact.verdict != Verdict::Clear && contact.freeUntil <= first) continue;
    if (!internal::hasSurface(avatar, options, contact.link)) continue;
    contact = undecidedContact(contact.link, first, UndecidedReason::AfterFirst);
  }
}

}  // namespace

Result<Done> firstContacts(const Avatar& avatar, const ChainMotion& motion, const Scene& scene,
                           const QueryOptions& options, QueryScratch& scratch, StepContacts& step) {
  const internal::WorkMeter meter(options);
  step.counters = {};
  internal::leaveUnanswered(avatar.numLinks(), step.links);
  auto check = checked(avatar, motion, scene, options);
  if (!check.ok()) return check;
  FORETOUCH_TRY(const auto culler, cullerOf(scene, options.culler));
  const auto ask = internal::isRung(options.fidelity) ? internal::rungQuery : linkQuery;
  ask(avatar, motion, scene, options, *culler, meter, scratch.parts(), step);
  FORETOUCH_ASSERT(isAnswered(step));
  if (options.scope == Scope::FirstOfAvatar) keepFirst(avatar, options, step);
  return Done{};
}

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options,
                                   QueryScratch& scratch) {
  StepContacts step;
  FORETOUCH_CHECK(firstContacts(avatar, motion, scene, options, scratch, step));
  return step;
}

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options) {
  QueryScratch scratch;
  return firstContacts(avatar, motion, scene, options, scratch);
}

}  // namespace foretouch
