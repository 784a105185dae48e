// middleware/solid_world/pair_plan.h: the question whether a solid avatar meets one kind of body
// around it while both move. Metres in W. Not installed.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "articulated/relative_motion.h"
#include "articulated/result.h"
#include "middleware/query/near_features.h"
#include "middleware/query/query.h"
#include "middleware/query/query_plan.h"
#include "middleware/solid_world/around_body.h"

namespace foretouch::internal {

struct PairAnswer {
  bool isClear = false;
  double share = 0.0;      ///< Of the motion: free until then.
  bool isInside = false;   ///< They touch at its begin.
  double clearance = 0.0;  ///< Proven lower bound on the separation over the share.
  LinkId link = 0;         ///< The avatar's that meets first, or is deepest inside.
  JointId other = 0;       ///< The chain's joint that it meets.
  double penetration = 0.0;
};

/// Memory of questions; one per thread.
struct PairScratch {
  QueryScratch query;
  StepContacts step;
  ChainMotion motion;
  Pose from, to, relativeFrom, relativeTo;
};

/// Immutable.
class PairPlan {
 public:
  /// Errors: chains that are too deep together.
  static Result<PairPlan> make(const Avatar& avatar, const AroundKind& kind, double tolerance);

  /// Both move over the same time, from one pair of validated poses to the other. `off`: how far
  /// the poses may be from the truth (m). Allocates nothing once the scratch has grown.
  [[nodiscard]] PairAnswer ask(const Pose& from, const Pose& to, const Pose& otherFrom,
                               const Pose& otherTo, double off, PairScratch& scratch) const;
  /// Of a mesh: what the avatar is near to, in its frame.
  [[nodiscard]] const NearQuery& near() const { return *near_; }

 private:
  PairPlan(const Avatar& avatar, const AroundKind& kind);
  Result<Done> makeLss(const Avatar& avatar, const AroundKind& kind, double tolerance);
  Result<Done> makeMesh(const Avatar& avatar, const AroundKind& kind, double tolerance);
  void join(const Pose& one, const Pose& other, const Eigen::Vector3d& origin, Pose& both) const;
  [[nodiscard]] PairAnswer answerOf(const StepContacts& step, double off,
                                    PairScratch& scratch) const;

  std::int32_t numOwn_;  // links of the avatar, which come first
  std::int32_t frame_;   // of a mesh, on the chain of both
  std::shared_ptr<const QueryPlan> plan_;
  std::optional<Skeleton> skeleton_;    // of both
  std::optional<RelativeChain> chain_;  // seen from the mesh
  std::vector<LinkId> linkOf_;          // per link there, the avatar's
  std::optional<NearQuery> near_;
};

}  // namespace foretouch::internal
