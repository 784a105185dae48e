#include "tools/audit/avatar_make_command.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "tools/audit/audits.h"
#include "tools/audit/avatar_files.h"
#include "tools/audit/surface_audit.h"
#include "tools/floor/heels.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/first_pose.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/results_output.h"
#include "tools/settings/frame_settings.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// The values of all options.
struct AskedOfClip {
  std::string clip, output;
  BvhOptions reading;
  BvhAvatarOptions making;
  bool heels = false;
};
struct AskedOfModel {
  std::string model, output;
  ModelImportOptions reading;
  ModelAvatarOptions making;
  bool visual = false, isRobot = false, allowsMissing = false, meshAlone = false;
};

/// Describes the result, and what looks wrong about it.
/// `unitOption`: the option that gives its unit.
void tell(const Avatar& avatar, const std::string& output, const std::string& more,
          const char* unitOption, bool isRobot = false) {
  AvatarAudit audit = auditAvatar(avatar, restPose(avatar.skeleton()));
  if (isRobot) audit.stature.reset();
  const std::string text = output + "\n" + describe(audit, "rest pose") + more;
  isStandardOutput(output) ? printAside(text) : printOut(text);
  for (const std::string& doubt : doubtsAbout(audit, unitOption)) printNote(output + ": " + doubt);
}

/// The avatar with heels as the feet stand when they rest in the clip.
Result<Avatar> withHeels(const AskedOfClip& asked, const Clip& clip, const Avatar& avatar) {
  FORETOUCH_TRY(const auto match,
                inFile(matchJoints(avatar.skeleton(), clip.skeleton), asked.clip));
  Placement upright;
  const auto stance = stanceOf(clip.skeleton, clip.frames.front());
  upright.motionUpZ = stance && stance->headFromFeet.z() > std::abs(stance->headFromFeet.y());
  const PlacedClip placed{avatar, clip, match, upright, false, asked.clip};
  FORETOUCH_TRY(auto body, inFile(restingBodyOf(avatar), asked.clip));
  const RestingPoses poses = [&](std::int64_t frame) -> Result<Pose> {
    FORETOUCH_TRY(auto pose, poseAtFrame(placed, frame));
    return body.poseOf(std::move(pose));
  };
  const auto steps = static_cast<std::int64_t>(clip.frames.size()) - 1;
  FORETOUCH_TRY(const auto rests, footRestsOf(body, steps, clip.frameTimeS, poses));
  std::size_t lowered = 0;
  FORETOUCH_TRY(const auto down, withHeelsDown(body, rests, poses, &lowered));
  if (lowered == 0) {
    printNote(asked.clip +
              ": --heels: no foot gets a heel, as none that is a bone with length rests in the "
              "clip, in one usual way to stand");
    return avatar;
  }
  return avatarWithHeels(avatar, down);
}

ExitCode makeFromBvh(const AskedOfClip& asked) {
  FORETOUCH_CHECK_OR(failed, checkIsNoInput(asked.output, {asked.clip}));
  FORETOUCH_TRY_OR(failed, const auto clip, readBvhFile(asked.clip, asked.reading));
  for (const std::string& note : clip.notes) printNote(asked.clip + ": " + note);
  FORETOUCH_TRY_OR(failed, auto avatar, inFile(avatarFromClip(clip, asked.making), asked.clip));
  if (asked.heels) {
    FORETOUCH_TRY_OR(failed, avatar, withHeels(asked, clip, avatar));
  }
  FORETOUCH_CHECK_OR(failed, writeAvatarFile(avatar, asked.output));
  tell(avatar, asked.output, "", "--clip-scale");
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

ExitCode makeFromModel(AskedOfModel asked) {
  asked.reading.urdfSurface = asked.visual ? UrdfSurface::Visual : UrdfSurface::Collision;
  if (asked.output == kStandardOutput) {
    return failed(Error::in("--output", ErrorCode::Mismatch,
                            "expected a file: the links' triangles go beside it"));
  }
  asked.making.meshFile = meshFileOf(asked.output);
  for (const std::string& output : {asked.output, meshPathOf(asked.output)}) {
    FORETOUCH_CHECK_OR(failed, checkIsNoInput(output, {asked.model}));
  }
  asked.reading.needsMeshes = asked.isRobot && !asked.allowsMissing;
  const auto failedToRead = [&](Error error) {
    if (asked.reading.needsMeshes && error.message.find("mesh ") != std::string::npos) {
      error.message += "; --allow-missing reads the robot without it";
    }
    return failed(error);
  };
  FORETOUCH_TRY_OR(failedToRead, auto model, importModel(asked.model, asked.reading));
  if (asked.meshAlone) {
    for (ModelNode& node : model.nodes) node.lss.clear();
  }
  for (const std::string& note : model.notes) printNote(asked.model + ": " + note);
  if (const auto remark =
          remarkOnFrame(model.frame, {"--model-scale", "--model-up"}, asked.model)) {
    printNote(*remark);
  }
  FORETOUCH_TRY_OR(failed, const auto made,
                   inFile(avatarFromModel(model, asked.making), asked.model));
  for (const std::string& note : made.report.notes) printNote(asked.model + ": " + note);
  FORETOUCH_CHECK_OR(failed, writeModelAvatar(made, asked.output));

  std::size_t read = 0;
  for (const ModelMesh& mesh : model.meshes) read += mesh.triangles.size();
  tell(made.avatar, asked.output, describe(made, read) + rowOf(model.frame), "--model-scale",
       asked.isRobot);
  return ExitCode::Done;
}

void addOutput(Settings& settings, std::string& output) {
  settings.output("-o,--output", "FILE", output, "Avatar file to write").required();
}

/// Settings of both kinds of models.
void addModelSettings(Settings& settings, AskedOfModel& asked, const char* scaleHelp) {
  addOutput(settings, asked.output);
  addUnit(settings, "--model-scale", asked.reading.import.scale, scaleHelp).formerly("--scale");
  addUpAxis(settings, "--model-up", asked.reading.import.up, "Which axis of the model points up")
      .formerly("--up");
  settings.whole("--max-lss", "N", asked.making.maxLssPerLink, 1, kMaxLssPerLink,
                 "Most LSS that one link's triangles are split among");
}

}  // namespace

