#include "bench/inputs.h"

#include <utility>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "lss/index.h"
#include "tools/console.h"
#include "tools/inputs/example_folder.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"

namespace foretouch::tools {
namespace {

Result<Done> fillInBundled(BenchFiles& files) {
  if (!files.scenePath.empty() && !files.motionPath.empty()) return Done{};
  FORETOUCH_TRY(const auto folder, exampleFolder());
  if (files.scenePath.empty()) files.scenePath = folder + "/room.obj";
  if (files.motionPath.empty()) {
    files.motionPath = folder + "/dancer.bvh";
    if (files.avatarPath.empty()) files.avatarPath = folder + "/dancer.avatar.json";
  }
  return Done{};
}

Result<Avatar> loadAvatar(const BenchFiles& files, const Clip& clip) {
  auto avatar = files.avatarPath.empty() ? avatarFromClip(clip) : readAvatarFile(files.avatarPath);
  if (avatar.ok()) return avatar;
  return inFile(avatar.error(), files.avatarPath.empty() ? files.motionPath : files.avatarPath);
}

}  // namespace

SceneImportOptions importOf(double scale, UpAxis up) {
  SceneImportOptions import;
  if (scale != 1.0) import.scale = scale;
  if (up != UpAxis::Y) import.up = up;
  return import;
}

Result<BenchInputs> loadBenchInputs(BenchFiles files) {
  FORETOUCH_CHECK(fillInBundled(files));
  MotionRequest request;
  request.path = files.motionPath;
  const SceneImportOptions ofMotion = importOf(files.motionScale, files.motionUp);
  request.scale = ofMotion.scale;
  request.up = ofMotion.up;
  FORETOUCH_TRY(auto motion, readMotion(request));
  Clip& clip = motion.clip;
  FORETOUCH_TRY(auto avatar, loadAvatar(files, clip));
  auto match = matchWithMap(avatar.skeleton(), clip.skeleton, files.mapPath, files.motionPath);
  if (!match.ok()) return match.error();
  FORETOUCH_TRY(auto imported,
                importScene(files.scenePath, importOf(files.sceneScale, files.sceneUp)));
  FORETOUCH_TRY(auto scene, inFile(Scene::build(imported.scene), files.scenePath));
  return BenchInputs{std::move(files),  std::move(imported.scene), std::move(scene),
                     std::move(avatar), std::move(clip),           std::move(match).value(),
                     motion.isUpright};
}

Pose placedPose(const BenchInputs& inputs, const Placement& placement, std::int64_t frame) {
  const Skeleton& skeleton = inputs.avatar.skeleton();
  Placement turned = placement;
  turned.motionUpZ = inputs.files.motionUp == UpAxis::Z && !inputs.isUpright;
  return placed(skeleton, poseOfAvatar(skeleton, inputs.clip, inputs.match, slotOf(frame)), turned);
}

}  // namespace foretouch::tools
