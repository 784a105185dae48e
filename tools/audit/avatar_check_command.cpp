#include "tools/audit/avatar_check_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/mesh/link_mesh.h"
#include "tools/audit/audits.h"
#include "tools/audit/surface_audit.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

/// The text for stdout, and the findings that fail the check.
struct Findings {
  std::string text;
  std::vector<std::string> doubts;
};

Result<Motion> readClip(const ClipRequest& asked) {
  FORETOUCH_TRY(auto motion, readMotion(motionRequestOf(asked)));
  for (const std::string& note : motion.clip.notes) {
    printNote(asked.motionPath + ": " + note);
  }
  const auto frame = remarkOnFrame(motion.frame, {"--clip-scale", "--clip-up"}, asked.motionPath);
  if (frame) printNote(*frame);
  return motion;
}

/// How the clip's joints match the avatar's, in words; `pose` becomes the first frame's, and a clip
/// that seems to be in another unit adds a doubt. An error of code Mismatch, if nothing matches,
/// fails the check.
Result<std::string> matchOf(const ClipRequest& asked, const Avatar& avatar, const Motion& motion,
                            Pose& pose, std::vector<std::string>& doubts) {
  const Clip& clip = motion.clip;
  const auto match =
      matchWithMap(avatar.skeleton(), clip.skeleton, asked.mapPath, asked.motionPath);
  if (!match.ok()) return match.error();
  auto first = poseAtFrame(
      {avatar, clip, match.value(), asked.placement, motion.isUpright, asked.motionPath}, 0);
  if (!first.ok()) return first.error();
  pose = std::move(first).value();
  const auto lying = remarkOnFirstPose(avatar, pose, motion.frame, asked.motionPath);
  if (lying) printNote(*lying);
  const auto unit = remarkOnUnit(avatar, clip, match.value(), asked.motionPath);
  if (unit) doubts.push_back(*unit);
  const auto& [clipJointOf, unmatchedAvatar, unmatchedClip] = match.value();
  std::string text = fmt::format("  {:<25}{} of {}\n", "joints matched",
                                 clipJointOf.size() - unmatchedAvatar.size(), clipJointOf.size());
  if (!unmatchedAvatar.empty()) {
    text += fmt::format("  {:<25}{}\n", "  keep their rest", firstOf(unmatchedAvatar));
  }
  if (!unmatchedClip.empty()) {
    text += fmt::format("  {:<25}{}\n", "  drive nothing", firstOf(unmatchedClip));
  }
  return text;
}

/// The match with the clip; `pose` becomes the first frame's, if there is a match.
Result<Done> checkMotion(const ClipRequest& asked, const Avatar& avatar, Pose& pose,
                         Findings& findings) {
  FORETOUCH_TRY(const auto motion, readClip(asked));
  const auto match = matchOf(asked, avatar, motion, pose, findings.doubts);
  if (match.ok()) {
    findings.text += match.value();
  } else if (match.error().code == ErrorCode::Mismatch) {
    findings.doubts.push_back(describe(match.error()));
  } else {
    return inFile(match.error(), asked.motionPath);
  }
  return Done{};
}

Result<Done> checkMeshes(const ClipRequest& asked, const Avatar& avatar, Findings& findings) {
  bool any = false;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    any = any || !avatar.mesh(link).file.empty();
  }
  if (!any) return Done{};
  FORETOUCH_TRY(const auto meshes, loadLinkMeshes(avatar, asked.avatarPath));
  const SurfaceAudit audit = auditSurface(avatar, meshes);
  findings.text += describe(audit);
  for (const std::string& doubt : doubtsAbout(audit)) findings.doubts.push_back(doubt);
  return Done{};
}

ExitCode check(const ClipRequest& asked) {
  FORETOUCH_TRY_OR(failed, const auto avatar, readAvatarFile(asked.avatarPath));
  Pose pose = restPose(avatar.skeleton());
  Findings findings;
  const bool hasMotion = !asked.motionPath.empty();
  if (hasMotion) {
    FORETOUCH_CHECK_OR(failed, checkMotion(asked, avatar, pose, findings));
  }
  FORETOUCH_CHECK_OR(failed, checkMeshes(asked, avatar, findings));
  const AvatarAudit audit = auditAvatar(avatar, pose);
  printOut(asked.avatarPath + "\n" + describe(audit, hasMotion ? "first frame" : "rest pose") +
           findings.text);
  for (const std::string& doubt : doubtsAbout(audit)) findings.doubts.push_back(doubt);
  for (const std::string& doubt : findings.doubts) printError(asked.avatarPath + ": " + doubt);
  return findings.doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

Command avatarCheckCommand() {
  const auto asked = std::make_shared<ClipRequest>();
  Settings settings;
  Setting& avatar = addAvatarSetting(settings, *asked).required("an avatar file");
  avatar.option = "avatar";
  avatar.value = "AVATAR";
  avatar.help = "Avatar file";
  addMotionSetting(settings, *asked, "--motion", "CLIP",
                   "Clip to match joints with, by name: BVH, animated model, or csv");
  addClipReadingSettings(settings, *asked);
  for (const char* const option : {"--map", "--animation", "--robot", "--clip-up"}) {
    settings.of(option).needing("--motion");
  }
  Command command{
      "check",
      "Measure an avatar; exit code 1 where its size, its meshes or its match with a clip is amiss",
      "Example:\n  foretouch avatar check walker.avatar.json --motion walk.bvh --clip-scale 0.01",
      std::move(settings)};
  command.takesProject = true;
  command.run = [asked](const Settings&) { return check(*asked); };
  return command;
}

}  // namespace foretouch::tools