Command avatarBvhCommand() {
  const auto asked = std::make_shared<AskedOfClip>();
  Settings settings;
  settings.path("clip", "CLIP", asked->clip, "BVH clip").files("bvh").required("a BVH clip");
  addOutput(settings, asked->output);
  settings
      .number("--clip-scale", "S", asked->reading.scale, kMetresPerUnit,
              "Metres per unit of the clip: 0.01 for centimetres")
      .formerly("--scale");
  settings.number("--radius-scale", "S", asked->making.radiusScale, kAboveZero,
                  "Multiplies every radius");
  settings.flag("--heels", asked->heels,
                "Let the heels down to the level of the balls, as the feet rest in the clip");
  Command command{
      "bvh", "Make an avatar from a clip's skeleton, an LSS a bone",
      "Example:\n  foretouch avatar bvh walk.bvh --clip-scale 0.01 -o walker.avatar.json",
      std::move(settings)};
  command.run = [asked](const Settings&) { return makeFromBvh(*asked); };
  return command;
}

Command avatarMeshCommand() {
  const auto asked = std::make_shared<AskedOfModel>();
  Settings settings;
  settings
      .path("model", "BODY", asked->model, "Model: glTF, VRM, FBX, Collada, X, or a mesh format")
      .files(kModelEndings)
      .required("a rigged model");
  addModelSettings(settings, *asked, "Metres per unit of the model");
  settings.flag("--mesh-alone", asked->meshAlone,
                "Leave out the colliders of a VRM avatar or a glTF file: LSS around its triangles alone");
  Command command{"mesh", "Make an avatar from a rigged model: LSS that contain its triangles",
                  "Example:\n  foretouch avatar mesh man.glb -o man.avatar.json\n\n"
                  "The links' triangles go beside it, to man.avatar.mesh.glb.",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return makeFromModel(*asked); };
  return command;
}

Command avatarUrdfCommand() {
  const auto asked = std::make_shared<AskedOfModel>();
  asked->reading.import.up = UpAxis::Z;
  asked->isRobot = true;
  Settings settings;
  settings.path("robot", "ROBOT", asked->model, "URDF file, or MuJoCo's (.xml)")
      .files("urdf")
      .required("a URDF file");
  addModelSettings(settings, *asked, "Metres per unit of the robot");
  settings.flag("--visual", asked->visual, "Use the visual meshes as the collision surface");
  settings.flag("--allow-missing", asked->allowsMissing,
                "Read the robot without meshes that are missing or unreadable: their links have no "
                "volume, and touch nothing");
  settings.list("--package", "DIR", asked->reading.packagePaths,
                "Where package://NAME/ is; may be repeated");
  Command command{
      "urdf", "Make an avatar from a robot: its spheres and capsules, and LSS around its meshes",
      "Example:\n  foretouch avatar urdf arm.urdf --package ~/ros/src -o arm.avatar.json",
      std::move(settings)};
  command.run = [asked](const Settings&) { return makeFromModel(*asked); };
  return command;
}

}  // namespace foretouch::tools
