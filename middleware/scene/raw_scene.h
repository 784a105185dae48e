// middleware/scene/raw_scene.h: triangles on their way into a Scene, and an audit of them; the
// numbers of triangles and objects. World W: metres, right-handed, +Y up.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "lss/lss.h"

namespace foretouch {

using TriangleId = std::int32_t;
using ObjectId = std::int32_t;

inline constexpr std::size_t kMaxTriangles = 50'000'000;

/// Triangles as they came from a file or from memory, unchecked.
struct RawScene {
  std::vector<Triangle> triangles;
  std::vector<ObjectId> objectOf;        ///< Per triangle: index into objectNames.
  std::vector<std::string> objectNames;  ///< Need not be unique.
};

/// Facts about a scene that a user may want to know. Degenerate triangles are legal and kept: a
/// triangle without area is still a segment or a point that a link can touch.
struct SceneAudit {
  std::size_t triangles = 0;         ///< Kept.
  std::size_t droppedNonFinite = 0;  ///< Dropped: a vertex with NaN or infinity has no place.
  std::size_t zeroArea = 0;          ///< Kept: the three vertices lie on a line, as computed in
                                     ///< double.
  std::size_t duplicates = 0;        ///< Kept: the same three points as an earlier triangle.
  Eigen::Vector3d boxMin = Eigen::Vector3d::Zero();
  Eigen::Vector3d boxMax = Eigen::Vector3d::Zero();
  double shortestEdge = 0.0, longestEdge = 0.0;  ///< Metres; the shortest that is not zero.
};

/// The box around the finite triangles; empty without any. O(n), and much cheaper than an audit.
[[nodiscard]] Eigen::AlignedBox3d boundsOf(const RawScene& raw);

/// Counts and measures what build() would keep; also for scenes that build() refuses.
[[nodiscard]] SceneAudit auditScene(const RawScene& raw);

}  // namespace foretouch
