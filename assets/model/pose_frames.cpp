#include "assets/model/pose_frames.h"

#include <algorithm>
#include <utility>

#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_text.h"
#include "assets/model/model_ownership.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// Metres from the rest offset. Keys in single precision repeat it no more exactly; a translation
/// that only repeats it must not override the offset of an avatar of other build.
constexpr double kSameOffset = 1e-6;

/// Relative to the shape: above the single-precision rounding of keys that keep it rigid.
constexpr double kNoticeableShear = 1e-3;

}  // namespace

FrameCollector::FrameCollector(const Model& model, ModelLinks links)
    : model_(&model),
      links_(std::move(links)),
      isTurned_(links_.nodeOfLink.size(), false),
      isMoved_(links_.nodeOfLink.size(), false),
      farthestFromRest_(links_.nodeOfLink.size(), 0.0),
      worstShear_(links_.nodeOfLink.size(), 0.0) {}

Result<FrameCollector> FrameCollector::create(const Model& model, std::size_t frames) {
  FORETOUCH_CHECK(checkModel(model));
  FORETOUCH_TRY(auto links, modelLinks(model, ownershipOf(model)));
  const std::size_t most = kMaxBvhValues / 3 / std::max<std::size_t>(model.nodes.size(), 1);
  if (frames > most) {
    return Error::of(ErrorCode::LimitExceeded, "expected at most " + std::to_string(most) +
                                                   " frames of " +
                                                   std::to_string(model.nodes.size()) +
                                                   " nodes, found " + std::to_string(frames));
  }
  return FrameCollector(model, std::move(links));
}

/// A pivot turns its link about a point elsewhere, which shifts it too; take() checks whether it
/// does.
void FrameCollector::moves(std::int32_t node, bool turns) {
  const LinkId link = links_.servedLink[slotOf(node)];
  if (link == kNoParent) return;
  isMoved_[slotOf(link)] = true;
  if (turns) isTurned_[slotOf(link)] = true;
}

Result<Done> FrameCollector::add(const std::vector<Affine>& toParent) {
  auto pose = validatedPose(links_.skeleton, poseOfFrames(*model_, links_, toParent, worstShear_));
  if (!pose.ok()) {
    Error error = pose.error();
    error.message = "frame " + std::to_string(frames_.size()) + ": " + error.message;
    return error;
  }
  for (std::size_t link = 0; link < farthestFromRest_.size(); ++link) {
    const Eigen::Vector3d& rest = links_.skeleton.restOffset(static_cast<LinkId>(link));
    const double off = (pose.value().translations[link] - rest).norm();
    farthestFromRest_[link] = std::max(farthestFromRest_[link], off / (1.0 + rest.norm()));
  }
  frames_.push_back(std::move(pose).value());
  return Done{};
}

Clip FrameCollector::take(double frameTimeS, std::vector<std::string> said) {
  ClipNotes notes;
  for (std::string& note : said) notes.add(std::move(note));
  std::vector<std::string> sheared;
  for (std::size_t link = 0; link < worstShear_.size(); ++link) {
    if (worstShear_[link] > kNoticeableShear) {
      sheared.push_back(links_.skeleton.name(static_cast<LinkId>(link)));
    }
  }
  if (!sheared.empty()) {
    notes.add(
        "links are rigid: joints that the file shears or scales as they move follow by their "
        "nearest rotation: " +
        listed(sheared));
  }
  Clip clip{links_.skeleton, frameTimeS, std::move(frames_), {}, std::move(isTurned_), {}, {}};
  for (std::size_t link = 0; link < isMoved_.size(); ++link) {
    clip.hasTranslation.push_back(isMoved_[link] && farthestFromRest_[link] > kSameOffset);
  }
  clip.endSites.resize(isMoved_.size());
  clip.notes = notes.take();
  return clip;
}

}  // namespace foretouch::internal
