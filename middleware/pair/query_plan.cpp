#include "middleware/pair/query_plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "middleware/pair/leaving.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "middleware/scene/scene_parts.h"

namespace foretouch::internal {
namespace {

Result<Done> checkedTolerance(double tolerance, LinkId link) {
  if (tolerance >= kMinTolerance && tolerance <= kMaxTolerance) return Done{};
  return Error{ErrorCode::OutOfRange, "tolerance", -1, link, "expected 1e-9 to 1e7 metres"};
}

/// One policy per link, each with a fidelity that answers links one by one.
Result<Done> checkedPolicies(const Avatar& avatar, const QueryOptions& options) {
  if (options.linkPolicies.empty()) return Done{};
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
    FORETOUCH_CHECK(checkedTolerance(policy.tolerance, link));
    if (!isOfLinks(policy.fidelity)) {
      return Error{ErrorCode::OutOfRange, "linkPolicies", -1, link,
                   "expected link or exact fidelity"};
    }
    ++link;
  }
  return Done{};
}

bool hasExactPolicy(const QueryOptions& options) {
  return std::any_of(options.linkPolicies.begin(), options.linkPolicies.end(),
                     [](const LinkPolicy& own) { return own.fidelity == Fidelity::Exact; });
}

Result<Done> checkedSurfaces(const Avatar& avatar, const QueryOptions& options) {
  const bool isAnyExact =
      options.linkPolicies.empty() ? options.fidelity == Fidelity::Exact : hasExactPolicy(options);
  if (isAnyExact && (!options.surface || options.surface->numLinks() != avatar.numLinks())) {
    return Error::in("fidelity", ErrorCode::Mismatch,
                     "expected the surface of this avatar, which exact fidelity needs");
  }
  if (options.fidelity == Fidelity::Skinned &&
      (!options.skin || options.skin->numLinks() != avatar.numLinks())) {
    return Error::in("fidelity", ErrorCode::Mismatch,
                     "expected the skin of this avatar, which skinned fidelity needs");
  }
  return Done{};
}

Result<Done> checkedStartShare(const QueryPlan& plan, bool areLinksInLanes) {
  if (plan.startShare == 0.0) return Done{};
  const auto refused = [](ErrorCode code, std::string text) {
    return Error::in("startShare", code, std::move(text));
  };
  if (!(plan.startShare > 0.0 && plan.startShare <= kMostStartShare)) {
    return refused(ErrorCode::OutOfRange, "expected 0 to 0.5");
  }
  if (!areLinksInLanes) {
    return refused(ErrorCode::Mismatch,
                   std::string("expected 0 at fidelity ") + toString(plan.options.fidelity));
  }
  if (plan.options.passSeparating) {
    return refused(ErrorCode::Mismatch, "expected 0 with passSeparating, which it includes");
  }
  return Done{};
}

/// What only lanes answer, link by link.
Result<Done> checkedLanes(const QueryPlan& plan) {
  const QueryOptions& options = plan.options;
  const bool areLinksInLanes = plan.inLanes && isOfLinks(options.fidelity);
  if (options.passSeparating && !areLinksInLanes) {
    return Error::in("passSeparating", ErrorCode::Mismatch,
                     std::string("expected false at fidelity ") + toString(options.fidelity));
  }
  FORETOUCH_CHECK(checkedStartShare(plan, areLinksInLanes));
  if (options.scope != Scope::EveryObject) return Done{};
  if (!areLinksInLanes) {
    return Error::in(
        "scope", ErrorCode::Mismatch,
        std::string("expected links or avatar at fidelity ") + toString(options.fidelity));
  }
  if (options.workBudget != QueryOptions{}.workBudget || std::isfinite(options.deadlineUs)) {
    return Error::in("scope", ErrorCode::Mismatch,
                     "expected links or avatar with a budget: it may end before the last object");
  }
  return Done{};
}

/// Own links, where they are asked.
Result<Done> checkedSelf(const Avatar& avatar, const QueryOptions& options) {
  if (!options.self) return Done{};
  const auto refused = [](std::string text) {
    return Error::in("self", ErrorCode::Mismatch, std::move(text));
  };
  if (options.self->avatarIdentity() != avatar.identity()) {
    return refused("expected the pair rules of this avatar");
  }
  if (!isOfLinks(options.fidelity)) {
    return refused(std::string("expected link or exact fidelity, found ") +
                   toString(options.fidelity) + ", which has no surface per link");
  }
  if (options.scope == Scope::FirstOfAvatar) {
    return refused("expected scope links or objects: own pairs are answered one by one");
  }
  const bool mayBeExact = options.fidelity == Fidelity::Exact || hasExactPolicy(options);
  if (mayBeExact && !options.self->radii().empty()) {
    return refused(
        "expected rules without pair radii at exact fidelity: a smaller LSS does not "
        "hold its link's mesh");
  }
  return Done{};
}

Result<Done> checked(const Avatar& avatar, const QueryOptions& options) {
  FORETOUCH_CHECK(checkedTolerance(options.tolerance, -1));
  FORETOUCH_CHECK(checkedPolicies(avatar, options));
  if (!(options.deadlineUs >= 0.0)) {
    return Error::in("deadline", ErrorCode::OutOfRange, "expected microseconds, at least 0");
  }
  FORETOUCH_CHECK(checkedSurfaces(avatar, options));
  return checkedSelf(avatar, options);
}

/// Keeps the scene.
std::shared_ptr<const TriangleCuller> cullerOf(const Scene& scene) {
  const auto kept = std::make_shared<const Scene>(scene);
  return {kept, &kept->parts().bvh};
}

/// The skin's own, unless it was built for another avatar.
std::shared_ptr<const BlendTable> blendsOf(const Avatar& avatar, const SkinnedSurface& skin) {
  if (skin.parts().avatarIdentity == avatar.identity()) return skin.parts().blends;
  return std::make_shared<const BlendTable>(avatar, skin.parts());
}

LinkPlan planOf(const Avatar& avatar, const QueryOptions& options, LinkId link) {
  const auto i = slotOf(link);
  const LinkPolicy own = options.linkPolicies.empty()
                             ? LinkPolicy{options.tolerance, options.fidelity}
                             : options.linkPolicies[i];
  LinkPlan plan{own.tolerance, nullptr, nullptr, !avatar.lss(link).empty()};
  if (own.fidelity == Fidelity::Exact) plan.surface = options.surface->parts().links[i].get();
  if (own.fidelity == Fidelity::Skinned && options.skin->parts().numTriangles(link) > 0) {
    plan.skin = &options.skin->parts();
    plan.hasSurface = true;
  }
  return plan;
}

}  // namespace

