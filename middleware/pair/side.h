// middleware/pair/side.h: one side of a question about two that may move: a link's convex parts
// (its LSS, the nodes of the hierarchies below them, the triangles of its mesh or skin), and what
// moves it. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss_hierarchy.h"
#include "middleware/pair/moving_pair.h"
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

/// A link at one instant, and the other one of a pair; for a skinned surface, all links.
struct PosedLink {
  LinkState state, other;
  const std::vector<LinkState>* all = nullptr;
};

/// A link's parts, their bounds, and the frame that they are looked at in. All references outlive
/// it.
struct Side {
  LinkId link;
  const std::vector<Lss>& lss;
  const std::vector<AxisBounds>& axisBounds;  // one per LSS
  MotionEvaluator& evaluator;                 // of the motion of the link's chain
  const LinkSurface* surface = nullptr;       // exact fidelity; else null
  const SkinParts* skin = nullptr;            // skinned fidelity; else null
  /// That of a link above it, where only the joints below that move it; kNoParent: W.
  LinkId frame = kNoParent;
  const MotionBounds* inFrame = nullptr;  // in that frame; null in W

  [[nodiscard]] const ChainMotion& motion() const { return evaluator.motion(); }
  [[nodiscard]] LinkState stateAt(double t) const { return evaluator.stateIn(frame, link, t); }
  [[nodiscard]] MotionBounds bounds() const {
    return inFrame != nullptr ? *inFrame : motion().bounds(link);
  }
  /// Whether nothing is below the part.
  [[nodiscard]] bool isSurface(std::int32_t lssIndex, Part part) const {
    return surface == nullptr || part.isTriangle() || !surface->hasTriangles(lssIndex);
  }
  /// The two parts below one that is not the surface itself (one, twice, if the LSS contains a
  /// single triangle).
  [[nodiscard]] std::array<Part, 2> below(std::int32_t lssIndex, Part part) const;
  [[nodiscard]] const Lss& lssOf(std::int32_t lssIndex, Part part) const;
  /// The part in W. A triangle by its index within the link, in the rigid surface or in the skin.
  [[nodiscard]] MovingHull hullOf(std::int32_t lssIndex, Part part, const PosedLink& posed) const {
    if (skin != nullptr && part.isTriangle()) return skinTriangle(part.index(), *posed.all);
    return hullAt(lssIndex, part, posed.state);
  }
  /// The same for a link that has no skin, in the frame of its state.
  [[nodiscard]] MovingHull hullAt(std::int32_t lssIndex, Part part, const LinkState& state) const;
  /// A box around the part's points, as computed.
  [[nodiscard]] Aabb boxOfPoints(std::int32_t lssIndex, Part part, const PosedLink& posed) const;
  [[nodiscard]] Aabb boxAt(std::int32_t lssIndex, Part part, const LinkState& state) const;
  [[nodiscard]] MovingHull skinTriangle(std::int32_t index,
                                        const std::vector<LinkState>& states) const;
};

}  // namespace foretouch::internal
