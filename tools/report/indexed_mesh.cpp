#include "tools/report/indexed_mesh.h"

#include <meshoptimizer.h>

namespace foretouch::tools {
namespace {

constexpr std::size_t kVertexBytes = 3 * sizeof(float);

}  // namespace

ViewMesh indexed(Corners corners) {
  ViewMesh mesh;
  const std::size_t count = corners.size() / 3;
  if (count == 0) return mesh;
  for (float& number : corners) number += 0.0f;  // the bytes are compared
  mesh.indices.resize(count);
  const std::size_t vertices = meshopt_generateVertexRemap(mesh.indices.data(), nullptr, count,
                                                           corners.data(), count, kVertexBytes);
  mesh.positions.resize(3 * vertices);
  meshopt_remapVertexBuffer(mesh.positions.data(), corners.data(), count, kVertexBytes,
                            mesh.indices.data());
  return mesh;
}

Simplified simplified(const Corners& corners, std::size_t target) {
  const ViewMesh mesh = indexed(corners);
  Simplified made;
  if (mesh.indices.empty()) return made;
  // An error of 1 is the size of the mesh: the target alone decides.
  constexpr float kAnyError = 1.0f;
  float error = 0.0f;
  std::vector<std::uint32_t> kept(mesh.indices.size());
  kept.resize(meshopt_simplifySloppy(kept.data(), mesh.indices.data(), mesh.indices.size(),
                                     mesh.positions.data(), mesh.vertices(), kVertexBytes,
                                     3 * target, kAnyError, &error));
  made.corners.reserve(3 * kept.size());
  for (const std::uint32_t vertex : kept) {
    const float* const place = mesh.positions.data() + std::size_t{3} * vertex;
    made.corners.insert(made.corners.end(), place, place + 3);
  }
  const float scale = meshopt_simplifyScale(mesh.positions.data(), mesh.vertices(), kVertexBytes);
  made.error = static_cast<double>(error) * static_cast<double>(scale);
  return made;
}

}  // namespace foretouch::tools
