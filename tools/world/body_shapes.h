// tools/world/body_shapes.h: what the bodies of a world file are made of, loaded. Files that
// several bodies name are read once, so that these bodies are of one kind.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/result.h"
#include "middleware/scene/scene.h"
#include "middleware/surface/avatar_surface.h"
#include "tools/world/world_file.h"

namespace foretouch::tools {

/// An avatar, a prop of LSS (an avatar of one link, named as its body), or a mesh.
struct BodyShape {
  std::optional<Avatar> avatar;
  std::optional<AvatarSurface> surface;  ///< For an avatar whose meshes touch.
  std::optional<Scene> mesh;
  Skeleton skeleton;  ///< For a mesh: one joint, named as its body.
  /// A mesh's finite triangles with their corners in the file's order, which a scene does not
  /// keep: for pictures.
  std::shared_ptr<const std::vector<Triangle>> triangles;
};

/// "avatar", "LSS", "mesh" or "box".
[[nodiscard]] const char* madeOf(const FileShape& shape);
/// The file that the shape is read from, as given; empty if there is none.
[[nodiscard]] std::string fileOf(const FileShape& shape);

class ShapeLoader {
 public:
  /// Errors name the shape's file, or `world` and the body's line.
  [[nodiscard]] Result<BodyShape> load(const FileBody& body, const std::string& world);

 private:
  using MeshKey = std::tuple<std::string, std::string, double, std::optional<UpAxis>>;
  [[nodiscard]] Result<Avatar> avatarOf(const std::string& path);
  [[nodiscard]] Result<AvatarSurface> surfaceOf(const std::string& path, const Avatar& avatar);
  struct Mesh {
    Scene scene;
    std::shared_ptr<const std::vector<Triangle>> triangles;
  };
  [[nodiscard]] static Result<Mesh> meshFrom(RawScene raw);
  [[nodiscard]] Result<Mesh> meshOf(const FileShape& shape);

  std::map<std::string, Avatar> avatars_;
  std::map<std::string, AvatarSurface> surfaces_;  // of these
  std::map<MeshKey, Mesh> meshes_;
};

}  // namespace foretouch::tools
