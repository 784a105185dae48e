// middleware/near/near_features.h: what links are near to at one pose: for a solver of contacts,
// for haptics and warnings. Lengths in metres in the world W.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "middleware/contact.h"
#include "middleware/exact/feature.h"
#include "middleware/query_options.h"
#include "middleware/scene/scene.h"
#include "middleware/scratch.h"

namespace foretouch {

/// One place where an LSS of a link is near the scene.
struct NearFeature {
  LinkId link = 0;
  std::int32_t lss = -1;  ///< Index among the link's LSS.
  TriangleId triangle = -1;
  /// What of the triangle holds p_WScene. Face also where an end of the axis is right above an
  /// edge or a vertex along the face's own normal, and the surface goes on flat.
  FeatureKind feature = FeatureKind::Face;
  double along = 0.0;  ///< Where the axis' nearest point is: share of the way from end a to end b.
  /// Lower bound on the separation at this place: of the whole LSS from the triangle, of the sphere
  /// at one end of the axis from it, or of the LSS from one of its edges. Rounded down; below zero
  /// where the two overlap: the axis' distance less the radius.
  double gap = 0.0;
  Eigen::Vector3d p_WScene = Eigen::Vector3d::Zero();  ///< On the triangle.
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();   ///< On the LSS's surface.
  /// Unit, from the scene to the link. Where the axis passes through the triangle: the face's
  /// normal, to the side of the axis' longer part. Zero if the two meet so that there is none.
  Eigen::Vector3d nhat_SL_W = Eigen::Vector3d::Zero();
};

/// Which of the features within reach an answer holds.
enum class NearDetail : std::uint8_t {
  Reduced,  ///< What a solver of contacts needs (NearQuery::answer()).
  All,      ///< Each LSS and triangle: no bound on their number.
  Nearest,  ///< The nearest one of each link.
};

/// Where a link's features lie among NearFeatures::features.
struct NearRange {
  std::size_t first = 0, count = 0;
  bool hadMore = false;  ///< More than kMostNearPerLink were left: these are the nearest.
};
/// The most features of one link that Reduced leaves.
inline constexpr std::size_t kMostNearPerLink = 256;

struct NearFeatures {
  std::vector<NearFeature> features;  ///< By link, LSS, gap and triangle.
  std::vector<NearRange> links;       ///< One per link of the avatar, in order.
  QueryCounters counters;             ///< `candidates`: triangles looked at; `advancements`: in
                                      ///< doubles.
};

namespace internal {
struct NearPlan;
}  // namespace internal

/// A question to ask again and again: what of a scene are links of an avatar near to? By their LSS.
/// Checked once; copies are cheap, and any number of threads may ask one NearQuery, each with
/// scratch memory of its own.
class NearQuery {
 public:
  /// Errors: an ignored pair that names no link of the avatar or no object of the scene. O(links +
  /// LSS); the first one of a scene also finds its flat edges: O(triangles log triangles).
  static Result<NearQuery> build(const Avatar& avatar, const Scene& scene,
                                 const std::vector<IgnoredPair>& ignored = {});

  [[nodiscard]] const Avatar& avatar() const;
  [[nodiscard]] const Scene& scene() const;

  /// Replaces `near` by the features within reach. `states`: one per link (ChainMotion::statesAt()
  /// at some t, or kinematics of your own); `reach`: one per link, at most kMaxCoordinate; below 0:
  /// the link is not asked. Every pair of an LSS and a triangle that is left out of
  /// NearDetail::All is proven farther apart than the reach, rounding included.
  ///
  /// A pair has a feature for its closest points, and one each for the sphere at either end of the
  /// axis and for each edge that the axis crosses, as far as these differ from the closest points
  /// and are within reach: what lies on a face is held at both ends, what lies across an edge is
  /// free to tip.
  ///
  /// Reduced: edges and vertices inside a flat surface have none, nor have vertices on a straight
  /// edge, where triangles share their vertices bit for bit. Of the rest, the
  /// nearest per LSS in each bin: 54 of direction, 4 along the axis, faces apart. Of these, nearest
  /// first, one is dropped that a nearer one stands for: the same direction within 2 cm of it, or
  /// an edge in the plane of faces that keep the LSS above it. The answer does not depend on the
  /// order of the triangles, and hardly on how a flat surface is cut into them. The reduction
  /// proposes what to mind; it proves nothing about what it drops.
  ///
  /// Cannot fail; allocates nothing once scratch and `near` have grown. Preconditions (asserted):
  /// one finite state and one reach per link, none NaN. O(nodes + triangles near).
  void answer(const std::vector<LinkState>& states, const std::vector<double>& reach,
              Scratch& scratch, NearFeatures& near, NearDetail detail = NearDetail::Reduced) const;
  /// At a pose that validatedPose() made for the avatar's skeleton (asserted), one reach for all.
  void answer(const Pose& pose, double reach, Scratch& scratch, NearFeatures& near,
              NearDetail detail = NearDetail::Reduced) const;

 private:
  explicit NearQuery(std::shared_ptr<const internal::NearPlan> plan) : plan_(std::move(plan)) {}
  std::shared_ptr<const internal::NearPlan> plan_;
};

}  // namespace foretouch
