// assets/import/placed_meshes.h: the meshes of a file and where its nodes place them: what becomes
// a scene, or a robot's link. In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assets/file_frame.h"
#include "assets/import/polygon.h"
#include "assets/import/protocol.h"
#include "assets/model/model.h"

namespace foretouch::internal {

struct PlacedMeshes {
  struct Mesh {
    std::string name;
    std::vector<Eigen::Vector3d> vertices;
    std::vector<CornerTriple> triangles;  ///< Indices are in range.
    std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
  };
  struct Placement {
    std::size_t mesh;
    std::string name;  ///< The node's, else the mesh's.
    Affine toFile;     ///< Into the file's own frame, in metres.
  };

  /// Counts the placement, and keeps it if the mesh has triangles. Throws Failure beyond the limits
  /// of a scene.
  void place(std::size_t mesh, const std::string& node, const Affine& toFile);

  std::vector<Mesh> meshes;
  std::vector<Placement> placements;
  ImportTotals totals;
  FileFrame frame;
  std::vector<std::string> notes;

 private:
  std::size_t nameBytes_ = 0;  // as the parent will count them
};

/// By the reader that the file's extension asks for. Throws Failure.
[[nodiscard]] PlacedMeshes placedMeshesOf(const std::string& path);
/// The two readers.
[[nodiscard]] PlacedMeshes placedMeshesByAssimp(const std::string& path);
[[nodiscard]] PlacedMeshes placedMeshesOfGltf(const std::string& path);

}  // namespace foretouch::internal
