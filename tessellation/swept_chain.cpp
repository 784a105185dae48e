#include "tessellation/swept_chain.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "lss/assert.h"

namespace foretouch {

SweptChain::SweptChain(const BallPolytope& polytope, const LatticeEnds& start, double timeS)
    : polytope_(&polytope),
      sum_(polytope),
      lastCorner_(polytope.facets.size(), 0),
      isOpen_(polytope.facets.size(), false) {
  path_.push_back({start.a, timeS});
  if (!(start.b == start.a)) {
    b_ = 1;
    path_.push_back({start.b, timeS});
  }
}

MeshKey SweptChain::key(std::uint32_t pathCorner, std::int32_t polytopeCorner) const {
  return static_cast<MeshKey>(pathCorner) * polytope_->corners.size() +
         static_cast<MeshKey>(polytopeCorner);
}

LatticePoint SweptChain::place(MeshKey key) const {
  const std::size_t count = polytope_->corners.size();
  return path_[key / count].place + polytope_->corners[key % count];
}

double SweptChain::timeS(MeshKey key) const {
  return path_[key / polytope_->corners.size()].timeS;
}

std::vector<LatticePoint> SweptChain::places(const std::vector<std::uint32_t>& corners) const {
  std::vector<LatticePoint> found;
  for (const std::uint32_t corner : corners) found.push_back(path_[corner].place);
  return found;
}

void SweptChain::emitFacet(std::size_t facet, std::uint32_t corner, std::int8_t sign) {
  emitted_.push_back({{corner, 0, 0}, static_cast<std::uint32_t>(facet), Kind::Facet, sign});
  ++triangles_;
}

/// The bands and sides in `faces_`, in canonical order: turning a band round, or swapping two
/// corners of a side, turns the face over.
void SweptChain::emitOthers(const std::vector<std::uint32_t>& corners, std::int8_t sign) {
  for (const SumFaces::Band& band : faces_.bands) {
    std::uint32_t left = corners[band.left], right = corners[band.right];
    std::int8_t turned = sign;
    if (left > right) {
      std::swap(left, right);
      turned = static_cast<std::int8_t>(-sign);
    }
    emitted_.push_back(
        {{left, right, 0}, static_cast<std::uint32_t>(band.edge), Kind::Band, turned});
  }
  for (const SumFaces::Side& side : faces_.sides) {
    std::array<std::uint32_t, 3> of{corners[side.of[0]], corners[side.of[1]], corners[side.of[2]]};
    std::int8_t turned = sign;
    for (const std::size_t i : {0u, 1u, 0u}) {
      if (of[i] < of[i + 1]) continue;
      std::swap(of[i], of[i + 1]);
      turned = static_cast<std::int8_t>(-turned);
    }
    emitted_.push_back({of, static_cast<std::uint32_t>(side.corner), Kind::Side, turned});
  }
  triangles_ += sign * static_cast<std::int64_t>(2 * faces_.bands.size() + faces_.sides.size());
}

void SweptChain::add(const LatticeEnds& ends, double timeS) {
  const std::uint32_t beforeA = a_, beforeB = b_;
  const auto cornerAt = [&](const LatticePoint& place, std::uint32_t before) {
    if (path_[before].place == place) return before;
    path_.push_back({place, timeS});
    return static_cast<std::uint32_t>(path_.size() - 1);
  };
  const std::uint32_t a = cornerAt(ends.a, beforeA);
  const std::uint32_t b = ends.b == ends.a ? a : cornerAt(ends.b, beforeB);
  if (a == beforeA && b == beforeB) return;

  // Subtracts the part shared with the last piece before adding this one.
  std::vector<std::uint32_t> shared{std::min(beforeA, beforeB)};
  if (beforeA != beforeB) shared.push_back(std::max(beforeA, beforeB));
  std::vector<std::uint8_t> sharedCorner;
  if (hasPiece_) {
    sum_.facesOf(places(shared), faces_);
    emitOthers(shared, -1);
    sharedCorner = faces_.facetCorner;
  }
  std::vector<std::uint32_t> corners{beforeA, beforeB, a, b};
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  sum_.facesOf(places(corners), faces_);
  emitOthers(corners, 1);
  for (std::size_t f = 0; f < isOpen_.size(); ++f) {
    const std::uint32_t now = corners[faces_.facetCorner[f]];
    bool isOpen = true;
    if (hasPiece_) {
      const std::uint32_t takenAway = shared[sharedCorner[f]];
      if (isOpen_[f] && lastCorner_[f] == takenAway) {
        // the last piece's facet and the shared one cancel
      } else {
        if (isOpen_[f]) emitFacet(f, lastCorner_[f], 1);
        isOpen = now != takenAway;
        if (isOpen) emitFacet(f, takenAway, -1);
      }
    }
    lastCorner_[f] = now;
    isOpen_[f] = isOpen;
  }
  hasPiece_ = true;
  a_ = a;
  b_ = b;
}

void SweptChain::close() {
  if (!hasPiece_) {  // nothing moved: the LSS itself
    std::vector<std::uint32_t> corners{std::min(a_, b_)};
    if (a_ != b_) corners.push_back(std::max(a_, b_));
    sum_.facesOf(places(corners), faces_);
    emitOthers(corners, 1);
    for (std::size_t f = 0; f < isOpen_.size(); ++f) {
      emitFacet(f, corners[faces_.facetCorner[f]], 1);
    }
    return;
  }
  for (std::size_t f = 0; f < isOpen_.size(); ++f) {
    if (isOpen_[f]) emitFacet(f, lastCorner_[f], 1);
  }
}

void SweptChain::appendTriangles(const Face& face,
                                 std::vector<std::array<MeshKey, 3>>& triangles) const {
  const auto add = [&](MeshKey p, MeshKey q, MeshKey r) {
    if (face.sign < 0) std::swap(q, r);
    triangles.push_back({p, q, r});
  };
  if (face.kind == Kind::Facet) {
    const auto& c = polytope_->facets[face.element].corners;
    add(key(face.of[0], c[0]), key(face.of[0], c[1]), key(face.of[0], c[2]));
  } else if (face.kind == Kind::Band) {
    const BallPolytope::Edge& edge = polytope_->edges[face.element];
    const MeshKey vLeft = key(face.of[0], edge.v), uLeft = key(face.of[0], edge.u);
    const MeshKey uRight = key(face.of[1], edge.u), vRight = key(face.of[1], edge.v);
    add(vLeft, uLeft, uRight);
    add(vLeft, uRight, vRight);
  } else {
    const auto corner = static_cast<std::int32_t>(face.element);
    add(key(face.of[0], corner), key(face.of[1], corner), key(face.of[2], corner));
  }
}

ClosedMesh SweptChain::mesh() {
  const auto identity = [](const Face& f) { return std::tie(f.of, f.kind, f.element); };
  std::sort(emitted_.begin(), emitted_.end(), [&](const Face& x, const Face& y) {
    return std::tie(x.of, x.kind, x.element, x.sign) < std::tie(y.of, y.kind, y.element, y.sign);
  });
  std::vector<std::array<MeshKey, 3>> triangles;
  for (std::size_t begin = 0; begin < emitted_.size();) {
    int count = 0;
    std::size_t end = begin;
    while (end < emitted_.size() && identity(emitted_[end]) == identity(emitted_[begin])) {
      count += emitted_[end++].sign;
    }
    Face face = emitted_[begin];
    face.sign = count < 0 ? -1 : 1;
    for (int i = 0; i < std::abs(count); ++i) appendTriangles(face, triangles);
    begin = end;
  }
  emitted_.clear();
  emitted_.shrink_to_fit();
  return closedMesh(triangles);
}

}  // namespace foretouch
