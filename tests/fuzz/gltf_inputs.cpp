#include "tests/fuzz/gltf_inputs.h"

#include <new>
#include <string>

#include "assets/import/failure.h"
#include "assets/import/model.h"
#include "assets/import/placed_meshes.h"
#include "tests/fuzz/import_inputs.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

void checkPlaced(const internal::PlacedMeshes& placed) {
  for (const auto& mesh : placed.meshes) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t corner : triangle) {
        require(corner < mesh.vertices.size(), "corners exist");
      }
    }
  }
  for (const auto& placement : placed.placements) {
    require(placement.mesh < placed.meshes.size(), "placed meshes exist");
  }
}

/// As the importer's main() does it.
template <typename Read>
bool answers(const Read& read) {
  try {
    read();
    return true;
  } catch (const internal::Failure& failure) {
    require(!failure.text.empty(), "a refusal says why");
  } catch (const std::bad_alloc&) {
  }
  return false;
}

}  // namespace

bool feedGltf(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  const bool isScene = answers([&] { checkPlaced(internal::placedMeshesOfGltf(file.path())); });
  internal::ModelQuestion question;
  question.path = file.path();
  return answers([&] { checkModel(internal::readGltf(question)); }) || isScene;
}

}  // namespace foretouch::fuzz
