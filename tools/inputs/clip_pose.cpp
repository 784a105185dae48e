#include "tools/inputs/clip_pose.h"

#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "lss/index.h"
#include "tools/console.h"

namespace foretouch::tools {

Result<Pose> poseAtFrame(const PlacedClip& placed, std::int64_t frame) {
  const Skeleton& skeleton = placed.avatar.skeleton();
  Placement placement = placed.placement;
  placement.motionUpZ = placement.motionUpZ && !placed.isUpright;
  Pose pose = poseOfAvatar(skeleton, placed.clip, placed.match, slotOf(frame));
  auto valid = validatedPose(skeleton, foretouch::placed(skeleton, std::move(pose), placement));
  if (valid.ok()) return valid;
  Error error = inFile(valid.error(), placed.path);
  error.message = fmt::format("{} {}: {}", placed.clip.framesPerRow > 1 ? "row" : "frame",
                              frame / placed.clip.framesPerRow, error.message);
  return error;
}

}  // namespace foretouch::tools
