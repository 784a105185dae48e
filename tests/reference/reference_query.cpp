#include "tests/reference/reference_query.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "articulated/try.h"
#include "middleware/pair/query_plan.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "tests/reference/chain_piece.h"
#include "tests/reference/point_query_culler.h"
#include "tests/reference/reach.h"
#include "tests/reference/rung_query.h"

namespace foretouch {
namespace {

bool isExactAnywhere(const internal::QueryPlan& plan) {
  return std::any_of(plan.links.begin(), plan.links.end(),
                     [](const internal::LinkPlan& link) { return link.surface != nullptr; });
}

/// What asks link by link is not asked of volumes that cover several.
Result<Done> checkedRung(const QueryOptions& options, Rung rung) {
  const auto refused = [rung](const char* option, const std::string& expected) {
    return Error::in(option, ErrorCode::Mismatch,
                     "expected " + expected + " at fidelity " + toString(rung));
  };
  if (options.fidelity != Fidelity::Link) return refused("fidelity", "link");
  if (!options.linkPolicies.empty()) return refused("linkPolicies", "none");
  if (options.passSeparating) return refused("passSeparating", "false");
  if (options.scope == Scope::EveryObject) return refused("scope", "links or avatar");
  if (options.self) return refused("self", "none");
  return Done{};
}

/// A way that the fidelity or the rung does not have is refused, never passed over.
Result<Done> checked(const internal::QueryPlan& plan, const ReferenceOptions& reference) {
  const Fidelity fidelity = plan.options.fidelity;
  const std::string found = std::string(" at fidelity ") +
                            (reference.rung ? toString(*reference.rung) : toString(fidelity));
  if (reference.rung) FORETOUCH_CHECK(checkedRung(plan.options, *reference.rung));
  if (reference.leafMethod == LeafMethod::Cubics && !isExactAnywhere(plan)) {
    return Error::in(
        "leafMethod", ErrorCode::Mismatch,
        "expected advancement" + found + ": only exact fidelity follows pairs of triangles");
  }
  if (reference.descent == Descent::ByNeed && (reference.rung || !internal::isOfLinks(fidelity))) {
    return Error::in("descent", ErrorCode::Mismatch,
                     "expected straight" + found + ": by need is for link and exact fidelity");
  }
  if (!reference.backtracking) return Done{};
  if (reference.rung == Rung::Ellipsoid) {
    return Error::in("backtracking", ErrorCode::Mismatch,
                     "expected none" + found + ", which has one way alone");
  }
  if (*reference.backtracking == Backtracking::Lanes && !plan.inLanes) {
    return Error::in("backtracking", ErrorCode::Mismatch,
                     "expected scalar" + found + ": lanes answer no avatars of more than " +
                         std::to_string(internal::BoxLanes::kMaxBoxes) + " LSS");
  }
  return Done{};
}

}  // namespace

const char* toString(Culler culler) {
  switch (culler) {
    case Culler::FlatBvh: return "flat";
    case Culler::PointQuery: return "point-query";
  }
  return "flat";
}

const char* toString(Backtracking backtracking) {
  switch (backtracking) {
    case Backtracking::Lanes: return "lanes";
    case Backtracking::Scalar: return "scalar";
  }
  return "lanes";
}

const char* toString(LeafMethod method) {
  switch (method) {
    case LeafMethod::Advancement: return "advancement";
    case LeafMethod::Cubics: return "cubics";
  }
  return "advancement";
}

const char* toString(Descent descent) {
  switch (descent) {
    case Descent::Straight: return "straight";
    case Descent::ByNeed: return "by-need";
  }
  return "straight";
}

Result<Query> buildReference(const Avatar& avatar, const Scene& scene, const QueryOptions& options,
                             const ReferenceOptions& reference) {
  FORETOUCH_TRY(auto plan, internal::QueryPlan::make(avatar, scene, options));
  if (reference.rung) plan.inLanes = true;  // one box per limb at most: never too many
  FORETOUCH_CHECK(checked(plan, reference));
  if (reference.culler == Culler::PointQuery) {
    FORETOUCH_TRY(plan.culler, internal::PointQueryCuller::build(scene));
  }
  if (reference.leafMethod == LeafMethod::Cubics) {
    plan.leafProver = std::make_shared<const internal::CubicsProver>();
  }
  if (reference.descent == Descent::ByNeed) {
    plan.stepAnswerer =
        std::make_shared<const internal::ReachProver>(avatar, scene, plan.tolerances.largest);
  }
  if (reference.rung) {
    plan.stepAnswerer = std::make_shared<const internal::RungAnswerer>(*reference.rung);
  }
  if (reference.backtracking == Backtracking::Scalar) plan.inLanes = false;
  return Query(std::make_shared<const internal::QueryPlan>(std::move(plan)));
}

Result<StepContacts> firstContacts(const Avatar& avatar, const ChainMotion& motion,
                                   const Scene& scene, const QueryOptions& options,
                                   const ReferenceOptions& reference) {
  FORETOUCH_TRY(const auto query, buildReference(avatar, scene, options, reference));
  if (motion.numLinks() != avatar.numLinks()) {
    return Error::in("motion", ErrorCode::Mismatch, "expected a motion of this avatar's skeleton");
  }
  Scratch scratch;
  return query.answer(motion, scratch);
}

}  // namespace foretouch
