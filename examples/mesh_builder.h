// examples/mesh_builder.h: named objects put together from a few parametric surfaces.
// Metres, +Y up; each object is made in its own frame and stored in the room's frame W.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace foretouch::examples {

struct MeshObject {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< Indices into `vertices`.
};

/// The frame of an object that stands at (x, y, z), turned by yawDeg about +Y: its +Z axis points
/// along (sin yaw, 0, cos yaw).
[[nodiscard]] Eigen::Isometry3d standingAt(double x, double y, double z, double yawDeg = 0.0);

/// Half width across and height of a surface of revolution, metres.
using Profile = std::vector<Eigen::Vector2d>;

class MeshBuilder {
 public:
  /// Begins the object `name`, placed by `frame`.
  void begin(std::string name, const Eigen::Isometry3d& frame = Eigen::Isometry3d::Identity());

  /// The surface u, v in [0,1]^2 -> point, as 2*rows*columns triangles; omits those without area,
  /// as at the pole of a sphere. `closedV`: v = 1 is v = 0 again.
  void surface(int rows, int columns, bool closedV,
               const std::function<Eigen::Vector3d(double u, double v)>& point);

  /// A box that is axis-aligned in the object's frame: 12 triangles.
  void box(const Eigen::Vector3d& low, const Eigen::Vector3d& high);

  /// A box with rounded edges: |x/a|^n + |y/b|^n + |z/c|^n = 1. Exponent 2 is an ellipsoid.
  void cushion(const Eigen::Vector3d& center, const Eigen::Vector3d& half, double exponent,
               int rows, int columns);

  /// A surface that turns the profile about the vertical through `base`; heights are above `base`.
  void revolve(const Eigen::Vector3d& base, const Profile& profile, int sides);

  /// A closed tube along a line of at least two different points.
  void tube(const std::vector<Eigen::Vector3d>& line, double radius, int sides);

  [[nodiscard]] const std::vector<MeshObject>& objects() const { return objects_; }
  [[nodiscard]] std::size_t numTriangles() const;

 private:
  void triangle(std::size_t a, std::size_t b, std::size_t c);

  std::vector<MeshObject> objects_;
  Eigen::Isometry3d frame_ = Eigen::Isometry3d::Identity();
};

}  // namespace foretouch::examples
