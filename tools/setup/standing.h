// tools/setup/standing.h: how a body stands at a place, and where it could stand. World W: metres,
// +Y up.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "assets/avatar/joint_match.h"
#include "tools/setup/walker.h"

namespace foretouch::tools {

/// Feet may be this far above the floor (m) and still stand.
inline constexpr double kStandsWithin = 0.02;

/// A placement, judged by the engine and by where a person could walk.
struct Standing {
  Placement place;
  std::vector<Inside> insideAtFirst;  ///< At the clip's first pose.
  // At the pose that says at which height the clip stands:
  std::vector<Inside> inside;
  std::optional<double>
      floorBelow;  ///< From the lowest point of the body down, metres; none: void.
  std::optional<double> floorAbove;  ///< How far it is sunk below a floor.
  FloorKind floor = FloorKind::None;
  bool isOnAsked = false;
  bool isOutside = false;  ///< The body is outside of the box around the scene.
  // For all poses looked at:
  std::size_t poses = 0, trunkInside = 0, limbsInside = 0, overVoid = 0;
  std::size_t offFloor = 0;  ///< Neither the main floor nor an asked object is below it.
  /// How much higher the lowest point of the body is in the first pose than where it stands (m).
  double firstRise = 0.0;

  [[nodiscard]] bool standsFree() const {
    return inside.empty() && floorBelow && *floorBelow <= kStandsWithin;
  }
  /// On the main floor, or on what was asked.
  [[nodiscard]] bool isOnFloor() const { return floor == FloorKind::Main || isOnAsked; }
};

[[nodiscard]] Standing standingAt(const Walker& walker, const Placement& place);

/// The place that suits the body best: free, on the level's main floor (or on what was asked), with
/// room for its whole clip, away from edges, and near `wish` (a placement's origin; its yaw is
/// tried first). A wish that is right is kept. The same files give the same place. Nothing if the
/// body fits nowhere. Some seconds at most.
[[nodiscard]] std::optional<Standing> bestStanding(const Walker& walker, const Placement& wish);

/// Where there is no ground to stand on: the clip's own at height 0, its origin at the scene's.
[[nodiscard]] Placement originPlace(const Walker& walker);

}  // namespace foretouch::tools
