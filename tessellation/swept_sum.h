// tessellation/swept_sum.h: the boundary of conv{corners} + polytope, face by face, for up to four
// corners on the lattice. Exact; proof: tessellation/swept_surface.md 3. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include "tessellation/ball_polytope.h"

namespace foretouch {

/// The faces of the sum other than facets of the polytope moved to a corner. Corner numbers are
/// indices into the given corners.
struct SumFaces {
  /// The polytope's edge carried from corner `left` to corner `right`: a parallelogram (v,left),
  /// (u,left), (u,right), (v,right), counter-clockwise seen from outside.
  struct Band {
    std::int32_t edge = 0;
    std::uint8_t left = 0, right = 0;
  };
  /// A triangle of corners, moved by a corner of the polytope.
  struct Side {
    std::int32_t corner = 0;
    std::array<std::uint8_t, 3> of{};
  };
  std::vector<Band> bands;
  std::vector<Side> sides;
  /// Per facet of the polytope, the corner that it moves to: the farthest along its normal, of
  /// several the first.
  std::vector<std::uint8_t> facetCorner;
};

/// Sums of one polytope with one set of corners after another; keeps its working memory. O(facets)
/// per sum.
class SweptSum {
 public:
  explicit SweptSum(const BallPolytope& polytope);

  /// Precondition: 1 to 4 corners, apart by less than kMaxLatticeDifference.
  void facesOf(const std::vector<LatticePoint>& corners, SumFaces& faces);

 private:
  void labelFacets(const std::vector<LatticePoint>& corners, std::vector<std::uint8_t>& labels);
  void crossEdges(SumFaces& faces);
  void fillCorners(SumFaces& faces);
  void fill(std::int32_t corner, SumFaces& faces);
  [[nodiscard]] std::uint8_t exactLabel(std::size_t facet) const;
  [[nodiscard]] WideInteger heightOf(std::size_t facet, std::uint8_t corner) const;

  const BallPolytope* polytope_;
  std::vector<double> normalX_, normalY_, normalZ_;
  double largestNormal_ = 0.0;
  std::vector<LatticePoint> apart_;   ///< Corners relative to the first.
  std::vector<std::int32_t> pathOf_;  ///< Per edge: where its labels start in `paths_`, or -1.
  std::vector<std::vector<std::uint8_t>> paths_;
  std::size_t numPaths_ = 0;
  std::vector<std::int32_t> crossed_, touched_;
  std::vector<bool> isTouched_;
  std::vector<std::uint8_t> walk_;
};

}  // namespace foretouch
