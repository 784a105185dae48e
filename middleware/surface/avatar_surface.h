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

}  // namespace foretouch
