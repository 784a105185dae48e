// middleware/depth/body_places.h: where the links of a world's body are at one instant of world
// time, whatever carries it, and how sure that is. Not installed.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "articulated/motion.h"
#include "articulated/skeleton.h"
#include "lss/lss.h"
#include "middleware/world/world_contacts.h"
#include "middleware/world/world_parts.h"

namespace foretouch::internal {

/// A link's frame in W. A point at rho from its origin is no farther from where R and p put it than
/// roundingAt(rho).
struct LinkPlace {
  Eigen::Matrix3d R_WL = Eigen::Matrix3d::Identity();
  Eigen::Vector3d p_WL = Eigen::Vector3d::Zero();
  double ofOrigin = 0.0, ofTurn = 0.0;  ///< m; and a spectral norm.

  [[nodiscard]] Eigen::Vector3d at(const Eigen::Vector3d& p_L) const { return p_WL + R_WL * p_L; }
  [[nodiscard]] double roundingAt(double rho) const;
};

enum class PlaceKnown : std::uint8_t {
  Known,
  Assumed,   ///< It, or what carries it, is silent, and taken to hold still.
  Silent,    ///< The same, and taken to be undecided, or waited for.
  NotThere,  ///< Before the first pose, or forgotten.
};

/// What is known of one body by itself, whatever carries it.
struct BodyPiece {
  PlaceKnown how = PlaceKnown::NotThere;
  const Episode* episode = nullptr;  ///< These two unless it is Silent or NotThere.
  TrackPiece piece;
};
[[nodiscard]] BodyPiece bodyPieceAt(const WorldBody& body, const WorldTime& time);

/// For one thread; keeps its memory.
class BodyPlaces {
 public:
  /// Fills `places`, one per link of the body, unless it is Silent or NotThere. At an instant at
  /// which a body changes its carrier: after it. O(joints of the body and of its carriers).
  [[nodiscard]] PlaceKnown at(const WorldParts& world, BodyId body, const WorldTime& time,
                              std::vector<LinkPlace>& places);

 private:
  [[nodiscard]] PlaceKnown place(const WorldBody& body, const WorldTime& time,
                                 std::vector<LinkPlace>& places);

  ChainMotion motion_;
  std::vector<LinkState> states_;
  std::vector<BodyId> chain_;
};

/// The LSS in W, or in the frame of a mesh that is at `frame`; `rounding` grows to what no point of
/// them, nor of the mesh's triangles within `reach` of its origin, is farther from there.
[[nodiscard]] Lss placed(const Lss& lss_L, const LinkPlace& place, double& rounding);
[[nodiscard]] Lss seenFrom(const LinkPlace& frame, const Lss& lss_W, double& rounding);

}  // namespace foretouch::internal
