#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "assets/bvh/bvh_reader.h"
#include "lss/index.h"
#include "tools/feet/feet_inputs.h"
#include "tools/floor/in_place.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/t_pose.h"
#include "tools/settings/plain_figures.h"
#include "tools/setup/body_offer.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// People of this height (m) are believed.
constexpr double kShortest = 0.5, kTallest = 3.0;

/// People do not move by more than this (m) and faster than this (m/s).
constexpr double kFarJump = 1.0, kFastJump = 100.0;

std::optional<std::string> remarkOnScene(const FeetInputs& inputs) {
  const std::size_t dropped = inputs.level.scene().audit().droppedNonFinite;
  if (dropped == 0) return std::nullopt;
  return fmt::format(
      "{}: {} triangles with a vertex that is not finite were left out: there is no ground there",
      inputs.request.scenePath, dropped);
}

std::optional<std::string> remarkOnTPose(const FeetInputs& inputs) {
  const PlayedClip& played = inputs.played;
  const bool isZUp = inputs.request.placement.motionUpZ && !played.isUpright;
  const std::int64_t frames = tPoseFramesOf(played.clip, isZUp);
  if (frames <= played.steps.frameOf(0)) return std::nullopt;
  return fmt::format(
      "{}: it begins with a T-pose, {} ({:.4g} s), and how that stands is told as well: "
      "--skip-t-pose leaves it out",
      inputs.request.motionPath,
      frames == 1 ? "the first frame" : fmt::format("the first {} frames", frames),
      static_cast<double>(frames) * played.clip.frameTimeS);
}

/// How far a root of the clip moves in a step.
double wayOf(const Clip& clip, std::int64_t from, std::int64_t to) {
  const Pose &a = clip.frames[slotOf(from)], &b = clip.frames[slotOf(to)];
  double way = 0.0;
  for (JointId joint = 0; joint < clip.skeleton.numJoints(); ++joint) {
    if (clip.skeleton.parent(joint) != kNoParent) continue;
    way = std::max(way, (b.translations[slotOf(joint)] - a.translations[slotOf(joint)]).norm());
  }
  return way;
}

/// A marker that was lost, or two takes in one file.
std::optional<std::string> remarkOnJumps(const FeetInputs& inputs) {
  const auto& steps = inputs.played.steps;
  std::size_t jumps = 0;
  std::int64_t first = 0;
  double farthest = 0.0;
  for (std::int64_t step = 0; step < inputs.steps(); ++step) {
    const double way = wayOf(inputs.played.clip, steps.frameOf(step), steps.frameOf(step + 1));
    if (way < kFarJump || way < kFastJump * inputs.stepS()) continue;
    if (jumps++ == 0) first = step;
    farthest = std::max(farthest, way);
  }
  if (jumps == 0) return std::nullopt;
  return fmt::format(
      "{}: between frames {} and {} the body jumps{}, by {} m at most: what it touches on the way "
      "is told as if it moved",
      inputs.request.motionPath, steps.frameOf(first), steps.frameOf(first + 1),
      jumps == 1 ? "" : fmt::format(", as in {} steps more", jumps - 1), plainFigures(farthest));
}

std::optional<std::string> remarkOnPlace(const FeetInputs& inputs) {
  const auto poses = [&](std::int64_t step) { return inputs.poseAt(step); };
  const auto speed = walksInPlace(inputs.body, inputs.steps(), inputs.stepS(), poses);
  if (!speed) return std::nullopt;
  return fmt::format(
      "{}: it walks in place, for something else to move it: each foot that bears slides, on "
      "average at {:.2f} m/s",
      inputs.request.motionPath, *speed);
}

/// For an avatar that was given.
std::optional<std::string> remarkOnHeels(const FeetInputs& inputs) {
  if (inputs.heelsMissing == 0) return std::nullopt;
  return fmt::format(
      "{}: {} of its feet {} no heel: the rear end is the ankle, above the level of the ball, so "
      "that heel touches late or never; foretouch avatar bvh --heels makes heels",
      inputs.request.avatarPath, inputs.heelsMissing, inputs.heelsMissing == 1 ? "has" : "have");
}

}  // namespace

std::optional<std::string> doubtOfStature(const FeetInputs& inputs) {
  const auto stature = statureOf(inputs.played.avatar.skeleton());
  if (!stature || (*stature >= kShortest && *stature <= kTallest)) return std::nullopt;
  const FeetRequest& request = inputs.request;
  std::string unit = "is the unit (--clip-scale) right?";
  const double read = request.motionScale.value_or(1.0);
  const Offer<double> offer = unitOf(inputs.played.clip, false, read);
  if (request.isMadeOfBones() && offer.isSure) {
    unit = fmt::format("{} (--clip-scale {})", offer.reason, plainFigures(read * offer.value));
  }
  return fmt::format(
      "the body is {} m tall, by the length of its legs, and all thresholds are for people: {}",
      plainFigures(*stature), unit);
}

std::vector<std::string> remarksOn(const FeetInputs& inputs) {
  const FeetRequest& request = inputs.request;
  const PlayedClip& played = inputs.played;
  std::vector<std::string> remarks = remarksOnClip(played.avatar, played.clip, played.match,
                                                   request.bodyPath(), request.motionPath);
  const auto add = [&](const std::optional<std::string>& remark) {
    if (remark) remarks.push_back(*remark);
  };
  if (const auto doubt = doubtOfStature(inputs)) add(request.motionPath + ": " + *doubt);
  add(remarkOnScene(inputs));
  add(remarkOnTPose(inputs));
  add(remarkOnJumps(inputs));
  add(remarkOnPlace(inputs));
  add(remarkOnHeels(inputs));
  const auto first = inputs.poseAt(0);
  if (first.ok()) {
    add(remarkOnFirstPose(inputs.body.avatar, first.value(), played.frame, request.motionPath));
  }
  add(remarkOnRate(played.steps, played.clip, request.rateHz));
  if (request.isMadeOfBones()) {
    remarks.push_back(
        request.motionPath +
        ": without --avatar, the body is made of the clip's bones: how thick its "
        "soles are is an estimate, which --ground fit takes out" +
        (inputs.heelsMade > 0 ? "; its heels are let down to the level of its balls" : ""));
  }
  return remarks;
}

}  // namespace foretouch::tools
