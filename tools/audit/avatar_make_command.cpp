#include "tools/audit/avatar_make_command.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_avatar.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/mesh/link_mesh.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "tools/arguments.h"
#include "tools/audit/audits.h"
#include "tools/audit/surface_audit.h"
#include "tools/inputs/replay_inputs.h"

namespace foretouch::tools {
namespace {

struct BvhTexts {
  std::string clip, output, scale = "1", radiusScale = "1";
};

struct ModelTexts {
  std::string model, output, scale = "1", up = "y", maxLss = "4";
  bool visual = false, isRobot = false;
  std::vector<std::string> packages;
};

/// What was made, and what looks wrong about it.
void tell(const Avatar& avatar, const std::string& output, const std::string& more,
          bool isRobot = false) {
  AvatarAudit audit = auditAvatar(avatar, restPose(avatar.skeleton()));
  if (isRobot) audit.stature.reset();
  printOut(output + "\n" + describe(audit, "rest pose") + more);
  for (const std::string& doubt : doubtsAbout(audit)) printNote(output + ": " + doubt);
}

ExitCode makeFromBvh(const BvhTexts& texts) {
  BvhAvatarOptions options;
  const auto radiusScale = parsePositive("--radius-scale", texts.radiusScale);
  if (!radiusScale.ok()) return failed(radiusScale.error());
  options.radiusScale = radiusScale.value();
  const auto separate = checkIsNoInput(texts.output, {texts.clip});
  if (!separate.ok()) return failed(separate.error());
  const auto scale = parsePositive("--scale", texts.scale);
  if (!scale.ok()) return failed(scale.error());
  const auto clip = readBvhFile(texts.clip, BvhOptions{scale.value()});
  if (!clip.ok()) return failed(inFile(clip.error(), texts.clip));
  for (const std::string& note : clip.value().notes) printNote(texts.clip + ": " + note);
  const auto avatar = avatarFromClip(clip.value(), options);
  if (!avatar.ok()) return failed(inFile(avatar.error(), texts.clip));
  const auto written = writeAvatarFile(avatar.value(), texts.output);
  if (!written.ok()) return failed(inFile(written.error(), texts.output));
  tell(avatar.value(), texts.output, "");
  return ExitCode::Done;
}

std::string row(const char* what, std::size_t count) {
  return fmt::format("  {:<25}{}\n", what, count);
}

std::string describe(const ModelAvatar& made, std::size_t read) {
  const ModelAvatarReport& report = made.report;
  std::size_t bare = 0;
  for (const auto& triangles : made.surface) bare += triangles.empty() ? 1 : 0;
  return row("triangles read", read) + row("  given to links", report.triangles) +
         row("  not finite, left out", report.droppedNonFinite) +
         row("  without weights", report.unweighted) +
         row("  moved by several links", report.shared) + row("bad weights", report.badWeights) +
         row("links without triangles", bare) +
         (report.triangles == 0 ? ""
                                : fmt::format("  {:<25}{}\n", "excess volume of LSS",
                                              excessInWords(report.hullVolume + report.excessVolume,
                                                            report.hullVolume)));
}

/// Where the links' triangles go: beside the avatar file, under its name.
std::filesystem::path meshPathOf(const std::string& output) {
  return std::filesystem::path(output).replace_extension(".mesh.glb");
}

Result<ModelImportOptions> importOptions(const ModelTexts& texts) {
  ModelImportOptions options;
  const auto scale = parsePositive("--scale", texts.scale);
  if (!scale.ok()) return scale.error();
  options.import.scale = scale.value();
  const auto up = parseUpAxis("--up", texts.up);
  if (!up.ok()) return up.error();
  options.import.up = up.value();
  options.urdfSurface = texts.visual ? UrdfSurface::Visual : UrdfSurface::Collision;
  options.packagePaths = texts.packages;
  return options;
}

/// The mesh first: an avatar file never refers to one that is not there yet.
Result<Done> writeBoth(const ModelAvatar& made, const std::string& output) {
  {
    const auto trial = PendingFile::create(output);
    if (!trial.ok()) return inFile(trial.error(), output);
  }
  if (made.report.triangles > 0) {
    const std::string path = meshPathOf(output).string();
    const auto written = writeLinkMeshes(made.avatar.skeleton(), made.surface, path);
    if (!written.ok()) return inFile(written.error(), path);
  }
  const auto written = writeAvatarFile(made.avatar, output);
  if (!written.ok()) return inFile(written.error(), output);
  return Done{};
}

ExitCode makeFromModel(const ModelTexts& texts) {
  const auto import = importOptions(texts);
  if (!import.ok()) return failed(import.error());
  ModelAvatarOptions options;
  const auto maxLss = parseCount("--max-lss", texts.maxLss, static_cast<int>(kMaxLssPerLink));
  if (!maxLss.ok()) return failed(maxLss.error());
  options.maxLssPerLink = maxLss.value();
  options.meshFile = meshPathOf(texts.output).filename().string();
  for (const std::string& output : {texts.output, meshPathOf(texts.output).string()}) {
    const auto separate = checkIsNoInput(output, {texts.model});
    if (!separate.ok()) return failed(separate.error());
  }
  const auto model = importModel(texts.model, import.value());
  if (!model.ok()) return failed(inFile(model.error(), texts.model));
  for (const std::string& note : model.value().notes) printNote(texts.model + ": " + note);
  const auto made = avatarFromModel(model.value(), options);
  if (!made.ok()) return failed(inFile(made.error(), texts.model));
  for (const std::string& note : made.value().report.notes) printNote(texts.model + ": " + note);
  const auto written = writeBoth(made.value(), texts.output);
  if (!written.ok()) return failed(written.error());

  std::size_t read = 0;
  for (const ModelMesh& mesh : model.value().meshes) read += mesh.triangles.size();
  tell(made.value().avatar, texts.output, describe(made.value(), read), texts.isRobot);
  return ExitCode::Done;
}

void addOutput(CLI::App& command, std::string& output) {
  command.add_option("-o,--output", output, "Avatar file to write")->type_name("FILE")->required();
}

/// What both kinds of models ask for.
void addModelOptions(CLI::App& command, ModelTexts& texts, const char* scaleHelp) {
  addOutput(command, texts.output);
  const auto option = [&](const char* name, std::string& text, const char* type, const char* help) {
    command.add_option(name, text, help)->type_name(type)->capture_default_str();
  };
  option("--scale", texts.scale, "S", scaleHelp);
  option("--up", texts.up, "y|z", "Which axis of the model points up");
  option("--max-lss", texts.maxLss, "N", "Most LSS that one link's triangles are split among");
}

}  // namespace

void addAvatarBvhCommand(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<BvhTexts>();
  CLI::App* const command =
      avatar.add_subcommand("bvh", "Make an avatar from a clip's skeleton, an LSS a bone");
  command->add_option("clip", texts->clip, "BVH clip")->type_name("CLIP")->required();
  addOutput(*command, texts->output);
  command->add_option("--scale", texts->scale, "Metres per unit of the clip: 0.01 for centimetres")
      ->type_name("S")
      ->capture_default_str();
  command->add_option("--radius-scale", texts->radiusScale, "Multiplies every radius")
      ->type_name("S")
      ->capture_default_str();
  command->footer("Example:\n  foretouch avatar bvh walk.bvh --scale 0.01 -o walker.avatar.json");
  command->callback([texts, &exit] { exit = makeFromBvh(*texts); });
}

void addAvatarMeshCommand(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<ModelTexts>();
  CLI::App* const command = avatar.add_subcommand(
      "mesh", "Make an avatar from a rigged model: LSS that contain its triangles");
  command
      ->add_option("model", texts->model, "Model: any format with bones or nodes that assimp reads")
      ->type_name("BODY")
      ->required();
  addModelOptions(*command, *texts, "Metres per unit of the model");
  command->footer(
      "Example:\n  foretouch avatar mesh man.glb -o man.avatar.json\n\n"
      "The links' triangles go beside it, to man.avatar.mesh.glb.");
  command->callback([texts, &exit] { exit = makeFromModel(*texts); });
}

void addAvatarUrdfCommand(CLI::App& avatar, ExitCode& exit) {
  const auto texts = std::make_shared<ModelTexts>();
  texts->up = "z";
  texts->isRobot = true;
  CLI::App* const command = avatar.add_subcommand(
      "urdf", "Make an avatar from a robot: its spheres and capsules, and LSS around its meshes");
  command->add_option("robot", texts->model, "URDF file")->type_name("ROBOT")->required();
  addModelOptions(*command, *texts, "Metres per unit of the robot");
  command->add_flag("--visual", texts->visual, "Take what is seen for what touches");
  command->add_option("--package", texts->packages, "Where package://NAME/ is; may be repeated")
      ->type_name("DIR")
      ->allow_extra_args(false);
  command->footer(
      "Example:\n  foretouch avatar urdf arm.urdf --package ~/ros/src -o arm.avatar.json");
  command->callback([texts, &exit] { exit = makeFromModel(*texts); });
}

}  // namespace foretouch::tools
