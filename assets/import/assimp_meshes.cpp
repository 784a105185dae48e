// The meshes of a file that assimp reads: assets/import/placed_meshes.h.
#include <limits>
#include <utility>

#include "assets/import/assimp.h"
#include "assets/import/gltf_file.h"
#include "assets/import/placed_meshes.h"
#include "lss/index.h"

namespace foretouch::internal {

PlacedMeshes placedMeshesOf(const std::string& path) {
  return isGltf(path) ? placedMeshesOfGltf(path) : placedMeshesByAssimp(path);
}

PlacedMeshes placedMeshesByAssimp(const std::string& path) {
  const AssimpFile file = readWithAssimp(path, Animations::Skip);
  const aiScene& scene = *file.scene;
  PlacedMeshes placed;
  placed.frame = file.frame.frame;
  placed.notes = file.notes;
  placed.totals.uniqueMeshes = scene.mNumMeshes;
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    MeshTriangles cut = trianglesOf(mesh);
    placed.meshes.push_back({textOf(mesh.mName), verticesOf(mesh), std::move(cut.triangles),
                             cut.skippedPrimitives, cut.skippedFaces});
  }
  // Only the memory limit bounds a scene's tree: its nodes are not sent.
  const auto nodes = nodesOf(scene, std::numeric_limits<std::int32_t>::max());
  placed.totals.nodes = nodes.size();
  std::vector<Affine> toFile;
  toFile.reserve(nodes.size());
  Affine toMetres;
  toMetres.linear *= file.frame.metresPerUnit;
  for (const VisitedNode& visited : nodes) {
    const Affine& parent = visited.parent < 0 ? toMetres : toFile[slotOf(visited.parent)];
    toFile.push_back(parent * transformOf(visited.node->mTransformation));
    for (unsigned i = 0; i < visited.node->mNumMeshes; ++i) {
      checkMeshIndex(scene, visited.node->mMeshes[i]);
      placed.place(visited.node->mMeshes[i], textOf(visited.node->mName), toFile.back());
    }
  }
  return placed;
}

}  // namespace foretouch::internal
