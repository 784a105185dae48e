// assets/import/assimp.h: what the importer asks of assimp, for scenes as for models: a file
// read raw, its faces as triangles, its unit. In foretouch-import only. Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include "assets/import/polygon.h"
#include "assets/import/stream.h"
#include "assets/model/model.h"

namespace foretouch::internal {

/// What ends an import with a message to the parent.
struct Failure {
  ImportFailure kind;
  std::string text;
};

/// A mesh of the file, cut into triangles once for all its placements. Indices are in range.
struct MeshTriangles {
  std::vector<CornerTriple> triangles;
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
};

enum class Animations : bool { Skip, Read };

/// A file as assimp reads it, without any post-processing: its steps merge, drop or reorder
/// triangles, or refuse sloppy files that are usable; what is needed of them is done here.
struct AssimpFile {
  const aiScene* scene = nullptr;  ///< With a root node; never freed.
  double metresPerUnit = 1.0;
};
[[nodiscard]] AssimpFile readWithAssimp(const std::string& path, Animations animations);

/// In double; assimp's matrices are float, and a chain of them would lose digits.
[[nodiscard]] Affine transformOf(const aiMatrix4x4& m);
[[nodiscard]] Eigen::Vector3d vertexOf(const aiMesh& mesh, std::uint32_t index);
[[nodiscard]] MeshTriangles trianglesOf(const aiMesh& mesh);
/// Throws where `mesh` is not the number of a mesh of the file.
void checkMeshIndex(const aiScene& scene, unsigned mesh);

/// A node where the depth-first walk meets it: parents before children, children in order.
struct VisitedNode {
  const aiNode* node;
  std::int32_t parent;  ///< Position in the walk; -1 for the root.
};
/// On a stack of our own, as the depth of the tree is the file's choice. Throws above `limit`.
[[nodiscard]] std::vector<VisitedNode> nodesOf(const aiScene& scene, std::size_t limit);

}  // namespace foretouch::internal
