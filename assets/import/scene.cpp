#include "assets/import/scene.h"

#include <string>
#include <vector>

#include "assets/import/placed_meshes.h"
#include "assets/import/text.h"

namespace foretouch::internal {

bool sendScene(const std::string& path, ImportWriter& writer) {
  const PlacedMeshes placed = placedMeshesOf(path);
  writer.fileFrame(placed.frame);
  writer.totals(placed.totals);
  for (const std::string& note : placed.notes) writer.note(note);
  const ImportTotals& totals = placed.totals;
  for (const std::string& note : skippedNotes(totals.skippedPrimitives, totals.skippedFaces)) {
    writer.note(note);
  }
  for (const PlacedMeshes::Placement& placement : placed.placements) {
    const PlacedMeshes::Mesh& mesh = placed.meshes[placement.mesh];
    writer.object(placement.name, mesh.triangles.size());
    for (const CornerTriple& corners : mesh.triangles) {
      writer.triangle({placement.toFile * mesh.vertices[corners[0]],
                       placement.toFile * mesh.vertices[corners[1]],
                       placement.toFile * mesh.vertices[corners[2]]});
    }
  }
  return writer.finish();
}

}  // namespace foretouch::internal
