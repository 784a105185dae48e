// assets/import/urdf_text.h: a URDF's text reduced to what a surface needs, in the dialect that
// urdfdom reads. In foretouch-import only. Not installed.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace foretouch::internal {

enum class UrdfShapeKind : std::uint8_t { Collision, Visual };

/// A shape by its link's name and its place among the link's shapes of its kind.
using UrdfShapeKey = std::tuple<std::string, UrdfShapeKind, std::size_t>;

struct UrdfText {
  std::string xml;
  /// urdfdom knows no capsules: they stand in `xml` as the cylinders between their round ends.
  std::set<UrdfShapeKey> capsules;
  std::vector<std::string> notes;
};

/// Keeps links with their shapes and joints with their frames, axes, limits and mimics. What else
/// is in such files (masses, materials, transmissions) would only be further reasons to refuse
/// them. Joints get the limits, and limits the effort and velocity, without which urdfdom refuses
/// them. Throws Failure (assets/import/assimp.h) where `text` is no XML with a <robot>.
[[nodiscard]] UrdfText readUrdfText(const std::string& text);

}  // namespace foretouch::internal
