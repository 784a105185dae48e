// tools/inputs/pose_curve.h: a cubic through the poses of a replay, in place of a constant rate
// between each two of them: as so many poses that the constant rate between those is the cubic, to
// within what a query's answer leaves room for. Metres, seconds.
#pragma once

#include <cstdint>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "articulated/skeleton.h"
#include "tools/inputs/step_selection.h"

namespace foretouch::tools {

/// Placed poses, and what they stand for.
struct PoseCurve {
  MotionModel model = MotionModel::CubicLate;
  std::vector<Pose> poses;  ///< As many pieces of constant rate as `pieces` per given step.
  std::int64_t pieces = 1;  ///< A multiple of the given stride.
  double offM = 0.0;        ///< No point of a link is farther from the cubic.
  StepSelection given;      ///< In the clip's own frames.
  double frameTimeS = 0.0;  ///< Seconds between those frames.
};

/// `poses`: those at all steps and at the last one's end, `seconds` apart. Errors: too many pieces
/// are needed to stay within `mostOffM`.
[[nodiscard]] Result<PoseCurve> poseCurve(const Avatar& avatar, const std::vector<Pose>& poses,
                                          double seconds, MotionModel model, std::int64_t stride,
                                          double mostOffM);

}  // namespace foretouch::tools
