#include "assets/import/scene.h"

#include <string>
#include <vector>

#include "assets/import/placed_meshes.h"
#include "assets/import/text.h"

namespace foretouch::internal {

namespace {

/// The last one says how many others there were.
void sendNotes(const PlacedMeshes& placed, ImportWriter& writer) {
  const ImportTotals& totals = placed.totals;
  std::vector<std::string> notes = skippedNotes(totals.skippedPrimitives, totals.skippedFaces);
  notes.insert(notes.end(), placed.notes.begin(), placed.notes.end());
  if (notes.size() > kMaxImportNotes) {
    const std::size_t more = notes.size() - (kMaxImportNotes - 1);
    notes.resize(kMaxImportNotes - 1);
    notes.push_back(std::to_string(more) + " more notes");
  }
  for (const std::string& note : notes) writer.note(note);
}

}  // namespace

bool sendScene(const std::string& path, ImportWriter& writer) {
  const PlacedMeshes placed = placedMeshesOf(path);
  writer.fileFrame(placed.frame);
  writer.totals(placed.totals);
  sendNotes(placed, writer);
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
