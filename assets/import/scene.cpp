#include "assets/import/scene.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "assets/import/assimp.h"
#include "assets/import/text.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

/// A mesh placed by a node.
struct Placement {
  unsigned mesh;
  const aiString* name;
  Affine toWorld;
};

struct PlacedMeshes {
  const aiScene* scene = nullptr;
  std::vector<MeshTriangles> meshes;
  std::vector<Placement> placements;  // with triangles only
  ImportTotals totals;
  std::size_t nameBytes = 0;  // as the parent will count them
};

void addPlacement(PlacedMeshes& model, const aiNode& node, unsigned mesh, const Affine& toWorld) {
  checkMeshIndex(*model.scene, mesh);
  const MeshTriangles& triangles = model.meshes[mesh];
  ImportTotals& totals = model.totals;
  ++totals.meshInstances;
  totals.skippedPrimitives += triangles.skippedPrimitives;
  totals.skippedFaces += triangles.skippedFaces;
  if (triangles.triangles.empty()) return;
  const aiString& meshName = model.scene->mMeshes[mesh]->mName;
  const aiString& name = node.mName.length > 0 ? node.mName : meshName;
  totals.triangles += triangles.triangles.size();
  ++totals.objects;
  model.nameBytes += readableText({name.data, name.length}, kMaxObjectNameBytes).size();
  if (totals.triangles > kMaxTriangles || totals.objects > kMaxImportObjects ||
      model.nameBytes > kMaxImportNameBytes) {
    throw Failure{ImportFailure::TooLarge,
                  "instances counted, it has more than " + std::to_string(kMaxTriangles) +
                      " triangles, " + std::to_string(kMaxImportObjects) + " objects or " +
                      std::to_string(kMaxImportNameBytes) + " bytes of names"};
  }
  model.placements.push_back({mesh, &name, toWorld});
}

void placeAll(PlacedMeshes& model, double metresPerUnit) {
  // Only the memory limit bounds a scene's tree: its nodes are not sent.
  const auto nodes = nodesOf(*model.scene, std::numeric_limits<std::int32_t>::max());
  model.totals.nodes = nodes.size();
  std::vector<Affine> toWorld;
  toWorld.reserve(nodes.size());
  Affine toMetres;
  toMetres.linear *= metresPerUnit;
  for (const VisitedNode& visited : nodes) {
    const Affine& parent = visited.parent < 0 ? toMetres : toWorld[slotOf(visited.parent)];
    toWorld.push_back(parent * transformOf(visited.node->mTransformation));
    for (unsigned i = 0; i < visited.node->mNumMeshes; ++i) {
      addPlacement(model, *visited.node, visited.node->mMeshes[i], toWorld.back());
    }
  }
}

void writePlaced(const PlacedMeshes& model, ImportWriter& writer) {
  writer.totals(model.totals);
  for (const Placement& placement : model.placements) {
    const aiMesh& mesh = *model.scene->mMeshes[placement.mesh];
    const std::vector<CornerTriple>& triangles = model.meshes[placement.mesh].triangles;
    writer.object({placement.name->data, placement.name->length}, triangles.size());
    for (const CornerTriple& corners : triangles) {
      writer.triangle({placement.toWorld * vertexOf(mesh, corners[0]),
                       placement.toWorld * vertexOf(mesh, corners[1]),
                       placement.toWorld * vertexOf(mesh, corners[2])});
    }
  }
}

}  // namespace

bool sendScene(const std::string& path, ImportWriter& writer) {
  const AssimpFile file = readWithAssimp(path, Animations::Skip);
  PlacedMeshes model;
  model.scene = file.scene;
  model.totals.uniqueMeshes = model.scene->mNumMeshes;
  for (unsigned i = 0; i < model.scene->mNumMeshes; ++i) {
    model.meshes.push_back(trianglesOf(*model.scene->mMeshes[i]));
  }
  placeAll(model, file.frame.metresPerUnit);
  writer.fileFrame(file.frame.frame);
  writePlaced(model, writer);
  return writer.finish();
}

}  // namespace foretouch::internal
