// middleware/pair/side_plan.h: one side of a question, checked and resolved: an avatar's links, or
// those of one body on a chain of several; and two of them. Not installed.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "lss/index.h"
#include "middleware/pair/pairs_asked.h"
#include "middleware/query_options.h"
#include "middleware/surface/link_surface.h"
#include "middleware/surface/skin_parts.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// What is asked of one link.
struct LinkPlan {
  double tolerance;
  const LinkSurface* surface;  ///< At exact fidelity; null at others.
  const SkinParts* skin;  ///< At skinned fidelity, if the link owns triangles of it; else null.
  bool hasSurface;        ///< It has something that could touch, at any fidelity.
};

struct ToleranceRange {
  double least, largest;
};

struct SidePlan {
  Avatar avatar;
  QueryOptions options;  ///< Surfaces and skins in it outlive the plan's pointers.
  std::vector<LinkPlan> links;
  LssTable table;             ///< The avatar's.
  ToleranceRange tolerances;  ///< Those of all links.

  [[nodiscard]] const LinkPlan& of(LinkId link) const { return links[slotOf(link)]; }

  /// As Query::build(), without a scene. Errors as there.
  static Result<SidePlan> make(const Avatar& avatar, const QueryOptions& options);
};

/// Two sides, and what is asked of them. For own links, both are the same. What it refers to
/// outlives it.
struct PairPlan {
  const SidePlan& one;
  const SidePlan& other;
  const PairsAsked& asked;
  double startShare = 0.0;                           ///< As QueryPlan::startShare.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< Places are given near it, in W.

  [[nodiscard]] bool isOfOwnLinks() const { return &one == &other; }
  [[nodiscard]] double leastTolerance() const;
  [[nodiscard]] double largestTolerance() const;
};

}  // namespace foretouch::internal
