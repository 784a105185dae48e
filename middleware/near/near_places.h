// middleware/near/near_places.h: where one LSS, standing still, is near one triangle. Metres, W.
// Not installed.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "lss/lss.h"
#include "middleware/lanes/near_bins.h"
#include "middleware/near/near_features.h"
#include "middleware/scene/flat_edges.h"

namespace foretouch::internal {

/// A sine: a direction is along the normal of a face, or across an edge, that goes on flat to
/// within kFlatSine if it deviates by at most this from it.
inline constexpr double kFlatDirection = 2.0 * kFlatSine;

/// An LSS where it stands.
struct StandingLss {
  LinkId link;
  std::int32_t lss;
  Eigen::Vector3d a, b;
  double radius;
  double reach;     ///< How far is near.
  double rounding;  ///< That of the two ends.
};

/// Between which parts of the two a place is.
enum class NearPart : std::uint8_t { Whole, EndA, EndB, Edge0, Edge1, Edge2 };

/// A feature before its gap is proven.
struct NearPlace {
  NearFeature feature;
  double distance = 0.0;  ///< The axis', as computed.
  /// From the triangle to the axis, of any length: the direction that bins go by.
  Eigen::Vector3d away = Eigen::Vector3d::Zero();
  NearPart part = NearPart::Whole;
  /// The surface has a corner there, or its face holds an end of the axis; else something nearer
  /// stands for it.
  bool stands = true;

  [[nodiscard]] bool isAtEnd() const { return feature.along == 0.0 || feature.along == 1.0; }
};

/// Knows places that cannot win.
class NearFilter {
 public:
  /// False: a place at this distance, which is not 0, with this difference of its two points,
  /// cannot win.
  [[nodiscard]] virtual bool mayWin(const Eigen::Vector3d& difference, double along,
                                    double distance) const = 0;

 protected:
  ~NearFilter() = default;
};

/// The places of one pair; none if the closest points are farther apart than the reach.
struct NearPlaces {
  static constexpr int kMost = 6;
  NearPlace place[kMost];
  int count = 0;
};
/// `filter`: what may be left out; or null.
void findPlaces(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                const FlatEdges& flat, const NearFilter* filter, NearPlaces& places);

/// The place that `source` makes (near_bins.h), which findPlaces() makes as `part`.
[[nodiscard]] NearPlace placeFrom(const StandingLss& lss, const Triangle& triangle, TriangleId id,
                                  const FlatEdges& flat, int source, NearPart part);

/// The closest points alone.
[[nodiscard]] NearPlace closestPlace(const StandingLss& lss, const Triangle& triangle,
                                     TriangleId id, const FlatEdges& flat);

/// A lower bound on the separation at the place.
[[nodiscard]] double provenGap(const StandingLss& lss, const Triangle& triangle,
                               const NearPlace& place);

}  // namespace foretouch::internal
