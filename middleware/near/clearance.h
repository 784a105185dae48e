// middleware/near/clearance.h: how near a motion comes to a scene where nothing is hit: bounds from
// below and from above, when, and where. For an avatar's LSS. The proof: clearance.md. Metres in W;
// t in [0,1] of the motion.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"

namespace foretouch {

struct ClearanceOptions {
  /// `upper - lower` is at most this (m) where doubles resolve it; kMinTolerance to kMaxTolerance.
  /// A tenth of it costs about twice the time.
  double tolerance = kDefaultTolerance;
  /// The search ends there (m): what comes no nearer has this as its lower bound.
  double within = std::numeric_limits<double>::infinity();
  /// The avatar hardly ever leaves this distance from the origin of W along each axis (m); 0: it
  /// may be anywhere in the scene's box. Only for speed: two megabytes keep what is known of
  /// distances there, once there was a question.
  double reach = 0.0;
  std::vector<IgnoredPair> ignored;
};

/// The least separation of a motion from the scene.
struct Clearance {
  /// The separation is never less; 0 where something is touched, or may be.
  double lower = 0.0;
  /// At `t` it is no more; infinite if nothing comes within ClearanceOptions::within.
  double upper = std::numeric_limits<double>::infinity();
  double t = 0.0;
  // At `t`, if `upper` is finite:
  LinkId link = -1;
  std::int32_t lss = -1;  ///< Index among the link's LSS.
  TriangleId triangle = -1;
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();   ///< On the LSS's surface.
  Eigen::Vector3d p_WScene = Eigen::Vector3d::Zero();  ///< On the triangle.
  /// Unit, from the scene to the link; zero if the two meet.
  Eigen::Vector3d nhat_SL_W = Eigen::Vector3d::Zero();
  /// No other place that was looked at is within the tolerance of it: of another link, along
  /// another normal, or at another time. So the least separation has a derivative there. Not
  /// proven: what was left out by its bounds was not looked at.
  bool isAlone = false;
};

namespace internal {
struct ClearancePlan;
}  // namespace internal

/// A question to ask again and again. Checked once; copies are cheap, and any number of threads may
/// ask one, each with a scratch of its own.
class ClearanceQuery {
 public:
  /// Errors: a tolerance or a distance that is out of range, an ignored pair that names no link of
  /// the avatar or no object of the scene.
  static Result<ClearanceQuery> build(const Avatar& avatar, const Scene& scene,
                                      const ClearanceOptions& options = {});

  /// The true separation is in [lower, upper], rounding included. The same for the same motion.
  /// Cannot fail; allocates nothing once scratch has grown. Precondition: a motion of the avatar's
  /// skeleton (asserted).
  [[nodiscard]] Clearance answer(const ChainMotion& motion, Scratch& scratch) const;

  [[nodiscard]] const ClearanceOptions& options() const;

  /// For the library's own sources (middleware/near/clearance_search.h).
  [[nodiscard]] const internal::ClearancePlan& plan() const { return *plan_; }

 private:
  explicit ClearanceQuery(std::shared_ptr<const internal::ClearancePlan> plan)
      : plan_(std::move(plan)) {}
  std::shared_ptr<const internal::ClearancePlan> plan_;
};

}  // namespace foretouch
