#include "tessellation/swept_sum.h"

#include <algorithm>
#include <cmath>

#include "lss/assert.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

/// A dot product of three terms, each factor rounded once: below 8 units of roundoff of the sum of
/// magnitudes; a difference of two such and their comparison stay below twice that.
constexpr double kDotRounding = 32.0 * kUnitRoundoff;

using Walk = std::vector<std::uint8_t>;

/// Removes steps that a closed walk takes back at once.
void reduceWalk(Walk& walk) {
  Walk kept;
  for (const std::uint8_t corner : walk) {
    if (!kept.empty() && kept.back() == corner) continue;
    if (kept.size() >= 2 && kept[kept.size() - 2] == corner) {
      kept.pop_back();
    } else {
      kept.push_back(corner);
    }
  }
  std::size_t first = 0, last = kept.size();  // the closed walk is kept[first, last)
  while (last - first >= 2) {
    if (kept[first] == kept[last - 1]) {
      --last;
    } else if (last - first >= 3 && kept[first + 1] == kept[last - 1]) {
      ++first;
    } else if (last - first >= 3 && kept[last - 2] == kept[first]) {
      --last;
    } else {
      break;
    }
  }
  walk.assign(kept.begin() + static_cast<std::ptrdiff_t>(first),
              kept.begin() + static_cast<std::ptrdiff_t>(last));
}

}  // namespace

SweptSum::SweptSum(const BallPolytope& polytope)
    : polytope_(&polytope),
      pathOf_(polytope.edges.size(), -1),
      isTouched_(polytope.corners.size(), false) {
  for (const BallPolytope::Facet& facet : polytope.facets) {
    normalX_.push_back(static_cast<double>(facet.normal.x));
    normalY_.push_back(static_cast<double>(facet.normal.y));
    normalZ_.push_back(static_cast<double>(facet.normal.z));
    largestNormal_ = std::max({largestNormal_, std::abs(normalX_.back()), std::abs(normalY_.back()),
                               std::abs(normalZ_.back())});
  }
}

WideInteger SweptSum::heightOf(std::size_t facet, std::uint8_t corner) const {
  return exactDot(polytope_->facets[facet].normal, apart_[corner]);
}

std::uint8_t SweptSum::exactLabel(std::size_t facet) const {
  std::uint8_t best = 0;
  for (std::uint8_t i = 1; i < apart_.size(); ++i) {
    if (heightOf(facet, i) > heightOf(facet, best)) best = i;
  }
  return best;
}

void SweptSum::labelFacets(const std::vector<LatticePoint>& corners,
                           std::vector<std::uint8_t>& labels) {
  apart_.clear();
  for (const LatticePoint& corner : corners) apart_.push_back(corner - corners[0]);
  double x[4] = {}, y[4] = {}, z[4] = {};
  double extent = 0.0;
  for (std::size_t i = 0; i < apart_.size(); ++i) {
    x[i] = static_cast<double>(apart_[i].x);
    y[i] = static_cast<double>(apart_[i].y);
    z[i] = static_cast<double>(apart_[i].z);
    extent = std::max(extent, std::abs(x[i]) + std::abs(y[i]) + std::abs(z[i]));
  }
  const double doubt = kDotRounding * largestNormal_ * extent;
  labels.resize(polytope_->facets.size());
  for (std::size_t f = 0; f < labels.size(); ++f) {
    double best = 0.0, second = -std::numeric_limits<double>::infinity();
    std::uint8_t label = 0;
    for (std::uint8_t i = 1; i < corners.size(); ++i) {
      const double height = normalX_[f] * x[i] + normalY_[f] * y[i] + normalZ_[f] * z[i];
      if (height > best) {
        second = best;
        best = height;
        label = i;
      } else {
        second = std::max(second, height);
      }
    }
    labels[f] = best - second > doubt ? label : exactLabel(f);
  }
}

