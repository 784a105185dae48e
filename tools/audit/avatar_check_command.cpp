#include "tools/audit/avatar_check_command.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/json_writer.h"
#include "assets/mesh/link_mesh.h"
#include "lss/index.h"
#include "tools/audit/audit_json.h"
#include "tools/audit/audits.h"
#include "tools/audit/surface_audit.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedAvatar : ClipRequest {
  bool asJson = false, listsLinks = false;
};

/// The text for stdout, and the findings that fail the check.
struct Findings {
  std::string text;
  std::optional<JointMatch> match;
  std::vector<std::string> doubts;
};

std::string linkTable(const Avatar& avatar) {
  const Skeleton& skeleton = avatar.skeleton();
  std::string text = fmt::format("\n{:<32}{:<32}{:>5}\n", "link", "parent", "LSS");
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const JointId parent = skeleton.parent(link);
    text += fmt::format("{:<32}{:<32}{:>5}\n", skeleton.name(link),
                        parent == kNoParent ? "" : skeleton.name(parent), avatar.lss(link).size());
  }
  return text;
}

void noteOn(const ClipRequest& asked, const Motion& motion) {
  for (const std::string& note : motion.clip.notes) {
    printNote(asked.motionPath + ": " + note);
  }
  const auto frame = remarkOnFrame(motion.frame, {"--clip-scale", "--clip-up"}, asked.motionPath);
  if (frame) printNote(*frame);
}

/// How the clip's joints match the avatar's; `pose` becomes the first frame's, and a clip that
/// seems to be in another unit adds a doubt. An error of code Mismatch, if nothing matches, fails
/// the check.
Result<Done> findMatch(const ClipRequest& asked, const Avatar& avatar, const Motion& motion,
                       Pose& pose, Findings& findings) {
  const Clip& clip = motion.clip;
  auto match = matchWithMap(avatar.skeleton(), clip.skeleton, asked.mapPath, asked.motionPath);
  if (!match.ok()) return match.error();
  auto first = poseAtFrame(
      {avatar, clip, match.value(), asked.placement, motion.isUpright, asked.motionPath}, 0);
  if (!first.ok()) return first.error();
  pose = std::move(first).value();
  const auto lying = remarkOnFirstPose(avatar, pose, motion.frame, asked.motionPath);
  if (lying) printNote(*lying);
  const auto unit = remarkOnUnit(avatar, clip, match.value(), asked.motionPath);
  if (unit) findings.doubts.push_back(*unit);
  const auto& [clipJointOf, unmatchedAvatar, unmatchedClip] = match.value();
  std::string& text = findings.text;
  text += fmt::format("  {:<25}{} of {}\n", "joints matched",
                      clipJointOf.size() - unmatchedAvatar.size(), clipJointOf.size());
  if (!unmatchedAvatar.empty()) {
    text += fmt::format("  {:<25}{}\n", "  keep their rest", firstOf(unmatchedAvatar));
  }
  if (!unmatchedClip.empty()) {
    text += fmt::format("  {:<25}{}\n", "  drive nothing", firstOf(unmatchedClip));
  }
  findings.match = std::move(match).value();
  return Done{};
}

/// The match with the clip; `pose` becomes the first frame's, if there is a match.
Result<Done> checkMotion(const ClipRequest& asked, const Avatar& avatar, Pose& pose,
                         Findings& findings) {
  FORETOUCH_TRY(auto motion, readMotion(motionRequestOf(asked)));
  const auto followed =
      followByParts(avatar.skeleton(), asked.mapPath, asked.motionPath, motion.clip);
  noteOn(asked, motion);
  const auto match =
      followed.ok() ? findMatch(asked, avatar, motion, pose, findings) : followed.error();
  if (match.ok()) return Done{};
  if (match.error().code != ErrorCode::Mismatch) return inFile(match.error(), asked.motionPath);
  findings.doubts.push_back(describe(match.error()));
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

std::string avatarJson(const AskedAvatar& asked, const Avatar& avatar, const AvatarAudit& audit,
                       const Findings& findings) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("avatar", asked.avatarPath);
  out.field("pose", asked.motionPath.empty() ? "rest pose" : "first frame");
  writeFields(audit, out);
  writeLinks(avatar, out);
  if (findings.match) writeMatch(*findings.match, out);
  out.field("doubts", findings.doubts);
  out.endObject();
  return text + "\n";
}

ExitCode check(const AskedAvatar& asked) {
  FORETOUCH_TRY_OR(failed, const auto avatar, readAvatarFile(asked.avatarPath));
  Pose pose = restPose(avatar.skeleton());
  Findings findings;
  const bool hasMotion = !asked.motionPath.empty();
  if (hasMotion) {
    FORETOUCH_CHECK_OR(failed, checkMotion(asked, avatar, pose, findings));
  }
  FORETOUCH_CHECK_OR(failed, checkMeshes(asked, avatar, findings));
  const AvatarAudit audit = auditAvatar(avatar, pose);
  for (const std::string& doubt : doubtsAbout(audit)) findings.doubts.push_back(doubt);
  printOut(asked.asJson ? avatarJson(asked, avatar, audit, findings)
                        : asked.avatarPath + "\n" +
                              describe(audit, hasMotion ? "first frame" : "rest pose") +
                              findings.text + (asked.listsLinks ? linkTable(avatar) : ""));
  for (const std::string& doubt : findings.doubts) printError(asked.avatarPath + ": " + doubt);
  return findings.doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

Command avatarCheckCommand() {
  const auto asked = std::make_shared<AskedAvatar>();
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
  settings.flag("--links", asked->listsLinks, "Also list the links: names, parents, LSS")
      .in(kOutputGroup);
  settings.asJson(asked->asJson);
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
