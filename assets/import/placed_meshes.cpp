#include "assets/import/placed_meshes.h"

#include "assets/import/failure.h"
#include "assets/import/text.h"
#include "middleware/scene/scene.h"

namespace foretouch::internal {

void PlacedMeshes::place(std::size_t mesh, const std::string& node, const Affine& toFile) {
  const Mesh& placed = meshes[mesh];
  ++totals.meshInstances;
  totals.skippedPrimitives += placed.skippedPrimitives;
  totals.skippedFaces += placed.skippedFaces;
  if (placed.triangles.empty()) return;
  const std::string& name = node.empty() ? placed.name : node;
  totals.triangles += placed.triangles.size();
  ++totals.objects;
  nameBytes_ += readableText(name, kMaxObjectNameBytes).size();
  if (totals.triangles > kMaxTriangles || totals.objects > kMaxImportObjects ||
      nameBytes_ > kMaxImportNameBytes) {
    throw Failure{ImportFailure::TooLarge,
                  "instances counted, it has more than " + std::to_string(kMaxTriangles) +
                      " triangles, " + std::to_string(kMaxImportObjects) + " objects or " +
                      std::to_string(kMaxImportNameBytes) + " bytes of names"};
  }
  placements.push_back({mesh, name, toFile});
}

}  // namespace foretouch::internal
