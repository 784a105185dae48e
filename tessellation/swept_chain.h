// tessellation/swept_chain.h: the surface of a chain of consecutive sums conv{corners} + polytope:
// all their boundaries less those of the sums that neighbours share. Exact. Proof that this
// encloses the union: tessellation/swept_surface.md 2. Not installed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "tessellation/closed_mesh.h"
#include "tessellation/swept_sum.h"

namespace foretouch {

/// Both ends of the axis at one instant, on the lattice.
struct LatticeEnds {
  LatticePoint a, b;
};

class SweptChain {
 public:
  /// `polytope` must outlive the chain.
  SweptChain(const BallPolytope& polytope, const LatticeEnds& start, double timeS);

  /// Adds the piece from the last instant to this one. Precondition: the ends differ by less than
  /// kMaxLatticeDifference.
  void add(const LatticeEnds& ends, double timeS);

  /// Adds the remaining faces at the last instant. Call once.
  void close();

  /// About the number of triangles of mesh() so far: faces less those that will cancel.
  [[nodiscard]] std::size_t triangles() const {
    return static_cast<std::size_t>(std::max<std::int64_t>(0, triangles_));
  }

  /// After close(): the closed surface. Keys: see place() and timeS().
  [[nodiscard]] ClosedMesh mesh();

  [[nodiscard]] LatticePoint place(MeshKey key) const;
  [[nodiscard]] double timeS(MeshKey key) const;

 private:
  /// A corner of the axis' path; consecutive instants share one if the end stood still.
  struct PathCorner {
    LatticePoint place;
    double timeS = 0.0;
  };
  enum class Kind : std::uint8_t { Facet, Band, Side };
  /// A face by its parts, in canonical order, and its multiplicity.
  struct Face {
    std::array<std::uint32_t, 3> of{};
    std::uint32_t element = 0;  ///< The polytope's facet, edge or corner.
    Kind kind = Kind::Facet;
    std::int8_t sign = 0;
  };
  [[nodiscard]] std::vector<LatticePoint> places(const std::vector<std::uint32_t>& corners) const;
  void emitFacet(std::size_t facet, std::uint32_t corner, std::int8_t sign);
  void emitOthers(const std::vector<std::uint32_t>& corners, std::int8_t sign);
  void appendTriangles(const Face& face, std::vector<std::array<MeshKey, 3>>& triangles) const;
  [[nodiscard]] MeshKey key(std::uint32_t pathCorner, std::int32_t polytopeCorner) const;

  const BallPolytope* polytope_;
  SweptSum sum_;
  SumFaces faces_;
  std::vector<PathCorner> path_;
  std::uint32_t a_ = 0, b_ = 0;  ///< The last instant's corners.
  bool hasPiece_ = false;
  /// Per facet: the corner that the last piece moved it to, and whether it is still to be emitted.
  std::vector<std::uint32_t> lastCorner_;
  std::vector<bool> isOpen_;
  std::vector<Face> emitted_;
  std::int64_t triangles_ = 0;
};

}  // namespace foretouch
