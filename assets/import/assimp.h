// assets/import/assimp.h: the importer's use of assimp, for scenes and for models: a file read raw,
// its faces as triangles. In foretouch-import only. Not installed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include "assets/import/declared_frame.h"
#include "assets/import/failure.h"
#include "assets/import/polygon.h"
#include "assets/model/model.h"

namespace foretouch::internal {

/// A mesh of the file, triangulated once for all its placements. Indices are in range.
struct MeshTriangles {
  std::vector<CornerTriple> triangles;
  std::uint64_t skippedPrimitives = 0, skippedFaces = 0;
};

enum class Animations : bool { Skip, Read };

/// A file as assimp reads it, without any post-processing: its steps merge, drop or reorder
/// triangles, or refuse sloppy but usable files. The importer does the necessary ones itself.
struct AssimpFile {
  const aiScene* scene = nullptr;  ///< With a root node; never freed.
  ReadFrame frame;
  std::vector<std::string> notes;  ///< What assimp says nothing of (assets/import/passed_over.h).
};
[[nodiscard]] AssimpFile readWithAssimp(const std::string& path, Animations animations);

/// In double; assimp's matrices are float, and a chain of them would lose digits.
[[nodiscard]] Affine transformOf(const aiMatrix4x4& m);
[[nodiscard]] std::string textOf(const aiString& text);
[[nodiscard]] std::vector<Eigen::Vector3d> verticesOf(const aiMesh& mesh);
[[nodiscard]] Eigen::Vector3d vertexOf(const aiMesh& mesh, std::uint32_t index);
[[nodiscard]] MeshTriangles trianglesOf(const aiMesh& mesh);
/// Throws if `mesh` is not the number of a mesh of the file.
void checkMeshIndex(const aiScene& scene, unsigned mesh);

/// A node in depth-first order: parents before children, children in order.
struct VisitedNode {
  const aiNode* node;
  std::int32_t parent;  ///< Position in the walk; -1 for the root.
};
/// On an explicit stack, because the file decides the depth of the tree. Throws above `limit`.
[[nodiscard]] std::vector<VisitedNode> nodesOf(const aiScene& scene, std::size_t limit);

}  // namespace foretouch::internal
