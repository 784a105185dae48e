// tools/floor/floor_fit.h: where the floor of a clip is, by the feet that rest on it, over all its
// frames. World W: metres, +Y up, seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "articulated/result.h"
#include "tools/floor/resting_body.h"

namespace foretouch::tools {

/// A foot whose lowest point moves slower than this (m/s) ...
inline constexpr double kRestSpeed = 0.15;
/// ... for at least this long (s) rests. A foot at the top of a jump is as slow for 0.03 s.
inline constexpr double kRestTimeS = 0.1;
/// Rests this far (m) from a floor lie on it: mocap of one foot varies by about a centimetre.
inline constexpr double kOnFloor = 0.015;
/// No floor is steeper than this (radians; 6 degrees): stairs are not taken for one.
inline constexpr double kMostTilt = 0.105;

/// A foot that stays where it is for a while.
struct FootRest {
  std::size_t limb = 0;
  std::int64_t firstStep = 0, lastStep = 0;  ///< Poses, both of them at rest.
  double durationS = 0.0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< Mean of its lowest point.
};

struct FloorFit {
  double height = 0.0;  ///< The floor's height at `center_W`.
  Eigen::Vector3d normal_W = Eigen::Vector3d::UnitY();
  Eigen::Vector3d center_W = Eigen::Vector3d::Zero();  ///< Centre of the rests on it, on the floor.
  double tilt = 0.0;                                   ///< Radians.
  /// Half of the interval in which the height lies with 95 % (m), by how far rests differ.
  double uncertainty = 0.0;
  double spread = 0.0;  ///< Standard deviation of the rests on it (m).
  std::size_t rests = 0, onFloor = 0;
  double restS = 0.0, onFloorS = 0.0;  ///< Their durations together.

  /// The height of a point above the floor, along its normal.
  [[nodiscard]] double heightOf(const Eigen::Vector3d& p_W) const {
    return normal_W.dot(p_W - center_W);
  }
  /// Brings the floor level, to `target` (m).
  [[nodiscard]] Eigen::Isometry3d levelledTo(double target) const;
};

/// The body's pose at `step`, as one of RestingBody::avatar.
using RestingPoses = std::function<Result<Pose>(std::int64_t step)>;

/// All rests of feet in poses 0 to `steps`, `stepS` apart. Errors: those of `poses`.
[[nodiscard]] Result<std::vector<FootRest>> footRestsOf(const RestingBody& body, std::int64_t steps,
                                                        double stepS, const RestingPoses& poses);

/// The plane that most rests lie on and hardly one lies below; level unless the rests say
/// otherwise. The same rests give the same floor. Errors (Empty): feet do not rest at all, or on no
/// single floor; the message says which.
[[nodiscard]] Result<FloorFit> fitFloor(const std::vector<FootRest>& rests);

}  // namespace foretouch::tools
