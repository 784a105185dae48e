// middleware/surface/skinned_surface.h: a surface whose vertices follow the blend of several links
// (linear blend skinning): at t a vertex is at the sum of weight * (the link's pose at t applied to
// the vertex at bind time). Metres. Its triangles change shape, so clusters of them, and no
// hierarchy, say which are near anything.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "articulated/skin.h"

namespace foretouch {

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
