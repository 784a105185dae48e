// middleware/query/link_options.h: the options of a query as they apply to one link. Not installed.
#pragma once

#include <algorithm>

#include "articulated/avatar.h"
#include "lss/index.h"
#include "middleware/query_options.h"
#include "middleware/surface/link_surface.h"
#include "middleware/surface/skin_parts.h"

namespace foretouch::internal {

/// Above link fidelity.
[[nodiscard]] inline bool isRung(Fidelity fidelity) {
  return fidelity == Fidelity::Limb || fidelity == Fidelity::Avatar ||
         fidelity == Fidelity::Ellipsoid;
}

/// The link's own tolerance and fidelity.
[[nodiscard]] inline double toleranceOf(const QueryOptions& options, LinkId link) {
  return options.linkPolicies.empty() ? options.tolerance
                                      : options.linkPolicies[slotOf(link)].tolerance;
}
[[nodiscard]] inline Fidelity fidelityOf(const QueryOptions& options, LinkId link) {
  return options.linkPolicies.empty() ? options.fidelity
                                      : options.linkPolicies[slotOf(link)].fidelity;
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

/// The link's surface at exact fidelity; null at others.
[[nodiscard]] const LinkSurface* surfaceOf(const QueryOptions& options, LinkId link);
/// The skin, at skinned fidelity; null at others, and for a link that owns none of its triangles.
[[nodiscard]] const SkinParts* skinOf(const QueryOptions& options, LinkId link);

/// The link has something that could touch, at any fidelity.
[[nodiscard]] inline bool hasSurface(const Avatar& avatar, const QueryOptions& options,
                                     LinkId link) {
  return !avatar.lss(link).empty() || skinOf(options, link) != nullptr;
}

}  // namespace foretouch::internal
