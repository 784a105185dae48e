#include "tools/inputs/played_clip.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/inputs/clip_cut.h"
#include "tools/inputs/joint_map.h"

namespace foretouch::tools {
namespace {

/// The steps of the part of the clip that the request cuts out.
Result<StepSelection> stepsOf(const ClipRequest& request, const Clip& clip, bool isUpright) {
  FORETOUCH_TRY(const auto cut, framesOf(request, clip, isUpright));
  if (const auto remark = remarkOnTPose(request, cut, clip)) printNote(*remark);
  FORETOUCH_TRY(auto steps,
                inFile(selectSteps(cut.count(), clip.frameTimeS, request.rateHz, mostStride(clip)),
                       request.motionPath));
  steps.first = cut.first;
  return steps;
}

Result<Avatar> bodyOf(const ClipRequest& request, const Clip& clip) {
  if (request.robotPath.empty()) return inFile(avatarFromClip(clip), request.motionPath);
  FORETOUCH_TRY(const auto model, readRobotModel(clipFileOptionsOf(motionRequestOf(request))));
  FORETOUCH_TRY(auto made, inFile(avatarFromModel(model), request.robotPath));
  printNotes(request.robotPath, model.notes);
  return std::move(made.avatar);
}

}  // namespace

Result<PlayedClip> loadPlayedClip(const ClipRequest& request) {
  FORETOUCH_TRY(auto avatar, readAvatarFile(request.avatarPath));
  FORETOUCH_TRY(auto read, readMotion(motionRequestOf(request)));
  Clip& clip = read.clip;
  FORETOUCH_TRY(const bool isByParts,
                followByParts(avatar.skeleton(), request.mapPath, request.motionPath, clip));
  auto match = matchWithMap(avatar.skeleton(), clip.skeleton, request.mapPath, request.motionPath);
  if (!match.ok()) return match.error();
  FORETOUCH_TRY(const auto steps, stepsOf(request, clip, read.isUpright));
  return PlayedClip{
      std::move(avatar), std::move(clip), std::move(match).value(), steps, read.isUpright,
      read.frame,        isByParts};
}

Result<PlayedClip> loadClipAlone(const ClipRequest& request) {
  FORETOUCH_TRY(auto read, readMotion(motionRequestOf(request)));
  Clip& clip = read.clip;
  FORETOUCH_TRY(auto avatar, bodyOf(request, clip));
  FORETOUCH_TRY(auto match,
                inFile(matchJoints(avatar.skeleton(), clip.skeleton), request.motionPath));
  FORETOUCH_TRY(const auto steps, stepsOf(request, clip, read.isUpright));
  return PlayedClip{std::move(avatar), std::move(clip), std::move(match), steps,
                    read.isUpright,    read.frame};
}

std::vector<std::string> remarksOnClip(const Avatar& avatar, const Clip& clip,
                                       const JointMatch& match, const std::string& avatarPath,
                                       const std::string& motionPath) {
  std::vector<std::string> remarks;
  for (const std::string& note : clip.notes) {
    remarks.push_back(motionPath + ": " + note);
  }
  if (!match.unmatchedAvatar.empty()) {
    remarks.push_back(
        fmt::format("{}: {} of {} joints have no counterpart in the clip and keep "
                    "their rest values: {}",
                    avatarPath, match.unmatchedAvatar.size(), avatar.numLinks(),
                    firstOf(match.unmatchedAvatar)));
  }
  if (!match.unmatchedClip.empty()) {
    remarks.push_back(fmt::format("{}: {} joints drive nothing: {}", motionPath,
                                  match.unmatchedClip.size(), firstOf(match.unmatchedClip)));
  }
  const bool isRobot = clipFormatOf(motionPath) == ClipFormat::JointTable;
  for (const auto& remark : {remarkOnVolume(avatar, avatarPath, isRobot),
                             remarkOnUnit(avatar, clip, match, motionPath)}) {
    if (remark) remarks.push_back(*remark);
  }
  return remarks;
}

std::optional<std::string> remarkOnVolume(const Avatar& avatar, const std::string& avatarPath,
                                          bool isRobot) {
  std::vector<std::string> bare;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (avatar.lss(link).empty()) bare.push_back(avatar.skeleton().name(link));
  }
  if (bare.empty() || (!isRobot && 2 * bare.size() < countOf(avatar.numLinks()))) {
    return std::nullopt;
  }
  return fmt::format("{}: {} of {} links have no volume, so they touch nothing: {}", avatarPath,
                     bare.size(), avatar.numLinks(), firstOf(bare));
}

std::optional<std::string> remarkOnUnit(const Avatar& avatar, const Clip& clip,
                                        const JointMatch& match, const std::string& motionPath) {
  const auto ratio = suspiciousSize(avatar.skeleton(), clip.skeleton, match);
  if (!ratio) return std::nullopt;
  const std::size_t matched = match.clipJointOf.size() - match.unmatchedAvatar.size();
  const std::string lead =
      fmt::format("{}: its bones are {:.4g} times as long as the avatar's", motionPath, *ratio);
  // Bones between matched joints skip the others, so their lengths say little about the unit.
  if (2 * matched < match.clipJointOf.size()) {
    return lead + fmt::format(
                      ", by the {} of {} joints that match; does --map say which belong "
                      "together?",
                      matched, match.clipJointOf.size());
  }
  return lead +
         fmt::format("; is --clip-scale right? {:.3g} times as much would fit", 1.0 / *ratio);
}

std::string firstOf(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) {
    text += (i == 0 ? "" : ", ") + inQuotes(names[i]);
  }
  if (names.size() > kShown) text += fmt::format(" and {} more", names.size() - kShown);
  return text;
}

}  // namespace foretouch::tools
