// middleware/surface/avatar_surface.h: an avatar's own triangles. Ready for exact fidelity: per
// link the triangles in its frame L and a static LSS hierarchy over them. Ready for skinned
// fidelity: a surface whose vertices follow the blend of several links (linear blend skinning): at
// t a vertex is at the sum of weight * (the link's pose at t applied to the vertex at bind time).
// Its triangles change shape, so clusters of them, and no hierarchy, say which are near anything.
// Metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "lss/lss.h"

namespace foretouch {

/// All links together.
inline constexpr std::size_t kMaxSurfaceTriangles = 50'000'000;

namespace internal {
struct SurfaceParts;
}

/// Immutable, cheap to copy (shared), safe to query from many threads. The first query that needs a
/// link's hierarchy builds it.
class AvatarSurface {
 public:
  /// `trianglesPerLink`: one list per link, in L, finite and within kMaxCoordinate. Every triangle
  /// must lie in one of its link's LSS, up to rounding: a query looks for exact contacts only where
  /// the LSS has contact. An LSS that contains none of its link's triangles is its own surface:
  /// parts without a mesh must not be missed. Error::index is the offending link.
  static Result<AvatarSurface> build(const Avatar& avatar,
                                     std::vector<std::vector<Triangle>> trianglesPerLink);

  [[nodiscard]] std::int32_t numLinks() const;
  [[nodiscard]] const std::vector<Triangle>& triangles(LinkId link) const;
  [[nodiscard]] std::size_t numTriangles() const;
  /// Builds every missing hierarchy now, so that the first query need not wait for it.
  void prepare() const;

  /// For the library's own sources.
  explicit AvatarSurface(std::shared_ptr<const internal::SurfaceParts> parts)
      : parts_(std::move(parts)) {}
  [[nodiscard]] const internal::SurfaceParts& parts() const { return *parts_; }

 private:
  std::shared_ptr<const internal::SurfaceParts> parts_;
};

namespace internal {
struct SkinParts;
}

/// Immutable, cheap to copy (shared), safe to query from many threads.
class SkinnedSurface {
 public:
  /// `trianglesOfLink`: how many of the skin's triangles, in order, each link reports
  /// (ModelAvatar::surface's sizes). Checks links, vertex indices, weights (> 0, summing to one
  /// within 1e-9 per vertex) and coordinates. Error::index is the offending vertex or triangle.
  static Result<SkinnedSurface> build(const Avatar& avatar, Skin skin,
                                      const std::vector<std::size_t>& trianglesOfLink);

  [[nodiscard]] std::int32_t numLinks() const;
  [[nodiscard]] std::size_t numTriangles() const;
  /// The links that move the vertices of the link's triangles, ascending; none if it has no
  /// triangle. Linear in the triangles; meant for set-up.
  [[nodiscard]] std::vector<LinkId> linksMoving(LinkId link) const;

  /// For the query's own sources.
  [[nodiscard]] const internal::SkinParts& parts() const { return *parts_; }

 private:
  explicit SkinnedSurface(std::shared_ptr<const internal::SkinParts> parts)
      : parts_(std::move(parts)) {}
  std::shared_ptr<const internal::SkinParts> parts_;
};

}  // namespace foretouch
