// tests/oracle/world_stage.h: who moves in the worlds that are judged: clips that walk, a ring that
// is thrown, a sword, a door and a lift. Metres, microseconds.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "middleware/scene/scene.h"
#include "tests/middleware/world/both_worlds.h"
#include "tests/oracle/sweep_inputs.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// Where somebody walks while he dances.
struct Walk {
  Placement place;
  Eigen::Vector3d speed = Eigen::Vector3d::Zero();  // m/s
};

using TimedPoses = std::vector<std::pair<std::int64_t, Pose>>;
/// The clip's poses from its middle on, at about `rateHz`, from `offsetUs` until past `untilUs`;
/// its last pose goes on.
[[nodiscard]] TimedPoses posesOf(const SweepClip& clip, double rateHz, std::int64_t offsetUs,
                                 std::int64_t untilUs, const Walk& walk = {});
void pushAll(BothWorlds& both, BodyId body, const TimedPoses& poses);
/// The same, but the first pose attaches: they are in the frame of the carrier's link.
void rideAll(BothWorlds& both, BodyId body, const Carrier& carrier, const TimedPoses& poses);

/// A rigid body's way: from `pose` on, so much farther and turned by so much every period.
struct Flight {
  RigidPose pose;
  Eigen::Vector3d stepBy = Eigen::Vector3d::Zero();
  Quaternion turnBy = Quaternion::Identity();
  std::int64_t periodUs = 11'111;
};
void fly(BothWorlds& both, BodyId body, Flight flight, std::int64_t untilUs);

/// A ring of `segments` quads about y.
[[nodiscard]] Scene ring(double radius, double height, int segments);
[[nodiscard]] Scene sword();
/// From its hinge, which is y, along x.
[[nodiscard]] Scene doorPanel(double width, double height);
/// A square of `side` in y = 0, about the origin.
[[nodiscard]] Scene platform(double side);
/// So many squares of `side` across x, `apart` from each other.
[[nodiscard]] Scene sheetStack(double side, int count, double apart);

}  // namespace foretouch::test
