#include "tools/setup/body_source.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/import/model_import.h"
#include "assets/text_file.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"

namespace foretouch::tools {
namespace {

bool isAvatarFile(const std::string& path) {
  return std::filesystem::path(path).extension() == ".json";
}

/// Every format that a reader of models may know, with an animation or without.
bool isModelFile(const std::string& path) {
  if (clipFormatOf(path) == ClipFormat::Model) return true;
  const std::string extension = std::filesystem::path(path).extension().string();
  return clipFormatOf(path) == ClipFormat::Bvh && extension != ".bvh" && extension != ".BVH";
}

Result<Model> readModelOf(const std::string& path, const BodyRequest& request) {
  ModelImportOptions options;
  options.import.scale = request.scale;
  options.import.up = request.up;
  return importModel(path, options);
}

Result<Done> readModelBody(const std::string& path, const BodyRequest& request,
                           const std::string& meshFile, BodySource& source) {
  FORETOUCH_TRY(const auto model, readModelOf(path, request));
  source.frame = model.frame;
  source.isUpright = true;
  const bool hasSurface =
      std::any_of(model.meshes.begin(), model.meshes.end(),
                  [](const ModelMesh& mesh) { return !mesh.triangles.empty(); }) ||
      std::any_of(model.nodes.begin(), model.nodes.end(),
                  [](const ModelNode& node) { return !node.lss.empty(); });
  if (!hasSurface) {  // a motion without a body
    source.notes.push_back(path +
                           ": holds no mesh, so the body is a guess: capsules as thick as a "
                           "person's around its joints; --avatar MODEL takes the file with the "
                           "mesh");
    return Done{};
  }
  ModelAvatarOptions making;
  making.meshFile = meshFile;
  FORETOUCH_TRY(source.ofModel, inFile(avatarFromModel(model, making), path));
  source.avatar = source.ofModel->avatar;
  for (const std::string& note : model.notes) source.notes.push_back(path + ": " + note);
  return Done{};
}

/// A model that holds no animation has no clip, which is no error here.
Result<Done> readClip(const BodyRequest& request, BodySource& source) {
  if (clipFormatOf(request.motion) == ClipFormat::JointTable) {
    return Error::in(request.motion, ErrorCode::Mismatch,
                     "expected a clip or a model: a table of joint positions is about a robot, for "
                     "which foretouch avatar urdf makes the avatar");
  }
  if (clipFormatOf(request.motion) != ClipFormat::Model && isModelFile(request.motion)) {
    source.notes.push_back(request.motion +
                           ": its format holds no animation that can be read, so "
                           "the body stands at rest");
    return Done{};
  }
  MotionRequest motion;
  motion.path = request.motion;
  motion.scale = request.scale;
  motion.up = request.up;
  motion.animation = request.animation;
  auto read = readMotion(motion);
  if (!read.ok()) {
    const bool isStill = read.error().code == ErrorCode::Empty && source.avatar;
    if (!isStill || !request.animation.empty()) return read.error();
    source.notes.push_back(request.motion + ": holds no animation, so the body stands at rest");
    return Done{};
  }
  source.frame = read.value().frame;
  source.isUpright = read.value().isUpright;
  for (const std::string& note : read.value().clip.notes) {
    source.notes.push_back(request.motion + ": " + note);
  }
  source.clip = std::move(read.value().clip);
  return Done{};
}

}  // namespace

Clip BodySource::clipOrRest() const {
  if (clip) return *clip;
  Clip still;
  still.skeleton = avatar->skeleton();
  still.frameTimeS = 1.0;
  still.frames = {restPose(still.skeleton)};
  const auto joints = static_cast<std::size_t>(still.skeleton.numJoints());
  still.hasTranslation.assign(joints, true);
  still.hasRotation.assign(joints, true);
  still.endSites.resize(joints);
  return still;
}

bool makesAvatar(const BodyRequest& request) {
  return !isAvatarFile(request.avatar);
}

Result<BodySource> readBody(const BodyRequest& request, const std::string& meshFile) {
  BodySource source;
  if (isAvatarFile(request.avatar)) {
    FORETOUCH_TRY(source.avatar, readAvatarFile(request.avatar));
  } else {
    const std::string& body = request.avatar.empty() ? request.motion : request.avatar;
    if (isModelFile(body)) {
      FORETOUCH_CHECK(readModelBody(body, request, meshFile, source));
    }
  }
  if (!request.motion.empty()) FORETOUCH_CHECK(readClip(request, source));
  if (!source.avatar) {
    if (!source.clip) {
      return Error::in(request.avatar, ErrorCode::Empty,
                       "expected a model with triangles, or an avatar file (.json)");
    }
    FORETOUCH_TRY(source.avatar, inFile(avatarFromClip(*source.clip), request.motion));
  }
  return source;
}

Result<WalkingBody> walkingBody(const BodySource& source, const BodyRequest& request) {
  Clip clip = source.clipOrRest();
  const Avatar& avatar = *source.avatar;
  const std::string& path = request.motion.empty() ? request.avatar : request.motion;
  FORETOUCH_CHECK(followByParts(avatar.skeleton(), request.map, path, clip));
  FORETOUCH_TRY(const auto match,
                matchWithMap(avatar.skeleton(), clip.skeleton, request.map, path));
  Placement upright;
  upright.motionUpZ = request.up == UpAxis::Z;
  return walkingBody({avatar, clip, match, upright, source.isUpright, path});
}

}  // namespace foretouch::tools
