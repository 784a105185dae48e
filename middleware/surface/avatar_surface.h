// middleware/surface/avatar_surface.h: an avatar's own triangles, ready for exact fidelity: per
// link the triangles in its frame L and a static LSS hierarchy over them. Metres.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "lss/triangle.h"

namespace foretouch {

/// All links together.
inline constexpr std::size_t kMaxSurfaceTriangles = 50'000'000;

namespace internal {
struct SurfaceParts;
}

/// Immutable, cheap to copy (shared), safe to query from many threads. A link's hierarchy is built
/// when a query first needs it.
class AvatarSurface {
 public:
  /// `trianglesPerLink`: one list a link, in L, finite and within kMaxCoordinate. Every triangle
  /// must lie in one of its link's LSS, up to rounding: exact contacts are looked for only where
  /// LSS contacts are. An LSS that contains none of its link's triangles stands for itself: what
  /// no mesh models must not go unseen. Error::index is the offending link.
  static Result<AvatarSurface> build(const Avatar& avatar,
                                     std::vector<std::vector<Triangle>> trianglesPerLink);

  [[nodiscard]] std::int32_t numLinks() const;
  [[nodiscard]] const std::vector<Triangle>& triangles(LinkId link) const;
  [[nodiscard]] std::size_t numTriangles() const;
  /// Builds every hierarchy that is not built yet, for those whose first query must not wait for
  /// it.
  void prepare() const;

  /// For the query's own sources.
  [[nodiscard]] const internal::SurfaceParts& parts() const { return *parts_; }

 private:
  explicit AvatarSurface(std::shared_ptr<const internal::SurfaceParts> parts)
      : parts_(std::move(parts)) {}
  std::shared_ptr<const internal::SurfaceParts> parts_;
};

}  // namespace foretouch
