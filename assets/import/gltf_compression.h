// assets/import/gltf_compression.h: what compressed glTF files hold: views compressed by
// meshoptimizer (EXT_meshopt_compression), and meshes compressed by Draco
// (KHR_draco_mesh_compression). In foretouch-import only. Not installed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "assets/import/gltf_elements.h"

namespace draco {
class Mesh;
}

namespace foretouch::internal {

/// As the extension describes it.
struct MeshoptView {
  std::string_view bytes;
  std::uint64_t count = 0, stride = 0;
  std::string mode, filter;
};
/// count * stride bytes. Throws Failure, at `place`.
[[nodiscard]] std::string decompress(const MeshoptView& view, const std::string& place);

class DracoMesh {
 public:
  /// Throws Failure, at `place`.
  DracoMesh(std::string_view bytes, std::string place);
  ~DracoMesh();
  DracoMesh(const DracoMesh&) = delete;
  DracoMesh& operator=(const DracoMesh&) = delete;

  /// Three per triangle.
  [[nodiscard]] std::vector<double> indices() const;
  /// The attribute with this number in the compressed data, read as the accessor's layout says.
  [[nodiscard]] std::vector<double> numbers(std::uint64_t attribute,
                                            const ElementLayout& layout) const;

 private:
  std::string place_;
  std::unique_ptr<draco::Mesh> mesh_;
};

}  // namespace foretouch::internal
