#include "tools/world/body_shapes.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/import/scene_import.h"
#include "assets/mesh/link_mesh.h"
#include "middleware/scene/box_triangles.h"
#include "tools/console.h"

namespace foretouch::tools {
namespace {

Result<Skeleton> oneJoint(const std::string& name) {
  RawSkeleton raw;
  raw.joints = {{name, kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()}};
  return Skeleton::build(raw);
}

/// The triangles of one node, in its frame.
Result<RawScene> meshOfNode(const FileShape& shape) {
  FORETOUCH_TRY(auto skeleton, oneJoint(shape.node));
  // Only the reference counts; an avatar has an LSS somewhere.
  FORETOUCH_TRY(const auto holder,
                Avatar::build(std::move(skeleton), {{Lss{}}}, {{shape.meshPath, shape.node}}));
  ModelImportOptions options;
  options.import = shape.meshImport;
  FORETOUCH_TRY(auto triangles, loadLinkMeshes(holder, "", options));
  RawScene raw;
  raw.objectNames = {shape.node};
  raw.triangles = std::move(triangles.front());
  raw.objectOf.assign(raw.triangles.size(), 0);
  return raw;
}

Result<RawScene> wholeMesh(const FileShape& shape) {
  FORETOUCH_TRY(auto imported, importScene(shape.meshPath, shape.meshImport));
  printNotes(shape.meshPath, imported.report.notes);
  return std::move(imported.scene);
}

}  // namespace

const char* madeOf(const FileShape& shape) {
  if (!shape.avatarPath.empty()) return "avatar";
  if (!shape.lss.empty()) return "LSS";
  return shape.box ? "box" : "mesh";
}

std::string fileOf(const FileShape& shape) {
  return shape.avatarPath.empty() ? shape.meshPath : shape.avatarPath;
}

Result<Avatar> ShapeLoader::avatarOf(const std::string& path) {
  auto known = avatars_.find(path);
  if (known == avatars_.end()) {
    FORETOUCH_TRY(auto avatar, readAvatarFile(path));
    known = avatars_.emplace(path, std::move(avatar)).first;
  }
  return known->second;
}

Result<AvatarSurface> ShapeLoader::surfaceOf(const std::string& path, const Avatar& avatar) {
  auto known = surfaces_.find(path);
  if (known == surfaces_.end()) {
    FORETOUCH_TRY(auto triangles, loadLinkMeshes(avatar, path));
    FORETOUCH_TRY(auto surface, inFile(AvatarSurface::build(avatar, std::move(triangles)), path));
    known = surfaces_.emplace(path, std::move(surface)).first;
  }
  return known->second;
}

Result<ShapeLoader::Mesh> ShapeLoader::meshFrom(RawScene raw) {
  std::vector<Triangle> finite;
  std::copy_if(raw.triangles.begin(), raw.triangles.end(), std::back_inserter(finite),
               [](const Triangle& triangle) { return isFinite(triangle); });
  FORETOUCH_TRY(auto scene, Scene::build(std::move(raw)));
  return Mesh{std::move(scene), std::make_shared<const std::vector<Triangle>>(std::move(finite))};
}

Result<ShapeLoader::Mesh> ShapeLoader::meshOf(const FileShape& shape) {
  const SceneImportOptions& import = shape.meshImport;
  const MeshKey key{shape.meshPath, shape.node, import.scale.value_or(0.0), import.up};
  auto known = meshes_.find(key);
  if (known == meshes_.end()) {
    FORETOUCH_TRY(auto raw, inFile(shape.node.empty() ? wholeMesh(shape) : meshOfNode(shape),
                                   shape.meshPath));
    FORETOUCH_TRY(auto mesh, inFile(meshFrom(std::move(raw)), shape.meshPath));
    known = meshes_.emplace(key, std::move(mesh)).first;
  }
  return known->second;
}

Result<BodyShape> ShapeLoader::load(const FileBody& body, const std::string& world) {
  const FileShape& shape = body.shape;
  if (!shape.avatarPath.empty()) {
    FORETOUCH_TRY(auto avatar, avatarOf(shape.avatarPath));
    std::optional<AvatarSurface> surface;
    if (body.fidelity == Fidelity::Exact) {
      FORETOUCH_TRY(surface, surfaceOf(shape.avatarPath, avatar));
    }
    Skeleton skeleton = avatar.skeleton();
    return BodyShape{std::move(avatar), std::move(surface), std::nullopt, std::move(skeleton),
                     nullptr};
  }
  const auto inWorld = [&](Error error) {
    error.file = world;
    error.line = body.line;
    return error;
  };
  FORETOUCH_TRY_OR(inWorld, auto skeleton, oneJoint(body.name));
  if (!shape.lss.empty()) {
    FORETOUCH_TRY_OR(inWorld, auto avatar, Avatar::build(skeleton, {shape.lss}));
    return BodyShape{std::move(avatar), std::nullopt, std::nullopt, std::move(skeleton), nullptr};
  }
  if (!shape.box) {
    FORETOUCH_TRY(auto mesh, meshOf(shape));
    return BodyShape{std::nullopt, std::nullopt, std::move(mesh.scene), std::move(skeleton),
                     std::move(mesh.triangles)};
  }
  const auto& [low, high] = *shape.box;
  FORETOUCH_TRY_OR(inWorld, auto box, meshFrom(internal::boxTriangles(low, high, body.name)));
  return BodyShape{std::nullopt, std::nullopt, std::move(box.scene), std::move(skeleton),
                   std::move(box.triangles)};
}

}  // namespace foretouch::tools
