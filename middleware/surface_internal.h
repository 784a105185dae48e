// middleware/surface_internal.h: what stands behind an AvatarSurface. Not installed.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lss/lss_hierarchy.h"
#include "lss/triangle.h"

namespace foretouch::internal {

/// The triangles of one link, each under the one LSS of the link that contains it.
class LinkSurface {
 public:
  LinkSurface(std::vector<Triangle> triangles, std::vector<std::vector<std::int32_t>> idsOfLss)
      : triangles_(std::move(triangles)), idsOfLss_(std::move(idsOfLss)) {}

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const Triangle& triangle(std::int32_t id) const {
    return triangles_[static_cast<std::size_t>(id)];
  }
  /// False: the LSS bounds no triangle and is itself the surface.
  [[nodiscard]] bool hasTriangles(std::int32_t lss) const {
    return !idsOfLss_[static_cast<std::size_t>(lss)].empty();
  }
  /// Built on first use, once, whichever thread comes first. Precondition: hasTriangles(lss).
  [[nodiscard]] const LssHierarchy& hierarchy(std::int32_t lss) const;
  void prepare() const;

 private:
  using Hierarchies = std::vector<std::optional<LssHierarchy>>;
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::int32_t>> idsOfLss_;
  mutable std::once_flag built_;
  mutable Hierarchies hierarchies_;
};

struct SurfaceParts {
  std::vector<std::unique_ptr<LinkSurface>> links;  // one a link of the avatar
  std::size_t numTriangles = 0;
};

}  // namespace foretouch::internal
