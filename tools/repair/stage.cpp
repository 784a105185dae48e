#include "tools/repair/stage.h"

#include <utility>

#include "articulated/try.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/floor/heels.h"
#include "tools/inputs/own_pairs.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {

Result<RepairStage> RepairStage::load(const RepairRequest& request) {
  FORETOUCH_TRY(auto feet, loadFeetInputs(request));
  if (feet.played.clip.framesPerRow > 1) {
    return Error::in(request.motionPath, ErrorCode::OutOfRange,
                     "expected joints that turn by at most 3 rad from one row to the next");
  }
  if (feet.played.isByParts) {
    return Error::in(request.motionPath, ErrorCode::Mismatch,
                     "expected joints with the names of the avatar's, as the mended clip has the "
                     "file's own; here they only have the same parts of the body");
  }
  RepairStage stage(request, std::move(feet));
  FORETOUCH_CHECK(stage.prepare());
  return stage;
}

Result<Done> RepairStage::prepare() {
  const PlayedClip& played = feet_.played;
  feet_.keepsLooks = true;
  original_ = played.clip.frames;
  if (request_.isMadeOfBones()) {
    FORETOUCH_TRY(auto body, avatarWithHeels(played.avatar, feet_.body));
    body_ = std::make_unique<const Avatar>(std::move(body));
  } else {
    body_ = std::make_unique<const Avatar>(played.avatar);
  }
  const Scene& scene = feet_.level.scene();
  FORETOUCH_TRY(auto options, queryOptionsFor(request_, request_.bodyPath(), *body_, scene));
  options.tolerance = kToleranceShare * request_.gap;
  options.scope = Scope::EveryObject;
  if (request_.asksSelf) {
    FORETOUCH_TRY(options.self,
                  pairRulesFor(request_, request_, *body_, played.clip, played.match));
  }
  FORETOUCH_TRY(auto query, Query::build(*body_, scene, options));
  FORETOUCH_TRY(auto near, NearQuery::build(*body_, scene, options.ignored));
  query_ = std::make_unique<const Query>(std::move(query));
  near_ = std::make_unique<const NearQuery>(std::move(near));
  FORETOUCH_TRY(file_, MakerFile::open(request_, played.clip));
  changes_ = Changes::Zero(static_cast<Eigen::Index>(knobs().size()), feet_.steps() + 1);
  return takePoses();
}

Result<Done> RepairStage::takePoses() {
  poses_.clear();
  for (std::int64_t step = 0; step <= feet_.steps(); ++step) {
    FORETOUCH_TRY(auto pose, feet_.poseAt(step));
    pose.rotations.resize(countOf(body_->numLinks()));
    pose.translations.resize(countOf(body_->numLinks()));
    FORETOUCH_TRY(auto valid, validatedPose(body_->skeleton(), std::move(pose)));
    poses_.push_back(std::move(valid));
  }
  return Done{};
}

Result<Done> RepairStage::change(const Changes& changes) {
  changes_ = changes;
  std::vector<Pose>& frames = feet_.played.clip.frames;
  for (Eigen::Index pose = 0; pose < changes.cols(); ++pose) {
    const std::size_t frame = slotOf(frameOf(pose));
    frames[frame] = changedPose(original_[frame], knobs(), changes.col(pose));
  }
  return takePoses();
}

Result<Done> RepairStage::replaceBy(Clip clip) {
  if (clip.frames.size() != original_.size()) {
    return Error::of(ErrorCode::Mismatch, "what was written has another number of frames");
  }
  feet_.played.clip.frames = std::move(clip.frames);
  return takePoses();
}

LinkId RepairStage::linkOf(LinkId resting) const {
  return resting < body_->numLinks() ? resting : feet_.body.avatar.skeleton().parent(resting);
}

Eigen::Matrix3d RepairStage::R_WClip() const {
  const PlayedClip& played = feet_.played;
  for (JointId joint = 0; joint < body_->numLinks(); ++joint) {
    const JointId source = played.match.clipJointOf[slotOf(joint)];
    if (body_->skeleton().parent(joint) != kNoParent || source == kNoParent) continue;
    if (!played.clip.hasRotation[slotOf(source)]) continue;
    const Pose& clip = played.clip.frames[slotOf(frameOf(0))];
    return (Eigen::Quaterniond(poses_.front().rotations[slotOf(joint)]) *
            Eigen::Quaterniond(clip.rotations[slotOf(source)]).conjugate())
        .toRotationMatrix();
  }
  return Eigen::Matrix3d::Identity();
}

bool RepairStage::isCutAfter() const {
  return frameOf(feet_.steps()) + 1 < static_cast<std::int64_t>(original_.size());
}

Changes RepairStage::ofFile(const Changes& changes) const {
  Changes all = Changes::Zero(changes.rows(), static_cast<Eigen::Index>(original_.size()));
  for (Eigen::Index pose = 0; pose < changes.cols(); ++pose) {
    all.col(frameOf(pose)) = changes.col(pose);
  }
  return all;
}

}  // namespace foretouch::tools
