// tools/glb/glb_content.h: a GLB under construction: its document and its bytes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "tools/glb/glb_mesh.h"
#include "tools/glb/gltf_document.h"

namespace foretouch::tools {

struct GlbMaterial {
  const char* name = "";
  std::array<double, 4> color{1.0, 1.0, 1.0, 1.0};  ///< Linear red, green, blue, and opacity.
};

/// Triangles and their look.
struct MeshPart {
  GlbMesh mesh;
  std::size_t material = 0;
  bool areLines = false;  ///< Two indices per line, in place of three per triangle.
};

class GlbContent {
 public:
  explicit GlbContent(const std::string& generator) : document_(generator) {}

  [[nodiscard]] GltfDocument& document() { return document_; }

  /// Shows both sides of its faces, because our triangles are two-sided.
  std::size_t addMaterial(const GlbMaterial& material);
  /// Precondition: at least one part, each with a triangle or a line.
  std::size_t addMesh(const std::string& name, const std::vector<MeshPart>& parts);
  /// Rows of 1, 3 or 4 floats for an animation; returns the accessor. Precondition: not empty.
  std::size_t addRows(const std::vector<float>& values, int width);
  /// Several such lists of single numbers, in one view; returns the first one's accessor.
  std::size_t addLists(const std::vector<std::vector<float>>& lists);

  /// Errors name the file: what does not fit into a GLB, or cannot be written.
  Result<Done> writeFile(const std::string& path) const;

 private:
  nlohmann::json addPart(const MeshPart& part);
  std::size_t addVertices(const std::vector<Eigen::Vector3f>& vertices, bool areBounded);

  GltfDocument document_;
  std::string bytes_;
};

}  // namespace foretouch::tools
