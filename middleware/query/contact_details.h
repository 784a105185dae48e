// middleware/query/contact_details.h: more about a contact, for whoever needs it: how fast the two
// sides approach, and up to four points where they are near. Lengths in metres in W, velocities in
// metres per unit of t: divide by the step's seconds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "middleware/contact.h"
#include "middleware/scene/triangle_id.h"

namespace foretouch {

/// Two points, one of each side, that are near at the contact's instant.
struct ContactPoint {
  Eigen::Vector3d p_WLink = Eigen::Vector3d::Zero();   ///< On the link's surface.
  Eigen::Vector3d p_WOther = Eigen::Vector3d::Zero();  ///< On the scene, or the other link.
  double separation = 0.0;         ///< As computed; below zero where the two overlap.
  TriangleId triangle = -1;        ///< Of the scene, or of the other link's mesh.
  std::int32_t lss = -1;           ///< Index among the link's LSS.
  std::int32_t linkTriangle = -1;  ///< Of the link's mesh; -1 at link fidelity.
};

struct ContactDetails {
  static constexpr std::size_t kMostPoints = 4;

  /// Of the material points at the two witness points, at the contact's instant.
  Eigen::Vector3d v_WLink = Eigen::Vector3d::Zero(), v_WOther = Eigen::Vector3d::Zero();
  /// Along the contact's normal, above zero while the two approach; 0 without a normal.
  double approachSpeed = 0.0;
  /// If these two points touch in this step, within the tolerance from here, they do so at a speed
  /// between these along this normal. A lower bound below zero: perhaps they never touch (a graze).
  double approachLower = 0.0, approachUpper = 0.0;
  /// Of the pairs of the same two sides (the link and the object, or both links) that are within
  /// the tolerance then: the nearest first; then the one farthest from it, the one that spans the
  /// largest triangle with both, and the one farthest on the other side of that. Not in an order
  /// that depends on how the scene's triangles are numbered.
  std::array<ContactPoint, kMostPoints> points;
  std::size_t numPoints = 0;
};

/// For the query's own sources (Query::details()).
namespace internal {
struct QueryPlan;
[[nodiscard]] ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                                       const LinkContact& contact, std::vector<TriangleId>& found);
[[nodiscard]] ContactDetails detailsOf(const QueryPlan& plan, const ChainMotion& motion,
                                       const PairContact& contact);
}  // namespace internal

}  // namespace foretouch
