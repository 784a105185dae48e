// tools/repair/measures.h: what a repair moved and turned, and what it did to the jerk. Metres,
// radians, seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/skeleton.h"
#include "tools/repair/stage.h"

namespace foretouch::tools {

/// What values over joints and poses come to.
struct Spread {
  double mean = 0.0, p99 = 0.0, most = 0.0;
};

/// Mean over joints and poses, m/s^3.
struct Jerk {
  double before = 0.0, after = 0.0;

  [[nodiscard]] double added() const { return before > 0.0 ? after / before - 1.0 : 0.0; }
};

struct JointMoved {
  JointId joint = 0;           ///< A joint of the body.
  Spread move;                 ///< How far its origin moved in W.
  Spread turn;                 ///< How far its own rotation, in its parent, turned.
  std::int32_t worstPose = 0;  ///< Where it moved most.
};

struct Measures {
  std::int32_t changedPoses = 0;
  Spread move, turn;                ///< For all joints at all poses.
  Spread moveChanged, turnChanged;  ///< For all joints at the poses that changed.
  std::vector<JointMoved> joints;   ///< Those that changed, the farthest moved first.
  Jerk jerk;                        ///< For all poses.
  Jerk jerkChanged;                 ///< About the poses that changed.
};

/// `before`: as many poses of the stage's body as it has now.
[[nodiscard]] Measures measuresOf(const RepairStage& stage, const std::vector<Pose>& before);

}  // namespace foretouch::tools
