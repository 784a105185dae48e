#include "bench/inputs.h"

#include <utility>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_avatar.h"
#include "tools/console.h"
#include "tools/inputs/example_folder.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"

namespace foretouch::tools {
namespace {

Result<Done> fillInBundled(BenchFiles& files) {
  if (!files.scenePath.empty() && !files.motionPath.empty()) return Done{};
  const auto folder = exampleFolder();
  if (!folder.ok()) return folder.error();
  if (files.scenePath.empty()) files.scenePath = folder.value() + "/room.obj";
  if (files.motionPath.empty()) {
    files.motionPath = folder.value() + "/dancer.bvh";
    if (files.avatarPath.empty()) files.avatarPath = folder.value() + "/dancer.avatar.json";
  }
  return Done{};
}

Result<Avatar> loadAvatar(const BenchFiles& files, const Clip& clip) {
  auto avatar = files.avatarPath.empty() ? avatarFromClip(clip) : readAvatarFile(files.avatarPath);
  if (avatar.ok()) return avatar;
  return inFile(avatar.error(), files.avatarPath.empty() ? files.motionPath : files.avatarPath);
}

}  // namespace

Result<BenchInputs> loadBenchInputs(BenchFiles files) {
  const auto bundled = fillInBundled(files);
  if (!bundled.ok()) return bundled.error();
  MotionRequest request;
  request.path = files.motionPath;
  request.scale = files.motionScale;
  request.up = files.motionUp;
  auto motion = readMotion(request);
  if (!motion.ok()) return motion.error();
  Clip& clip = motion.value().clip;
  auto avatar = loadAvatar(files, clip);
  if (!avatar.ok()) return avatar.error();
  auto match =
      matchWithMap(avatar.value().skeleton(), clip.skeleton, files.mapPath, files.motionPath);
  if (!match.ok()) return match.error();
  SceneImportOptions import;
  import.scale = files.sceneScale;
  import.up = files.sceneUp;
  auto imported = importScene(files.scenePath, import);
  if (!imported.ok()) return inFile(imported.error(), files.scenePath);
  auto scene = Scene::build(imported.value().scene);
  if (!scene.ok()) return inFile(scene.error(), files.scenePath);
  return BenchInputs{std::move(files),         std::move(imported.value().scene),
                     std::move(scene).value(), std::move(avatar).value(),
                     std::move(clip),          std::move(match).value(),
                     motion.value().isUpright};
}

Pose placedPose(const BenchInputs& inputs, const Placement& placement, std::int64_t frame) {
  const Skeleton& skeleton = inputs.avatar.skeleton();
  Placement turned = placement;
  turned.motionUpZ = inputs.files.motionUp == UpAxis::Z && !inputs.isUpright;
  return placed(skeleton,
                poseOfAvatar(skeleton, inputs.clip, inputs.match, static_cast<std::size_t>(frame)),
                turned);
}

}  // namespace foretouch::tools
