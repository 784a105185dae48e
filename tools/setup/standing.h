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
/// Surfaces up to this slope (radians, 35 degrees) are floor.
inline constexpr double kSteepestFloor = 0.61;

/// A placement, judged by the engine: nothing in it is guessed from boxes.
struct Standing {
  Placement place;
  std::vector<Inside> inside;  ///< At the first pose.
  std::optional<double>
      floorBelow;  ///< From the lowest point of the body down, metres; none: void.
  std::optional<double> floorAbove;  ///< A floor that the first pose is sunk below: how far.
  bool isOutside = false;            ///< The body is outside of the box around the scene.
  /// Of the surfaces that the chest sees along the axes, the share that shows its back.
  double backs = 0.0;
  std::size_t seen = 0;  ///< How many surfaces these are.
  // Of all poses looked at:
  std::size_t poses = 0, trunkInside = 0, limbsInside = 0, overVoid = 0;
  /// How much higher the lowest point of the body is in the usual pose than in the first (m): a
  /// clip that starts in a T-pose, or in the air.
  double usualRise = 0.0;

  [[nodiscard]] bool standsFree() const {
    return inside.empty() && floorBelow && *floorBelow <= kStandsWithin;
  }
};

[[nodiscard]] Standing standingAt(const Walker& walker, const Placement& place);

/// The place that suits the body best: free, on a floor, with room for its whole clip, on the front
/// side of the level's surfaces, and near `wish` (a placement's origin; its yaw is tried first).
/// The same for the same files. Nothing if nobody fits anywhere. Some seconds at most.
[[nodiscard]] std::optional<Standing> bestStanding(const Walker& walker, const Placement& wish);

}  // namespace foretouch::tools
