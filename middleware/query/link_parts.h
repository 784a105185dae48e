// middleware/query/link_parts.h: the convex parts of a moving link: its LSS, the nodes of the
// hierarchies below them, the triangles of its mesh or skin. Not installed.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss_hierarchy.h"
#include "middleware/query/moving_pair.h"
#include "middleware/surface/link_surface.h"
#include "middleware/surface/skin_parts.h"
#include "tessellation/aabb.h"

namespace foretouch::internal {

/// Which part of a link: one of the avatar's LSS as a whole, a node of the hierarchy below that
/// LSS, or a triangle of the mesh.
class Part {
 public:
  static Part whole() { return Part(kWhole); }
  static Part of(HierarchyChild child) {
    return Part(child.isTriangle() ? ~child.index() : child.index());
  }
  [[nodiscard]] bool isWhole() const { return code_ == kWhole; }
  [[nodiscard]] bool isTriangle() const { return code_ < 0 && !isWhole(); }
  [[nodiscard]] std::int32_t index() const { return code_ < 0 ? ~code_ : code_; }
  [[nodiscard]] bool operator<(Part other) const { return code_ < other.code_; }
  [[nodiscard]] bool operator==(Part other) const { return code_ == other.code_; }

 private:
  static constexpr std::int32_t kWhole = std::numeric_limits<std::int32_t>::min();
  explicit Part(std::int32_t code) : code_(code) {}
  std::int32_t code_;
};

/// A link at one instant; of a skinned surface, all links.
struct PosedLink {
  LinkState state;
  std::vector<LinkState> all;
};

/// A link's parts, their bounds and states. All references outlive it.
struct LinkParts {
  LinkId link;
  const std::vector<Lss>& lss;
  const std::vector<AxisBounds>& axisBounds;  // one per LSS
  const ChainMotion& motion;
  const LinkSurface* surface = nullptr;  // exact fidelity; else null
  const SkinParts* skin = nullptr;       // skinned fidelity; else null

  [[nodiscard]] const Lss& lssOf(std::int32_t lssIndex, Part part) const;
  /// The part in W. A triangle by its index within the link, in the rigid surface or in the skin.
  [[nodiscard]] MovingHull hullOf(std::int32_t lssIndex, Part part, const PosedLink& posed) const;
  /// A box around the part's points, as computed.
  [[nodiscard]] Aabb boxOfPoints(std::int32_t lssIndex, Part part, const PosedLink& posed) const;
};

}  // namespace foretouch::internal
