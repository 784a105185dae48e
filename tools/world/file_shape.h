// tools/world/file_shape.h: what a body is made of, as a world file says it. Paths are ready to
// open.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assets/import/scene_import.h"
#include "lss/lss.h"

namespace foretouch::tools {

/// Exactly one of the first four is there.
struct FileShape {
  std::string avatarPath;
  std::string meshPath;
  std::vector<Lss> lss;                               ///< A prop's, in its frame.
  std::optional<std::array<Eigen::Vector3d, 2>> box;  ///< Lowest and highest corner, in its frame.
  // For a mesh.
  std::string node;  ///< Only this node's triangles, in its frame; empty: the whole file.
  SceneImportOptions meshImport;
};

}  // namespace foretouch::tools
