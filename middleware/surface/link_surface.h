// middleware/surface/link_surface.h: the contents of an AvatarSurface. Not installed.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "lss/index.h"
#include "lss/lss.h"
#include "lss/lss_hierarchy.h"
#include "middleware/lanes/frame_lanes.h"
#include "middleware/surface/wide_nodes.h"
#include "tessellation/open_edges.h"

namespace foretouch::internal {

/// In lanes, the parts `kPartLevels` below a node replace it, or triangles met on the way. More
/// than a node's two children fill the lanes sooner, and cost nothing if the descent would have
/// passed through a child anyway.
inline constexpr int kPartLevels = 2;
class PartsBelow {
 public:
  PartsBelow(const LssHierarchy& hierarchy, HierarchyChild node);
  [[nodiscard]] const HierarchyChild* begin() const { return parts_.data(); }
  [[nodiscard]] const HierarchyChild* end() const { return parts_.data() + count_; }

 private:
  void add(const LssHierarchy& hierarchy, HierarchyChild part, int levels);

  std::array<HierarchyChild, std::size_t{1} << kPartLevels> parts_;
  std::size_t count_ = 0;
};

/// The triangles of one link, each under an LSS of the link that contains it. An LSS whose
/// triangles all hang under others has one of them too.
class LinkSurface {
 public:
  LinkSurface(std::vector<Triangle> triangles, std::vector<std::vector<std::int32_t>> idsOfLss)
      : triangles_(std::move(triangles)), idsOfLss_(std::move(idsOfLss)) {}

  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] const Triangle& triangle(std::int32_t id) const { return triangles_[slotOf(id)]; }
  /// False: the LSS contains no triangle and is itself the surface.
  [[nodiscard]] bool hasTriangles(std::int32_t lss) const {
    return !idsOfLss_[slotOf(lss)].empty();
  }
  /// Built once, by the first thread that uses it. Precondition: hasTriangles(lss).
  [[nodiscard]] const LssHierarchy& hierarchy(std::int32_t lss) const;
  void prepare() const;
  /// A corner of each connected piece: triangles are connected by corners at the same place. Built
  /// in the same way.
  [[nodiscard]] const std::vector<Eigen::Vector3d>& cornerOfPieces() const;
  /// Per triangle: the number of its piece, in the same order.
  [[nodiscard]] const std::vector<std::int32_t>& pieceOf() const;
  /// The room of all its triangles as one object. Built in the same way.
  [[nodiscard]] const ObjectRoom& room() const;
  /// As prepare(), also for wideNode().
  void prepareWide() const;
  /// For an LSS with triangles. Preconditions: prepareWide() was called; as WideNodes::at().
  [[nodiscard]] const WideNode& wideNode(std::int32_t lss, HierarchyChild node) const {
    return wideNodes_[slotOf(lss)]->at(node);
  }
  /// That hierarchy in the form for lanes. Precondition of all three: prepare() was called.
  [[nodiscard]] HierarchyChild root(std::int32_t lss) const {
    return hierarchies_[slotOf(lss)]->root();
  }
  [[nodiscard]] const LanePart& lanePart(std::int32_t lss, HierarchyChild part) const {
    return part.isTriangle() ? laneTriangles_[slotOf(part.index())] : laneNode(lss, part).part;
  }
  [[nodiscard]] const PartsBelow& below(std::int32_t lss, HierarchyChild node) const {
    return laneNode(lss, node).below;
  }

 private:
  using Hierarchies = std::vector<std::optional<LssHierarchy>>;
  struct LaneNode {
    LanePart part;
    PartsBelow below;
  };

  void prepareLanes() const;
  void preparePieces() const;
  [[nodiscard]] const LaneNode& laneNode(std::int32_t lss, HierarchyChild node) const {
    return laneNodes_[slotOf(lss)][slotOf(node.index())];
  }
  std::vector<Triangle> triangles_;
  std::vector<std::vector<std::int32_t>> idsOfLss_;
  mutable std::once_flag built_, builtWide_, builtPieces_, builtRoom_;
  mutable std::vector<Eigen::Vector3d> corners_;
  mutable std::vector<std::int32_t> pieceOf_;
  mutable ObjectRoom room_;
  mutable Hierarchies hierarchies_;
  mutable std::vector<LanePart> laneTriangles_;
  mutable std::vector<std::vector<LaneNode>> laneNodes_;  // per LSS
  mutable std::vector<std::optional<WideNodes>> wideNodes_;
};

struct SurfaceParts {
  // One per link of the avatar; shared with surfaces of chains that the avatar is part of.
  std::vector<std::shared_ptr<const LinkSurface>> links;
  std::size_t numTriangles = 0;
};

}  // namespace foretouch::internal
