// middleware/surface/blend_table.h: what a skinned avatar moves through the scene, as LSS in link
// order: a link's triangles in clusters, these in parts, and around each an LSS whose axis is a
// blend of links as its vertices are; a link without triangles has its own LSS. Proof:
// lanes/blend_lanes.md. Metres. Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "articulated/avatar.h"
#include "lss/index.h"
#include "middleware/surface/skin_parts.h"
#include "tessellation/lss_table.h"

namespace foretouch::internal {

/// One link's share of the axis of a blended LSS.
struct BlendShare {
  double a[3], b[3];  ///< The ends, in the link's frame.
  double rho;         ///< Neither end is farther from the link's origin; rounded up.
  double weight;
  double spread;  ///< No vertex's own weight differs from it by more; rounded up.
  LinkId link;
};

/// With y_l(t) the place of the axis as link l moves it, the axis is at c(t), the sum over the
/// shares of weight * y_l. Every point that it stands for is at every t within
/// radius + sum of spread_l * |y_l - y_0| + BlendTable::sumError * |y_0| of c(t), y_0 that of the
/// first share and |y_0| measured from W's origin.
struct BlendedLss {
  std::int32_t firstShare, numShares;
  std::int32_t first, last;  ///< A cluster's parts, or a part's triangles; else none.
  double radius;
  bool isPoint;  ///< Both ends are one.
};

/// Immutable.
class BlendTable {
 public:
  /// `skin` is of this avatar.
  BlendTable(const Avatar& avatar, const SkinParts& skin);

  [[nodiscard]] std::int32_t size() const { return table_.size(); }
  /// Numbers, links and radii; the axes of clusters are not in it.
  [[nodiscard]] const LssTable& table() const { return table_; }
  [[nodiscard]] const BlendedLss& operator[](std::int32_t lss) const { return lss_[slotOf(lss)]; }
  [[nodiscard]] const BlendShare* shares(const BlendedLss& lss) const {
    return shares_.data() + lss.firstShare;
  }
  /// The ends of the axis in the form for lanes.
  [[nodiscard]] LaneBlend end(const BlendedLss& lss, bool isB) const {
    return {(isB ? endsB_ : endsA_).data() + lss.firstShare, lss.numShares};
  }
  /// A cluster has the parts [first, last). Those of a link follow one another.
  [[nodiscard]] const BlendedLss& part(std::int32_t part) const { return parts_[slotOf(part)]; }
  [[nodiscard]] std::int32_t numParts() const { return static_cast<std::int32_t>(parts_.size()); }
  /// A part has the triangles [first, last) of these, by their index within the link.
  [[nodiscard]] std::int32_t triangle(std::int32_t i) const { return order_[slotOf(i)]; }

  /// What every link carries of each link's surface: LSS by the link that carries them. The surface
  /// of `owner(i)` is at every t in the hull of its LSS here, but for sumError * its distance from
  /// W's origin.
  [[nodiscard]] const LssTable& carried() const { return carried_; }
  [[nodiscard]] LinkId owner(std::int32_t carried) const { return owners_[slotOf(carried)]; }

  /// Weights add up to 1 but for this, rounding included.
  [[nodiscard]] double sumError() const { return sumError_; }

 private:
  friend class BlendTableBuilder;

  LssTable table_, carried_;
  std::vector<BlendedLss> lss_, parts_;
  std::vector<BlendShare> shares_;
  std::vector<LaneShare> endsA_, endsB_;  // as the shares
  std::vector<std::int32_t> order_;
  std::vector<LinkId> owners_;
  double sumError_ = 0.0;
};

}  // namespace foretouch::internal
