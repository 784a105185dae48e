// The meshes of a glTF file as placed by its nodes: assets/import/placed_meshes.h.
#include <limits>
#include <utility>

#include "assets/import/gltf_physics.h"
#include "assets/import/gltf_scene.h"
#include "assets/import/placed_meshes.h"
#include "lss/index.h"

namespace foretouch::internal {

PlacedMeshes placedMeshesOfGltf(const std::string& path) {
  GltfScene scene(path);
  PlacedMeshes placed;
  placed.frame = gltfFrame();
  placed.totals.uniqueMeshes = scene.numPrimitives();
  // Only the memory limit bounds a scene's tree: its nodes are not sent.
  const auto nodes = scene.nodes(std::numeric_limits<std::int32_t>::max());
  placed.totals.nodes = nodes.size();
  std::vector<Affine> toFile;
  toFile.reserve(nodes.size());
  std::map<const GltfPrimitive*, std::size_t> numberOf;
  for (const GltfNode& node : nodes) {
    toFile.push_back(node.parent < 0 ? node.toParent : toFile[slotOf(node.parent)] * node.toParent);
    const auto& primitives = scene.primitivesOf(node);
    for (const Affine& instance : scene.instancesOf(node)) {
      for (const GltfPrimitive& primitive : primitives) {
        const auto [entry, isNew] = numberOf.emplace(&primitive, placed.meshes.size());
        if (isNew) {
          placed.meshes.push_back({primitive.name, primitive.vertices, primitive.triangles,
                                   primitive.skippedPrimitives, primitive.skippedFaces});
        }
        placed.place(entry->second, node.name, toFile.back() * instance);
      }
    }
  }
  placed.notes = scene.notes();
  if (!gltfColliders(scene.document()).colliders.empty()) {
    placed.notes.emplace_back(
        "its spheres and capsules are colliders of a body, and no part of a scene: its meshes are");
  }
  return placed;
}

}  // namespace foretouch::internal
