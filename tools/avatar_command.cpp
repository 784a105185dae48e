#include "tools/avatar_command.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "articulated/avatar_file.h"
#include "articulated/bvh_avatar.h"
#include "articulated/bvh_reader.h"
#include "articulated/joint_match.h"
#include "tools/arguments.h"
#include "tools/audits.h"
#include "tools/joint_map.h"
#include "tools/replay_inputs.h"

namespace foretouch::tools {
namespace {

struct BvhTexts {
  std::string clip, output, scale = "1", radiusScale = "1";
};

struct CheckTexts {
  std::string avatar, motion, map, scale = "1";
};

Result<Clip> readClip(const std::string& path, const std::string& scaleText) {
  const auto scale = parsePositive("--scale", scaleText);
  if (!scale.ok()) return scale.error();
  auto clip = readBvhFile(path, BvhOptions{scale.value()});
  if (!clip.ok()) return inFile(clip.error(), path);
  for (const std::string& note : clip.value().notes) printNote(path + ": " + note);
  return clip;
}

ExitCode makeFromBvh(const BvhTexts& texts) {
  BvhAvatarOptions options;
  const auto radiusScale = parsePositive("--radius-scale", texts.radiusScale);
  if (!radiusScale.ok()) return failed(radiusScale.error());
  options.radiusScale = radiusScale.value();
  const auto separate = checkIsNoInput(texts.output, {texts.clip});
  if (!separate.ok()) return failed(separate.error());
  const auto clip = readClip(texts.clip, texts.scale);
  if (!clip.ok()) return failed(clip.error());
  const auto avatar = avatarFromClip(clip.value(), options);
  if (!avatar.ok()) return failed(inFile(avatar.error(), texts.clip));
  const auto written = writeAvatarFile(avatar.value(), texts.output);
  if (!written.ok()) return failed(inFile(written.error(), texts.output));

  const AvatarAudit audit = auditAvatar(avatar.value(), restPose(avatar.value().skeleton()));
  printOut(texts.output + "\n" + describe(audit, "rest pose"));
  for (const std::string& doubt : doubtsAbout(audit)) printNote(texts.output + ": " + doubt);
  return ExitCode::Done;
}

/// How the clip's joints and the avatar's go together, in words; `pose` becomes the first frame's.
/// An error of code Mismatch, where nothing matches, is what the check says no to.
Result<std::string> matchOf(const CheckTexts& texts, const Avatar& avatar, const Clip& clip,
                            Pose& pose) {
  const auto match = matchWithMap(avatar.skeleton(), clip.skeleton, texts.map, texts.motion);
  if (!match.ok()) return match.error();
  auto first =
      validatedPose(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match.value(), 0));
  if (!first.ok()) return first.error();
  pose = std::move(first).value();
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

ExitCode check(const CheckTexts& texts) {
  const auto avatar = readAvatarFile(texts.avatar);
  if (!avatar.ok()) return failed(inFile(avatar.error(), texts.avatar));
  Pose pose = restPose(avatar.value().skeleton());
  std::string matches;
  std::vector<std::string> doubts;
  const bool hasMotion = !texts.motion.empty();
  if (hasMotion) {
    const auto clip = readClip(texts.motion, texts.scale);
    if (!clip.ok()) return failed(clip.error());
    const auto match = matchOf(texts, avatar.value(), clip.value(), pose);
    if (match.ok()) {
      matches = match.value();
    } else if (match.error().code == ErrorCode::Mismatch) {
      doubts.push_back(describe(match.error()));
    } else {
      return failed(inFile(match.error(), texts.motion));
    }
  }
  const AvatarAudit audit = auditAvatar(avatar.value(), pose);
  printOut(texts.avatar + "\n" + describe(audit, hasMotion ? "first frame" : "rest pose") +
           matches);
  for (const std::string& doubt : doubtsAbout(audit)) doubts.push_back(doubt);
  for (const std::string& doubt : doubts) printError(texts.avatar + ": " + doubt);
  return doubts.empty() ? ExitCode::Done : ExitCode::CheckSaysNo;
}

void addMake(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<BvhTexts>();
  CLI::App* const command =
      avatar.add_subcommand("bvh", "Make an avatar from a clip's skeleton, an LSS a bone");
  command->add_option("clip", texts->clip, "BVH clip")->type_name("CLIP")->required();
  command->add_option("-o,--output", texts->output, "Avatar file to write")
      ->type_name("FILE")
      ->required();
  command->add_option("--scale", texts->scale, "Metres per unit of the clip: 0.01 for centimetres")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--radius-scale", texts->radiusScale, "Multiplies every radius")
      ->type_name("S")
      ->capture_default_str();
  command->footer("Example:\n  foretouch avatar bvh walk.bvh --scale 0.01 -o walker.avatar.json");
  command->callback([texts, &exit] { exit = makeFromBvh(*texts); });
}

void addCheck(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<CheckTexts>();
  CLI::App* const command = avatar.add_subcommand(
      "check", "Measure an avatar; exit code 1 where its size or its match with a clip is amiss");
  command->add_option("avatar", texts->avatar, "Avatar file")->type_name("AVATAR")->required();
  CLI::Option* const motion =
      command->add_option("--motion", texts->motion, "BVH clip to match joints with, by name")
          ->type_name("CLIP");
  command
      ->add_option("--map", texts->map,
                   R"(Joint names that differ: {"avatar joint": "clip joint"})")
      ->type_name("FILE")
      ->needs(motion);
  command->add_option("--scale", texts->scale, "Metres per unit of the clip: 0.01 for centimetres")
      ->type_name("S")
      ->capture_default_str();
  command->footer(
      "Example:\n  foretouch avatar check walker.avatar.json --motion walk.bvh --scale 0.01");
  command->callback([texts, &exit] { exit = check(*texts); });
}

}  // namespace

void addAvatarCommand(CLI::App& program, ExitCode& exit) {
  CLI::App* const avatar = program.add_subcommand("avatar", "Make and check avatars");
  avatar->require_subcommand(1);
  addMake(*avatar, exit);
  addCheck(*avatar, exit);
}

}  // namespace foretouch::tools
