// tools/report/indexed_mesh.h: separate triangles as an indexed mesh, and simplified. Metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tools/report/view_document.h"

namespace foretouch::tools {

/// x, y, z per corner, three corners per triangle.
using Corners = std::vector<float>;

/// Merges equal corners into one vertex (zeros of either sign are equal); triangles keep their
/// order.
[[nodiscard]] ViewMesh indexed(Corners corners);

/// Fewer triangles over some of a mesh's vertices.
struct Simplified {
  std::vector<std::uint32_t> indices;
  double errorM = 0.0;  ///< Details up to about this size may be gone: an estimate.

  [[nodiscard]] std::size_t triangles() const { return indices.size() / 3; }
};

/// Simplifies one mesh, any number of times: by collapsing edges [Garland97] and, if loose
/// triangles have too little topology for that, by merging vertices in one cell of a grid; both by
/// meshoptimizer. Time and memory: O(n log n), O(n).
class Simplifier {
 public:
  explicit Simplifier(const Corners& corners);

  /// As few triangles as an error of `errorM` allows.
  [[nodiscard]] Simplified within(double errorM) const;
  /// At most about `target` triangles.
  [[nodiscard]] Simplified downTo(std::size_t target) const;

  void append(const Simplified& made, Corners& corners) const;
  [[nodiscard]] std::size_t triangles() const { return mesh_.triangles(); }

 private:
  [[nodiscard]] bool hasEdges() const;
  [[nodiscard]] Simplified collapsed(std::size_t target, float error) const;

  ViewMesh mesh_;
  double scaleM_ = 0.0;  ///< Of an error of 1.
};

}  // namespace foretouch::tools