Result<Done> checkedIgnored(const Avatar& avatar, const Scene& scene,
                            const std::vector<IgnoredPair>& ignored) {
  const auto numObjects = static_cast<ObjectId>(scene.objectNames().size());
  for (const IgnoredPair& pair : ignored) {
    if (pair.link < 0 || pair.link >= avatar.numLinks() ||
        pair.object < IgnoredPair::kEveryObject || pair.object >= numObjects) {
      return Error{ErrorCode::OutOfRange, "ignored", -1, pair.link,
                   "expected a link of the avatar and an object of the scene"};
    }
  }
  return Done{};
}

Result<SidePlan> SidePlan::make(const Avatar& avatar, const QueryOptions& options) {
  FORETOUCH_CHECK(checked(avatar, options));
  SidePlan plan{avatar, options, {}, LssTable(avatar), {kMaxTolerance, kMinTolerance}};
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    plan.links.push_back(planOf(avatar, plan.options, link));
    plan.tolerances.least = std::min(plan.tolerances.least, plan.links.back().tolerance);
    plan.tolerances.largest = std::max(plan.tolerances.largest, plan.links.back().tolerance);
  }
  return plan;
}

double PairPlan::leastTolerance() const {
  return std::min(one.tolerances.least, other.tolerances.least);
}

double PairPlan::largestTolerance() const {
  return std::max(one.tolerances.largest, other.tolerances.largest);
}

Result<QueryPlan> QueryPlan::make(const Avatar& avatar, const Scene& scene,
                                  const QueryOptions& options, double startShare) {
  FORETOUCH_TRY(auto side, SidePlan::make(avatar, options));
  FORETOUCH_CHECK(checkedIgnored(avatar, scene, options.ignored));
  QueryPlan plan{std::move(side), scene,   nullptr, {},        false, {},
                 cullerOf(scene), nullptr, nullptr, startShare};
  if (plan.tolerances.least != plan.tolerances.largest) {
    for (const LinkPlan& link : plan.links) plan.margins.push_back(link.tolerance);
  }
  if (options.fidelity == Fidelity::Skinned) plan.blends = blendsOf(avatar, *options.skin);
  // Not beyond the number of boxes of a walk.
  plan.inLanes = plan.laneTable().size() <= BoxLanes::kMaxBoxes;
  FORETOUCH_CHECK(checkedLanes(plan));
  if (options.self) plan.self = PairsAsked(avatar, plan.table, *options.self);
  return plan;
}

}  // namespace foretouch::internal
