// assets/import/gltf_extents.h: whether the parts of a glTF file lie where its JSON says: accessors
// in buffer views, these in buffers, and these in existing bytes. Source: Khronos, "glTF 2.0
// Specification", "Binary Data Storage". In foretouch-import only.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "assets/import/faults.h"

namespace foretouch::internal {

/// The source of the buffers' bytes.
struct GltfSources {
  bool isBinary = false;                     ///< A GLB file.
  std::optional<std::uint64_t> binaryBytes;  ///< Of its second chunk.
  std::string folder;                        ///< Where side files are.
};

/// Of an accessor's "componentType"; 0 if it does not exist.
[[nodiscard]] std::uint64_t componentBytes(const nlohmann::json& componentType);

struct ElementShape {
  std::uint64_t rows = 0, columns = 0;
};
/// Of an accessor's "type"; 0 if it does not exist.
[[nodiscard]] ElementShape elementShape(const nlohmann::json& type);

/// Precondition: checkRules() found nothing. Faults are at paths of keys.
void checkExtents(const nlohmann::json& document, const GltfSources& sources, Faults& faults);

}  // namespace foretouch::internal
