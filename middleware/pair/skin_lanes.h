// middleware/pair/skin_lanes.h: a skin over one span of a motion, for lanes: the boxes of its
// clusters, their polynomials, and the curves of those triangles that come near anything. Not
// installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "lss/lss_hierarchy.h"
#include "middleware/lanes/blend_lanes.h"
#include "middleware/surface/blend_table.h"
#include "middleware/surface/skin_parts.h"
#include "tessellation/lss_polynomials.h"
#include "tessellation/swept_boxes.h"
#include "tessellation/swept_lss.h"

namespace foretouch::internal {

/// Numbers from `first` to before `last`.
struct PartRange {
  std::int32_t first, last;
};

/// Keeps its memory; for one thread.
class SkinLanes {
 public:
  /// Forgets the last span. All references outlive it.
  void beginSpan(const SkinParts& skin, const BlendTable& table, const ChainMotion& motion,
                 const ChainNodes& nodes);

  /// Boxes of everything that each link's surface covers over the span, grown by `margin` (m),
  /// relative to the origin of the nodes and rounded outward; empty where there is none.
  [[nodiscard]] const SweptBoxes& linkBoxes(double margin);
  /// The same for one blended LSS. Its radius over the span is known from then on.
  void addBox(std::int32_t lss, double margin, SweptBoxes& boxes);
  /// Precondition of both: addBox() in this span.
  [[nodiscard]] double radius(std::int32_t lss) const { return spans_[slotOf(lss)].radius; }
  [[nodiscard]] LssPolynomials polynomials(std::int32_t lss);
  /// The axis where the links are in these states.
  [[nodiscard]] AxisEnds endsAt(std::int32_t lss, const std::vector<LinkState>& states) const;

  /// The curves of this link's triangles, from now on, are relative to polynomials().origin of its
  /// frame, which it returns. Precondition: it has some.
  const FramePolynomials& beginLink(LinkId link);
  /// The parts of one of the link's clusters; `lssOfLink` counts from the link's first.
  [[nodiscard]] PartRange partsOf(std::int32_t lssOfLink) const;
  /// A part's triangles, in BlendTable's order.
  [[nodiscard]] PartRange trianglesOf(HierarchyChild part) const;
  [[nodiscard]] HierarchyChild triangle(std::int32_t i) const {
    return HierarchyChild::triangle(table_->triangle(i));
  }
  /// A number for the curve of a part's axis, or of a triangle by its index within the link.
  [[nodiscard]] std::int32_t curve(HierarchyChild part);
  [[nodiscard]] const BlendTriangle* curves() const { return curves_.data(); }
  [[nodiscard]] const BlendHull& hull(std::int32_t curve) const { return hulls_[slotOf(curve)]; }

 private:
  /// A blended LSS over the span.
  struct Span {
    double radius;     ///< The LSS's, and what its points stray from the blend.
    double middle[3];  ///< The axis', relative to the origin of the nodes.
  };

  [[nodiscard]] const BlendFrame* framesFor(const LaneBlend& blend);
  [[nodiscard]] double offWorld(double reach) const;
  /// Where the axis is at the nodes, and how its points may leave their hull in between.
  struct Reach {
    BlendExtent extent;
    double radius, sag, rounding;
  };
  [[nodiscard]] Reach reachOf(const BlendedLss& blended);
  void addCurve(HierarchyChild part);

  const SkinParts* skin_ = nullptr;
  const BlendTable* table_ = nullptr;
  const ChainMotion* motion_ = nullptr;
  const ChainNodes* nodes_ = nullptr;
  double sagitta_ = 0.0;  // per acceleration
  SweptBoxes carried_, links_;
  std::vector<Span> spans_;                // per LSS
  std::vector<AxisShare> axis_;            // of the current LSS
  std::vector<BlendFrame> frames_;         // per link, of those that are known
  std::vector<std::uint8_t> areKnown_;     // per link
  LinkId link_ = kNoParent;                // the one whose curves there are
  std::vector<BlendTriangle> curves_;      // those that were asked for
  std::vector<BlendHull> hulls_;           // of the same
  std::vector<std::int32_t> curveOf_;      // per triangle of the link; -1: none yet
  std::vector<std::int32_t> curveOfPart_;  // the same per part of the link
  std::int32_t firstPart_ = 0;             // of the link
  double originPad_ = 0.0;                 // of the curves' origin
};

}  // namespace foretouch::internal
