// middleware/lanes/lss_pairs.h: conservative advancement of one moving LSS against many triangles,
// or against spheres around clusters of triangles, each pair in a float lane at its own time. Their
// proofs include rounding (lss_pairs.md); pairs that lanes cannot decide go to the scalar code in
// doubles. Lengths in metres, times as the polynomials' u in [-1,1], derivatives per unit of u. Not
// installed.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <hwy/aligned_allocator.h>
#include <vector>

#include "middleware/lanes/lane_rows.h"
#include "middleware/scene/flat_bvh_lanes.h"
#include "tessellation/lss_polynomials.h"

namespace foretouch::internal {

/// One moving LSS in the kernels' form, relative to its polynomials' origin.
struct LaneLss {
  float a[3][8], b[3][8];  ///< Coefficients of 1, u, .. u^7 of the axis ends.
  float radius;            ///< The LSS's, plus all uncertainty of the ends, rounded up.
  float contactShift;      ///< Twice the sum of both radii, with that uncertainty and without,
                           ///< rounded down.
  float accelerationA, accelerationB;
  float speedSlack;  ///< The largest rounding error of a speed along a unit direction.
  float extent;      ///< |a(u)| and |b(u)| are at most this.
  float reach;       ///< The radius plus the LSS's share of a plane's rounding.
};
/// `lssRadius`: that of the LSS itself.
[[nodiscard]] LaneLss laneLss(const LssPolynomials& polynomials, double lssRadius);

/// The separations (m) at which lanes change course; floor < handOver.
struct LaneTolerances {
  float floor;     ///< No step goes below this.
  float handOver;  ///< If no more than this is proven, the scalar code takes over.
  float contact;   ///< If the separation is provably at most this, the scalar code finds contact.
};

/// The pairs that lanes leave, in no order: proven apart (by the floor, after the first instant)
/// before `time`, from which the scalar code must look. Rows are longer than `count`.
struct HandedOver {
  std::vector<std::int32_t> key;
  std::vector<float> time;
  std::vector<float> gap;  ///< A lower bound of the separation at `time`, or 0 if none is known.
  std::size_t count = 0;
};

/// Some triangles of a leaf: bit i of `triangles` is the i-th. Known to be apart before `start`.
struct LeafPart {
  const BvhLeaf* leaf;
  std::uint8_t triangles;
  float start;
};

struct FloatBox {
  float lower[3], upper[3];
};

/// Pairs of one LSS as structure of arrays; keeps its memory.
class PairLanes {
 public:
  [[nodiscard]] std::size_t count() const { return count_; }

  /// Triangles of the tree's leaves whose boxes meet `box`, which is in the tree's frame; each
  /// vertex is off by at most `vertexRounding`, `origin` is the polynomials' origin in the tree's
  /// frame. Keys are the triangles' ids.
  void addTriangles(const LaneLss& lss, const LeafPart* parts, std::size_t numParts,
                    const FloatBox& box, const float* origin, double vertexRounding);
  /// Replaces the pairs by spheres that contain clusters' triangles, rounding included: those of
  /// clusters[which[i]], with key i. `which` can be read kMaxLanes beyond `count`.
  void setSpheres(const LaneLss& lss, const Cluster* clusters, const std::int32_t* which,
                  std::size_t count, const float* origin, float start);

  /// Advances every pair until it is done (u = 1), handed over, or past `best`: the earliest time
  /// known at which some pair is certainly in contact, which this call may lower. Leaves no pairs.
  /// Returns the number of evaluations.
  std::uint64_t advanceTriangles(const LaneLss& lss, const LaneTolerances& tolerances, float& best,
                                 HandedOver& handed);
  /// At most `rounds` steps of every pair; hands over all pairs that are then not done.
  std::uint64_t advanceSpheres(const LaneLss& lss, const LaneTolerances& tolerances, int rounds,
                               float best, HandedOver& handed);

 private:
  static constexpr std::size_t kRows = 11;
  /// Room for `extra` more pairs.
  void reserve(std::size_t extra);
  [[nodiscard]] HandedRows room(HandedOver& handed) const;
  [[nodiscard]] LaneRows rows();

  [[nodiscard]] float* row(std::size_t k) const { return data_.get() + k * capacity_; }

  hwy::AlignedFreeUniquePtr<float[]> data_;  // kRows rows: coordinates, reach, time
  hwy::AlignedFreeUniquePtr<std::int32_t[]> keys_;
  std::size_t capacity_ = 0, count_ = 0;
};

}  // namespace foretouch::internal
