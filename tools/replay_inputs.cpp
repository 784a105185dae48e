#include "tools/replay_inputs.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/avatar_file.h"
#include "articulated/text_file.h"
#include "middleware/link_mesh.h"
#include "tools/clip_pose.h"
#include "tools/console.h"
#include "tools/ignored_pairs.h"
#include "tools/joint_map.h"
#include "tools/motion_file.h"
#include "tools/skin_file.h"

namespace foretouch::tools {
namespace {

Result<Scene> loadScene(const ReplayRequest& request) {
  SceneImportOptions options;
  options.scale = request.sceneScale;
  options.up = request.sceneUp;
  auto imported = importScene(request.scenePath, options);
  if (!imported.ok()) return inFile(imported.error(), request.scenePath);
  auto scene = Scene::build(std::move(imported.value().scene));
  if (!scene.ok()) return inFile(scene.error(), request.scenePath);
  return scene;
}

/// The meshes that the avatar file refers to, where the fidelity asks for them.
Result<Done> loadSurface(const ReplayRequest& request, const Avatar& avatar, QueryOptions& query) {
  query.fidelity = request.fidelity;
  query.leafMethod = request.leafMethod;
  query.scope = request.scope;
  if (request.fidelity == Fidelity::Link) return Done{};
  if (request.fidelity == Fidelity::Skinned) {
    auto skin = loadSkin(request.skinPath, request.skinScale, request.skinUp, avatar);
    if (!skin.ok()) return skin.error();
    query.skin = std::move(skin).value();
    return Done{};
  }
  auto meshes = loadLinkMeshes(avatar, request.avatarPath);
  if (!meshes.ok()) return inFile(meshes.error(), request.avatarPath);
  auto surface = AvatarSurface::build(avatar, std::move(meshes).value());
  if (!surface.ok()) return inFile(surface.error(), request.avatarPath);
  surface.value().prepare();  // the first steps' latencies are the query's
  query.surface = std::move(surface).value();
  return Done{};
}

/// Total length of the matched joints' offsets to matched parents, in the avatar and in the clip:
/// the two differ by a wrong unit if by anything large.
double sizeOfClipToAvatar(const ReplayInputs& inputs) {
  const Skeleton& avatar = inputs.avatar.skeleton();
  double ofAvatar = 0.0;
  double ofClip = 0.0;
  for (JointId joint = 0; joint < avatar.numJoints(); ++joint) {
    const JointId source = inputs.match.clipJointOf[static_cast<std::size_t>(joint)];
    if (source == kNoParent || avatar.parent(joint) == kNoParent) continue;
    ofAvatar += avatar.restOffset(joint).norm();
    ofClip += inputs.clip.skeleton.restOffset(source).norm();
  }
  return ofAvatar > 0.0 && ofClip > 0.0 ? ofClip / ofAvatar : 1.0;
}

}  // namespace

Result<ReplayInputs> loadReplayInputs(const ReplayRequest& request) {
  auto avatar = readAvatarFile(request.avatarPath);
  if (!avatar.ok()) return inFile(avatar.error(), request.avatarPath);
  auto motion = readMotion(motionRequestOf(request));
  if (!motion.ok()) return motion.error();
  Clip& clip = motion.value().clip;
  auto match =
      matchWithMap(avatar.value().skeleton(), clip.skeleton, request.mapPath, request.motionPath);
  if (!match.ok()) return match.error();
  const auto steps = selectSteps(clip.frames.size(), clip.frameTimeS, request.rateHz);
  if (!steps.ok()) return inFile(steps.error(), request.motionPath);
  auto scene = loadScene(request);
  if (!scene.ok()) return scene.error();

  QueryOptions query;
  query.tolerance = request.tolerance;
  query.culler = request.culler;
  const auto surface = loadSurface(request, avatar.value(), query);
  if (!surface.ok()) return surface.error();
  auto ignored =
      parseIgnoredPairs(request.ignore, avatar.value().skeleton(), scene.value().objectNames());
  if (!ignored.ok()) return ignored.error();
  query.ignored = std::move(ignored).value();
  return ReplayInputs{request,          std::move(scene).value(), std::move(avatar).value(),
                      std::move(clip),  std::move(match).value(), steps.value(),
                      std::move(query), motion.value().isUpright};
}

std::vector<std::string> remarksOn(const ReplayInputs& inputs) {
  const ReplayRequest& request = inputs.request;
  std::vector<std::string> remarks;
  for (const std::string& note : inputs.clip.notes) {
    remarks.push_back(request.motionPath + ": " + note);
  }
  if (!inputs.match.unmatchedAvatar.empty()) {
    remarks.push_back(
        fmt::format("{}: {} of {} joints have no counterpart in the clip and keep "
                    "their rest values: {}",
                    request.avatarPath, inputs.match.unmatchedAvatar.size(),
                    inputs.avatar.numLinks(), firstOf(inputs.match.unmatchedAvatar)));
  }
  if (!inputs.match.unmatchedClip.empty()) {
    remarks.push_back(fmt::format("{}: {} joints drive nothing: {}", request.motionPath,
                                  inputs.match.unmatchedClip.size(),
                                  firstOf(inputs.match.unmatchedClip)));
  }
  constexpr double kSuspiciousRatio = 2.0;  // people differ by less, centimetres and inches by more
  const double ratio = sizeOfClipToAvatar(inputs);
  if (ratio > kSuspiciousRatio || ratio < 1.0 / kSuspiciousRatio) {
    remarks.push_back(
        fmt::format("{}: its bones are {:.4g} times as long as the avatar's; is "
                    "--scale right?",
                    request.motionPath, ratio));
  }
  if (const std::size_t dropped = inputs.scene.audit().droppedNonFinite; dropped > 0) {
    remarks.push_back(fmt::format("{}: {} triangles with a vertex that is not finite were left out",
                                  request.scenePath, dropped));
  }
  return remarks;
}

Result<Pose> poseAtFrame(const ReplayInputs& inputs, std::int64_t frame) {
  return poseAtFrame({inputs.avatar, inputs.clip, inputs.match, inputs.request.placement,
                      inputs.isUpright, inputs.request.motionPath},
                     frame);
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
