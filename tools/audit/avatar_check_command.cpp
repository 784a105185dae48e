#include "tools/audit/avatar_check_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assets/avatar/avatar_file.h"
#include "assets/avatar/joint_match.h"
#include "assets/mesh/link_mesh.h"
#include "tools/arguments.h"
#include "tools/audit/audits.h"
#include "tools/audit/surface_audit.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

struct CheckTexts {
  std::string avatar, motion, animation, robot, map, scale = "1", motionUp = "y";
  std::vector<std::string> packages;
};

/// What is said on stdout, and what the check says no to.
struct Findings {
  std::string text;
  std::vector<std::string> doubts;
};

Result<Clip> readClip(const CheckTexts& texts) {
  MotionRequest request;
  request.path = texts.motion;
  request.animation = texts.animation;
  request.robot = texts.robot;
  request.packagePaths = texts.packages;
  const auto scale = parsePositive("--scale", texts.scale);
  if (!scale.ok()) return scale.error();
  request.scale = scale.value();
  const auto up = parseUpAxis("--motion-up", texts.motionUp);
  if (!up.ok()) return up.error();
  request.up = up.value();
  auto motion = readMotion(request);
  if (!motion.ok()) return motion.error();
  for (const std::string& note : motion.value().clip.notes) printNote(texts.motion + ": " + note);
  return std::move(motion).value().clip;
}

/// How the clip's joints and the avatar's go together, in words; `pose` becomes the first frame's,
/// and a clip that seems to be in another unit is among the doubts.
/// An error of code Mismatch, where nothing matches, is what the check says no to.
Result<std::string> matchOf(const CheckTexts& texts, const Avatar& avatar, const Clip& clip,
                            Pose& pose, std::vector<std::string>& doubts) {
  const auto match = matchWithMap(avatar.skeleton(), clip.skeleton, texts.map, texts.motion);
  if (!match.ok()) return match.error();
  auto first =
      validatedPose(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match.value(), 0));
  if (!first.ok()) return first.error();
  pose = std::move(first).value();
  const auto unit = remarkOnUnit(avatar, clip, match.value(), texts.motion);
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

/// The match with the clip; `pose` becomes the first frame's, where there is a match.
Result<Done> checkMotion(const CheckTexts& texts, const Avatar& avatar, Pose& pose,
                         Findings& findings) {
  const auto clip = readClip(texts);
  if (!clip.ok()) return clip.error();
  const auto match = matchOf(texts, avatar, clip.value(), pose, findings.doubts);
  if (match.ok()) {
    findings.text += match.value();
  } else if (match.error().code == ErrorCode::Mismatch) {
    findings.doubts.push_back(describe(match.error()));
  } else {
    return inFile(match.error(), texts.motion);
  }
  return Done{};
}

Result<Done> checkMeshes(const CheckTexts& texts, const Avatar& avatar, Findings& findings) {
  bool any = false;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    any = any || !avatar.mesh(link).file.empty();
  }
  if (!any) return Done{};
  const auto meshes = loadLinkMeshes(avatar, texts.avatar);
  if (!meshes.ok()) return inFile(meshes.error(), texts.avatar);
  const SurfaceAudit audit = auditSurface(avatar, meshes.value());
  findings.text += describe(audit);
  for (const std::string& doubt : doubtsAbout(audit)) findings.doubts.push_back(doubt);
  return Done{};
}

ExitCode check(const CheckTexts& texts) {
  const auto read = readAvatarFile(texts.avatar);
  if (!read.ok()) return failed(inFile(read.error(), texts.avatar));
  const Avatar& avatar = read.value();
  Pose pose = restPose(avatar.skeleton());
  Findings findings;
  const bool hasMotion = !texts.motion.empty();
  if (hasMotion) {
    const auto done = checkMotion(texts, avatar, pose, findings);
    if (!done.ok()) return failed(done.error());
  }
  const auto done = checkMeshes(texts, avatar, findings);
  if (!done.ok()) return failed(done.error());
  const AvatarAudit audit = auditAvatar(avatar, pose);
  printOut(texts.avatar + "\n" + describe(audit, hasMotion ? "first frame" : "rest pose") +
           findings.text);
  for (const std::string& doubt : doubtsAbout(audit)) findings.doubts.push_back(doubt);
  for (const std::string& doubt : findings.doubts) printError(texts.avatar + ": " + doubt);
  return findings.doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace

void addAvatarCheckCommand(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<CheckTexts>();
  CLI::App* const command = avatar.add_subcommand("check",
                                                  "Measure an avatar; exit code 1 where its size, "
                                                  "its meshes or its match with a clip is amiss");
  command->add_option("avatar", texts->avatar, "Avatar file")->type_name("AVATAR")->required();
  CLI::Option* const motion =
      command
          ->add_option("--motion", texts->motion,
                       "Clip to match joints with, by name: BVH, animated model, or csv")
          ->type_name("CLIP");
  const auto ofMotion = [&](const char* name, std::string& text, const char* type,
                            const char* help) {
    command->add_option(name, text, help)->type_name(type)->needs(motion);
  };
  ofMotion("--map", texts->map, "FILE",
           R"(Joint names that differ: {"avatar joint": "clip joint"})");
  ofMotion("--animation", texts->animation, "NAME", "Which animation of a model");
  ofMotion("--robot", texts->robot, "URDF", "The robot that joint positions are about");
  ofMotion("--motion-up", texts->motionUp, "y|z", "Which axis of a model points up");
  command
      ->add_option("--package", texts->packages, "Folder of the robot's packages; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->add_option("--scale", texts->scale, "Metres per unit of the clip: 0.01 for centimetres")
      ->type_name("S")
      ->capture_default_str();
  command->footer(
      "Example:\n  foretouch avatar check walker.avatar.json --motion walk.bvh --scale 0.01");
  command->callback([texts, &exit] { exit = check(*texts); });
}

}  // namespace foretouch::tools
