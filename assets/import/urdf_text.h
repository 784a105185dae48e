// assets/import/urdf_text.h: reduces a URDF's text to the parts that a surface needs, in the
// dialect that urdfdom reads. In foretouch-import only. Not installed.
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
  /// urdfdom has no capsules: `xml` has the cylinders between their round ends instead.
  std::set<UrdfShapeKey> capsules;
  std::vector<std::string> notes;
};

/// Keeps links with their shapes and joints with their frames, axes, limits and mimics. Drops the
/// rest (masses, materials, transmissions), which could only cause further refusals. Adds limits to
/// joints, and effort and velocity to limits, because urdfdom requires them. Throws Failure
/// (assets/import/failure.h) if `text` is not XML with a <robot>.
[[nodiscard]] UrdfText readUrdfText(const std::string& text);

}  // namespace foretouch::internal
