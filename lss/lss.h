// lss/lss.h: the line-swept sphere (LSS), the volume that bounds a link, and the two-sided triangle
// of a scene or of a link's surface. Lengths in metres. Readers from elsewhere call an LSS a
// capsule. Source: [Redon04] for LSS as the bounding volume of an avatar's links (REFERENCES.md).
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include <Eigen/Core>

namespace foretouch {

/// The closed convex hull of three points. Zero area (a segment or a point) is legal.
/// Two-sided: the order of the vertices carries no meaning.
struct Triangle {
  std::array<Eigen::Vector3d, 3> vertices;
};

/// True if it has no NaN and no infinity.
[[nodiscard]] inline bool isFinite(const Triangle& triangle) {
  return std::all_of(triangle.vertices.begin(), triangle.vertices.end(),
                     [](const Eigen::Vector3d& v) { return v.allFinite(); });
}

/// All points within `radius` of the segment from `a` to `b` (the axis).
/// A zero-length axis is legal and means a sphere; a zero radius is legal and means a segment.
struct Lss {
  Eigen::Vector3d a = Eigen::Vector3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  double radius = 0.0;  ///< Metres, finite, >= 0.
};

/// True if every coordinate is finite and the radius is finite and not negative.
[[nodiscard]] inline bool isValid(const Lss& lss) {
  return lss.a.allFinite() && lss.b.allFinite() && lss.radius >= 0.0 &&
         lss.radius <= std::numeric_limits<double>::max();
}

/// Volume in cubic metres: a cylinder and two half spheres.
[[nodiscard]] inline double volume(const Lss& lss) {
  constexpr double kPi = 3.14159265358979323846;
  const double r2 = lss.radius * lss.radius;
  return kPi * r2 * ((lss.b - lss.a).norm() + 4.0 / 3.0 * lss.radius);
}

}  // namespace foretouch
