// tools/world/body_shapes.h: what the bodies of a world file are made of, loaded. Files that
// several bodies name are read once, so that these bodies are of one kind.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "tools/world/world_file.h"

namespace foretouch::tools {

/// An avatar, a prop of LSS (an avatar of one link, named as its body), or a mesh.
struct BodyShape {
  std::optional<Avatar> avatar;
  std::optional<Scene> mesh;
  Skeleton skeleton;  ///< Of a mesh: one joint, named as its body.
};

/// "avatar", "LSS", "mesh" or "box".
[[nodiscard]] const char* madeOf(const FileShape& shape);
/// The file that it is read from, as given; empty if there is none.
[[nodiscard]] std::string fileOf(const FileShape& shape);

class ShapeLoader {
 public:
  /// Errors name the shape's file, or `world` and the body's line.
  [[nodiscard]] Result<BodyShape> load(const FileBody& body, const std::string& world);

 private:
  using MeshKey = std::tuple<std::string, std::string, double, std::optional<UpAxis>>;
  [[nodiscard]] Result<Avatar> avatarOf(const std::string& path);
  [[nodiscard]] Result<Scene> meshOf(const FileShape& shape);

  std::map<std::string, Avatar> avatars_;
  std::map<MeshKey, Scene> meshes_;
};

}  // namespace foretouch::tools
