// middleware/query/link_pair.h: a convex part of a moving link (an LSS, or a triangle of its mesh)
// against a triangle of the scene at one instant: a proven bound on their separation, and for how
// long it holds. Proof with rounding: docs/guarantees.md 5. Not installed.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "lss/lss_hierarchy.h"
#include "lss/safe_step.h"
#include "lss/triangle.h"
#include "middleware/scene/triangle_id.h"
#include "middleware/surface/link_surface.h"
#include "middleware/surface/skin_parts.h"
#include "tessellation/aabb.h"
#include "tessellation/swept_lss.h"

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

/// One part against one triangle of the scene, with all rounding errors on the safe side. The part
/// is the hull of `points` points, grown by `radius`.
struct PairState {
  std::size_t points = 0;  // 2: an LSS's axis; 3: a triangle
  double radius = 0.0;
  Eigen::Vector3d nhat;       // unit or zero, from the scene's triangle towards the part
  std::array<double, 3> gap;  // proven: the plane's clearance of each point, less radius
  double gapUpper = 0.0;      // proven: the separation of part and triangle is at most this
  double distance = 0.0;      // as computed, of the hull without the radius
  Eigen::Vector3d onHull, onScene, difference, featureNormal;  // as in ClosestPoints
  Triangle hull;  // of a triangle's pair: the part in W, as computed
  std::array<Eigen::Vector3d, 3> velocity;
  std::array<double, 3> acceleration, velocityRounding;

  [[nodiscard]] double gapLower() const;
  [[nodiscard]] double estimate() const { return distance - radius; }
};

/// A link at one instant; of a skinned surface, all links.
struct PosedLink {
  LinkState state;
  std::vector<LinkState> all;
};

/// A triangle of the link's surface at one instant, in W, and bounds on its vertices' motion.
struct MovingTriangle {
  Triangle triangle;
  std::array<Eigen::Vector3d, 3> velocity;
  std::array<double, 3> acceleration, positionRounding, velocityRounding;
};

/// A link's parts, their bounds and states. All references outlive it.
struct LinkParts {
  LinkId link;
  const std::vector<Lss>& lss;
  const std::vector<AxisBounds>& axisBounds;  // one per LSS
  const ChainMotion& motion;
  const LinkSurface* surface = nullptr;  // exact fidelity; else null
  const SkinParts* skin = nullptr;       // skinned fidelity; else null

  /// The rigid surface's triangle, or the skin's, by its index within the link.
  [[nodiscard]] MovingTriangle movingTriangle(std::int32_t index, const PosedLink& posed) const;

  [[nodiscard]] const Lss& lssOf(std::int32_t lssIndex, Part part) const;
  [[nodiscard]] PairState pair(std::int32_t lssIndex, Part part, const PosedLink& posed,
                               const Triangle& triangle) const;
  /// For how long the part stays at `floor` or more above the plane of another pair of the same
  /// triangle at the same instant. A cheap proof: a plane that separates an LSS often separates the
  /// parts inside it. 0 if it proves nothing.
  [[nodiscard]] double stepByPlane(std::int32_t lssIndex, Part part, const LinkState& state,
                                   const Triangle& triangle, const Eigen::Vector3d& nhat,
                                   double floor) const;
  /// A box around the part's points, as computed.
  [[nodiscard]] Aabb boxOfPoints(std::int32_t lssIndex, Part part, const PosedLink& posed) const;
};

/// For how long the pair's separation stays at `floor` or above; 0 if that is not proven now.
[[nodiscard]] double stepFrom(const PairState& pair, double floor);

}  // namespace foretouch::internal