/// Along an edge's arc of normals the heights of the corners are linear: which of them is highest
/// changes from line to line of their upper envelope.
void SweptSum::crossEdges(SumFaces& faces) {
  numPaths_ = 0;
  for (std::size_t e = 0; e < polytope_->edges.size(); ++e) {
    const BallPolytope::Edge& edge = polytope_->edges[e];
    const auto left = static_cast<std::size_t>(edge.left);
    const auto right = static_cast<std::size_t>(edge.right);
    const std::uint8_t target = faces.facetCorner[right];
    std::uint8_t now = faces.facetCorner[left];
    if (now == target) continue;
    if (paths_.size() == numPaths_) paths_.emplace_back();
    Walk& path = paths_[numPaths_];
    path.assign(1, now);
    while (now != target) {
      std::uint8_t next = target;
      WideInteger nextLag = heightOf(left, now) - heightOf(left, target);
      WideInteger nextGain = heightOf(right, target) - heightOf(right, now);
      for (std::uint8_t i = 0; i < apart_.size(); ++i) {
        const WideInteger gain = heightOf(right, i) - heightOf(right, now);
        if (i == now || i == target || gain <= 0) continue;
        const WideInteger lag = heightOf(left, now) - heightOf(left, i);
        // It overtakes at lag / (lag + gain); of two at once, the one that ends higher.
        const int order = signOfDifferenceOfProducts(lag, nextGain, nextLag, gain);
        if (order < 0 || (order == 0 && gain > nextGain)) {
          next = i;
          nextLag = lag;
          nextGain = gain;
        }
      }
      faces.bands.push_back({static_cast<std::int32_t>(e), now, next});
      path.push_back(next);
      now = next;
    }
    pathOf_[e] = static_cast<std::int32_t>(numPaths_++);
    crossed_.push_back(static_cast<std::int32_t>(e));
    for (const std::int32_t corner : {edge.u, edge.v}) {
      if (isTouched_[slotOf(corner)]) continue;
      isTouched_[slotOf(corner)] = true;
      touched_.push_back(corner);
    }
  }
}

void SweptSum::fill(std::int32_t corner, SumFaces& faces) {
  reduceWalk(walk_);
  const auto side = [&](std::uint8_t a, std::uint8_t b, std::uint8_t c) {
    faces.sides.push_back({corner, {a, b, c}});
  };
  if (walk_.size() < 3) return;
  const auto isAbove = [&](std::uint8_t i) {  // the plane of the walk's first three
    const LatticePoint origin = apart_[walk_[0]];
    return exactDeterminant(apart_[walk_[1]] - origin, apart_[walk_[2]] - origin,
                            apart_[i] - origin) > 0;
  };
  if (walk_.size() == 3) {
    for (std::uint8_t i = 0; i < apart_.size(); ++i) {
      if (i == walk_[0] || i == walk_[1] || i == walk_[2] || !isAbove(i)) continue;
      side(walk_[0], walk_[1], i);
      side(walk_[1], walk_[2], i);
      side(walk_[2], walk_[0], i);
      return;
    }
    side(walk_[0], walk_[1], walk_[2]);
    return;
  }
  FORETOUCH_ASSERT(walk_.size() == 4);
  if (isAbove(walk_[3])) {
    side(walk_[0], walk_[1], walk_[3]);
    side(walk_[1], walk_[2], walk_[3]);
  } else {
    side(walk_[0], walk_[1], walk_[2]);
    side(walk_[0], walk_[2], walk_[3]);
  }
}

/// Around a corner of the polytope the labels make a closed walk, which encloses the sides that
/// face that corner's normals.
void SweptSum::fillCorners(SumFaces& faces) {
  for (const std::int32_t corner : touched_) {
    walk_.clear();
    const auto c = slotOf(corner);
    for (std::int32_t k = polytope_->firstEdgeOf[c]; k < polytope_->firstEdgeOf[c + 1]; ++k) {
      const auto e = static_cast<std::size_t>(polytope_->edgesAround[slotOf(k)]);
      if (pathOf_[e] < 0) continue;
      const Walk& path = paths_[slotOf(pathOf_[e])];
      // Going round counter-clockwise, an edge that leaves the corner is crossed from right to
      // left.
      if (polytope_->edges[e].u == corner) {
        walk_.insert(walk_.end(), path.rbegin(), path.rend());
      } else {
        walk_.insert(walk_.end(), path.begin(), path.end());
      }
    }
    fill(corner, faces);
    isTouched_[c] = false;
  }
  touched_.clear();
  for (const std::int32_t e : crossed_) pathOf_[slotOf(e)] = -1;
  crossed_.clear();
}

void SweptSum::facesOf(const std::vector<LatticePoint>& corners, SumFaces& faces) {
  FORETOUCH_ASSERT(!corners.empty() && corners.size() <= 4);
  faces.bands.clear();
  faces.sides.clear();
  labelFacets(corners, faces.facetCorner);
  crossEdges(faces);
  fillCorners(faces);
}

}  // namespace foretouch
