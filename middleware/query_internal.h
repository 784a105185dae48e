// middleware/query_internal.h: what the sources of the query share. Not installed.
#pragma once

#include <algorithm>
#include <vector>

#include "middleware/backtracking.h"
#include "middleware/ladder/rung_volumes.h"
#include "middleware/lane_scratch.h"
#include "middleware/query.h"

namespace foretouch {
namespace internal {

/// The objects whose contacts with the link at hand are not asked for.
class IgnoredObjects {
 public:
  /// True if the link is ignored altogether.
  bool collect(const std::vector<IgnoredPair>& ignored, LinkId link) {
    objects_.clear();
    for (const IgnoredPair& pair : ignored) {
      if (pair.link != link) continue;
      if (pair.object == IgnoredPair::kEveryObject) return true;
      objects_.push_back(pair.object);
    }
    std::sort(objects_.begin(), objects_.end());
    return false;
  }
  [[nodiscard]] bool empty() const { return objects_.empty(); }
  [[nodiscard]] bool has(ObjectId object) const {
    return std::binary_search(objects_.begin(), objects_.end(), object);
  }

 private:
  std::vector<ObjectId> objects_;  // ascending
};

/// What queries above link fidelity keep.
struct RungScratch {
  RungVolumes volumes;
  std::vector<std::vector<Lss>> perLink;  // the volumes by their carriers
  LssTable table;
  std::vector<IgnoredPair> ignored;   // of the volumes, by their carriers
  std::vector<std::uint8_t> isAsked;  // per link: not ignored altogether
  std::vector<LinkContact> answers;   // of the volumes
};

/// Above link fidelity.
[[nodiscard]] inline bool isRung(Fidelity fidelity) {
  return fidelity == Fidelity::Limb || fidelity == Fidelity::Avatar ||
         fidelity == Fidelity::Ellipsoid;
}

/// What the link is asked with.
[[nodiscard]] inline double toleranceOf(const QueryOptions& options, LinkId link) {
  return options.linkPolicies.empty()
             ? options.tolerance
             : options.linkPolicies[static_cast<std::size_t>(link)].tolerance;
}
[[nodiscard]] inline Fidelity fidelityOf(const QueryOptions& options, LinkId link) {
  return options.linkPolicies.empty()
             ? options.fidelity
             : options.linkPolicies[static_cast<std::size_t>(link)].fidelity;
}
struct ToleranceRange {
  double least, largest;
};
/// Of all links.
[[nodiscard]] inline ToleranceRange tolerancesOf(const QueryOptions& options) {
  if (options.linkPolicies.empty()) return {options.tolerance, options.tolerance};
  ToleranceRange range{kMaxTolerance, 0.0};
  for (const LinkPolicy& policy : options.linkPolicies) {
    range.least = std::min(range.least, policy.tolerance);
    range.largest = std::max(range.largest, policy.tolerance);
  }
  return range;
}

/// The surface that the link has at exact fidelity; null at others.
[[nodiscard]] const LinkSurface* surfaceOf(const QueryOptions& options, LinkId link);
/// The skin, at skinned fidelity; null at others, and of a link that owns none of it.
[[nodiscard]] const SkinParts* skinOf(const QueryOptions& options, LinkId link);

}  // namespace internal

/// Memory that one thread's queries reuse.
struct QueryScratch::Impl {
  MotionEvaluator states;                     // of the motion at hand
  std::vector<std::vector<LinkState>> nodes;  // per piece boundary, per link
  std::vector<AxisBounds> axisBounds;         // per LSS of the link at hand
  std::vector<Aabb> startBoxes;               // per LSS of the link at hand, at t = 0
  std::vector<Aabb> boxes;                    // per LSS of the link at hand, per piece
  std::vector<TriangleId> found;
  std::vector<internal::Candidate> candidates;
  std::vector<internal::Candidate> atStart;  // those of them at t = 0
  MotionEvaluator evaluator;
  internal::LaneScratch lanes;
  internal::IgnoredObjects ignored;  // of the link at hand
  internal::RungScratch rungs;
};

}  // namespace foretouch
