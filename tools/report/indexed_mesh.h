// tools/report/indexed_mesh.h: separate triangles as an indexed mesh, and simplified. Metres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
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
  /// If a mesh has more than `most` triangles, vertices in one cell of a grid are merged first,
  /// which is O(n): their error is that of all that follows.
  explicit Simplifier(const Corners& corners,
                      std::size_t most = std::numeric_limits<std::size_t>::max());

  /// As few triangles as an error of `errorM` allows.
  [[nodiscard]] Simplified within(double errorM) const;
  /// At most about `target` triangles.
  [[nodiscard]] Simplified downTo(std::size_t target) const;

  void append(const Simplified& made, Corners& corners) const;
  /// The triangles of the mesh as it was given.
  [[nodiscard]] std::size_t triangles() const { return trianglesGiven_; }

 private:
  [[nodiscard]] Simplified merged(std::size_t target, const Simplified& made) const;
  [[nodiscard]] bool hasEdges() const;
  [[nodiscard]] Simplified collapsed(std::size_t target, float error) const;

  ViewMesh mesh_;
  double scaleM_ = 0.0;   ///< The size of an error of 1.
  double mergedM_ = 0.0;  ///< The error of the merged vertices.
  std::size_t trianglesGiven_ = 0;
};

}  // namespace foretouch::tools
