#include "tools/stream/clip_sender.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "articulated/raw_skeleton.h"
#include "articulated/try.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

double stepLengthS(const PlacedClip& placed, const StepSelection& steps) {
  return static_cast<double>(steps.stride) * placed.clip.frameTimeS;
}

}  // namespace

ClipSender::ClipSender(const PlacedClip& placed, const StepSelection& steps,
                       const SenderOptions& options)
    : placed_(placed), steps_(steps), options_(options) {
  skeleton_.avatar = options.avatar;
  skeleton_.session = options.startUtimeUs;
  skeleton_.source = options.source;
  skeleton_.rateHz = 1.0 / stepLengthS(placed, steps);
  skeleton_.skeleton = rawSkeleton(placed.avatar.skeleton());
  skeleton_.hash = skeletonHash(skeleton_.skeleton);
}

std::int64_t ClipSender::utimeOf(std::int64_t pose) const {
  constexpr double kUsPerS = 1e6;
  // Frames are at least a microsecond apart. Subtracts the whole microsecond before rounding, which
  // then cannot make two stamps equal: the rest does not decrease.
  const double beyondOneUs = std::max(0.0, stepLengthS(placed_, steps_) * kUsPerS - 1.0);
  return options_.startUtimeUs + pose + std::llround(static_cast<double>(pose) * beyondOneUs);
}

SkeletonMessage ClipSender::skeleton(std::int64_t sendUtimeUs) const {
  SkeletonMessage message = skeleton_;
  message.sendUtimeUs = sendUtimeUs;
  return message;
}

Result<Done> ClipSender::fill(std::int64_t pose, std::int64_t sendUtimeUs,
                              PoseMessage& message) const {
  FORETOUCH_TRY(const auto valid, poseAtFrame(placed_, pose * steps_.stride));
  message.avatar = options_.avatar;
  message.session = options_.startUtimeUs;
  message.sequence = pose;
  message.utimeUs = utimeOf(pose);
  message.sendUtimeUs = sendUtimeUs;
  message.skeletonHash = skeleton_.hash;
  message.joints.clear();
  message.translations.clear();
  const Skeleton& skeleton = placed_.avatar.skeleton();
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    const auto j = slotOf(joint);
    const JointId source = placed_.match.clipJointOf[j];
    const auto s = static_cast<std::size_t>(source);
    const bool isTurned = source != kNoParent && placed_.clip.hasRotation[s];
    const bool isMoved = source != kNoParent && placed_.clip.hasTranslation[s];
    const int how = isTurned || isMoved ? kJointTracked : kJointInferred;
    message.joints.push_back(
        {joint, static_cast<std::uint8_t>(kJointValid | how), valid.rotations[j]});
    if (isMoved || skeleton.parent(joint) == kNoParent) {
      message.translations.push_back({joint, valid.translations[j]});
    }
  }
  return Done{};
}

}  // namespace foretouch::tools
