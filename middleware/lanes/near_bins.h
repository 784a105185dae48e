// middleware/lanes/near_bins.h: which triangles near an LSS can still win a bin of the reduction
// (near_reduction.h), in lanes of doubles. A place is made as near_places.cpp makes it, operation
// for operation and bit for bit, so what is refused here would have lost there (near_bins.md).
// Lengths in metres. Constants and plain arrays only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>

namespace foretouch::internal {

/// A share of a length: closer to an end than this is at it.
inline constexpr double kAtEnd = 1e-9;
/// A share of the pair's extent: below it, the difference of the closest points is noise.
inline constexpr double kNoisyDifference = 1e-9;

/// Bins of directions and places on the axis, and the distance that a place must not exceed to win.
struct NearBins {
  /// Six faces of a cube, three by three on each; quarters of the axis; faces, and the rest.
  static constexpr std::size_t kDirections = 54, kQuarters = 4, kKinds = 2;
  static constexpr std::size_t kCount = kDirections * kQuarters * kKinds;
  /// Bounds of quarters lie off the halves where things that people make have their edges: rounding
  /// then does not move these from bin to bin.
  static constexpr double kQuarterBounds[] = {0.27, 0.53, 0.79};

  double toBins[3][3];   ///< Turns directions of W into the bins' frame.
  double limit[kCount];  ///< Squared (m^2); infinity: the bin is empty.
};

/// An LSS where it stands, in W.
struct PlacedLss {
  double a[3], b[3];
  double squaredReach;   ///< The axis' (m^2): the radius and what counts as near.
  double nearParallel;   ///< Squared sine of axis and edge from which on their crossing is trusted.
  double flatDirection;  ///< Sine within which a direction is along the normal of a flat surface.
};

/// Triangles that are looked at together. Unused places repeat another one.
struct PlaceBlock {
  static constexpr std::size_t kSize = 8;
  alignas(64) double vertex[3][3][kSize];  ///< [corner][axis][triangle], in W.
  alignas(64) std::int64_t flat[kSize];    ///< FlatEdges::bitsOf().
};

/// Where a place of an LSS and a triangle comes from: the sphere at an end of the axis, or an edge.
inline constexpr int kPlaceSources = 5;  // ends a and b, edges 0 to 2

/// Bit i: for triangle i.
struct PlaceChoice {
  unsigned unsure;                  ///< It takes more than lanes to say which places may win.
  unsigned may[kPlaceSources];      ///< The place from there may win; without what is unsure.
  unsigned isWhole[kPlaceSources];  ///< Where the closest points of the two are.
};
[[nodiscard]] PlaceChoice mayWinBins(const PlacedLss& lss, const NearBins& bins,
                                     const PlaceBlock& block);

}  // namespace foretouch::internal
