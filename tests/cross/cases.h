// tests/cross/cases.h: what every machine is asked alike. Nothing but the language's own library:
// the judge of the answers reads it too.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace foretouch::test {

/// One clip in one scene, a line of a file of cases: words parted by tabs, in this order.
struct CrossCase {
  std::string scene, avatar, clip;  ///< Files: OBJ, an avatar's, BVH.
  int stride = 1;                   ///< Frames from one step to the next.
  double scale = 1.0;               ///< Of the clip, metres a unit; then turned, then moved.
  double yawDeg = 0.0;
  std::array<double, 3> origin{};
};

[[nodiscard]] std::string formatCase(const CrossCase& asked);
/// Of a file; throws std::runtime_error, with the file and the line, where it is none.
[[nodiscard]] std::vector<CrossCase> readCases(const std::string& path);

/// An OBJ file's vertices and triangles (polygons as fans), and nothing else of it.
struct ObjScene {
  std::vector<double> positions;       ///< Three a vertex.
  std::vector<std::uint32_t> indices;  ///< Three a triangle.
};
/// Throws std::runtime_error where it cannot be read or a corner has no vertex.
[[nodiscard]] ObjScene readObj(const std::string& path);

}  // namespace foretouch::test
