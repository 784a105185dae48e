// middleware/solid_world/around_plan.h: the question whether a solid avatar meets one kind of body
// around it while both move. Metres in W. Not installed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "articulated/relative_motion.h"
#include "articulated/result.h"
#include "middleware/near/near_features.h"
#include "middleware/pair/query_plan.h"
#include "middleware/pair/side_plan.h"
#include "middleware/query/query.h"
#include "middleware/solid_world/around_body.h"

namespace foretouch::internal {

struct PairAnswer {
  bool isClear = false;
  double share = 0.0;      ///< Share of the motion: free until then.
  bool isInside = false;   ///< They touch at its begin.
  double clearance = 0.0;  ///< Proven lower bound on the separation over the share.
  LinkId link = 0;         ///< The avatar's that meets first, or is deepest inside.
  JointId other = 0;       ///< The chain's joint that it meets.
  double penetration = 0.0;
};

/// Memory of questions; one per thread.
struct AroundScratch {
  Scratch query;
  StepContacts step;
  ChainMotion motion, other;
  Pose from, to, otherFrom, otherTo;  // relative to an origin, or to the mesh
};

/// Immutable.
class AroundPlan {
 public:
  /// Errors: chains that are too deep together.
  static Result<AroundPlan> make(const Avatar& avatar, const AroundKind& kind, double tolerance);

  /// Both move over the same time, from one pair of validated poses to the other. `off`: how far
  /// the poses may be from the truth (m). Allocates nothing once the scratch has grown.
  [[nodiscard]] PairAnswer ask(const Pose& from, const Pose& to, const Pose& otherFrom,
                               const Pose& otherTo, double off, AroundScratch& scratch) const;
  /// For a mesh: what the avatar is near to, in its frame.
  [[nodiscard]] const NearQuery& near() const { return *near_; }

 private:
  AroundPlan(const Avatar& avatar, const AroundKind& kind);
  Result<Done> makeLss(const Avatar& avatar, const AroundKind& kind, const QueryOptions& options);
  Result<Done> makeMesh(const Avatar& avatar, const AroundKind& kind, QueryOptions options);
  void askLss(const Pose& from, const Pose& to, const Pose& otherFrom, const Pose& otherTo,
              const Eigen::Vector3d& origin, AroundScratch& scratch) const;
  void askMesh(const Pose& from, const Pose& to, const Pose& otherFrom, const Pose& otherTo,
               AroundScratch& scratch) const;
  [[nodiscard]] PairAnswer answerOf(const StepContacts& step, double off) const;

  Skeleton skeleton_, otherSkeleton_;
  JointId frame_;  // the mesh's joint, on the other's chain
  // For LSS: the avatar, the other one, and all pairs of the two.
  std::shared_ptr<const SidePlan> one_, other_;
  PairsAsked asked_;
  // For a mesh, all of the avatar, seen from it.
  std::shared_ptr<const QueryPlan> plan_;
  std::optional<RelativeChain> seen_;
  std::vector<LinkId> linkOf_;  // per link there, the avatar's
  std::optional<NearQuery> near_;
};

}  // namespace foretouch::internal
