// examples/mesh_builder.cpp: see the header.
#include "examples/mesh_builder.h"

#include <cmath>
#include <utility>

#include "examples/circle.h"
#include "lss/index.h"

namespace foretouch::examples {
namespace {

using Eigen::Vector3d;

/// sign(x)*|x|^power: the cosine and sine of a superellipse. What is zero up to rounding is zero: a
/// small power would make 1e-16 visible.
double signedPower(double x, double power) {
  return std::abs(x) < 1e-12 ? 0.0 : std::copysign(std::pow(std::abs(x), power), x);
}

}  // namespace

Eigen::Isometry3d standingAt(double x, double y, double z, double yawDeg) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.translate(Vector3d(x, y, z));
  frame.rotate(Eigen::AngleAxisd(yawDeg * kPi / 180.0, Vector3d::UnitY()));
  return frame;
}

void MeshBuilder::begin(std::string name, const Eigen::Isometry3d& frame) {
  objects_.push_back({std::move(name), {}, {}});
  frame_ = frame;
}

void MeshBuilder::triangle(std::size_t a, std::size_t b, std::size_t c) {
  MeshObject& object = objects_.back();
  const Vector3d& p = object.vertices[a];
  const Vector3d across = (object.vertices[b] - p).cross(object.vertices[c] - p);
  constexpr double kSmallestArea = 1e-9;  // m^2: files keep 10 micrometres, slivers would collapse
  if (across.norm() > 2.0 * kSmallestArea) {
    object.triangles.push_back({a, b, c});
  }
}

void MeshBuilder::surface(int rows, int columns, bool closedV,
                          const std::function<Vector3d(double u, double v)>& point) {
  MeshObject& object = objects_.back();
  const std::size_t first = object.vertices.size();
  const int across = closedV ? columns : columns + 1;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j < across; ++j) {
      const Vector3d p = point(static_cast<double>(i) / rows, static_cast<double>(j) / columns);
      object.vertices.push_back(frame_ * p);
    }
  }
  const auto at = [&](int i, int j) {
    return first + static_cast<std::size_t>(i * across + j % across);
  };
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      triangle(at(i, j), at(i, j + 1), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i + 1, j));
    }
  }
}

void MeshBuilder::box(const Vector3d& low, const Vector3d& high) {
  MeshObject& object = objects_.back();
  const std::size_t first = object.vertices.size();
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d p((corner & 1) != 0 ? high.x() : low.x(), (corner & 2) != 0 ? high.y() : low.y(),
                     (corner & 4) != 0 ? high.z() : low.z());
    object.vertices.push_back(frame_ * p);
  }
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces = {
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& [a, b, c, d] : kFaces) {
    triangle(first + a, first + b, first + c);
    triangle(first + a, first + c, first + d);
  }
}

void MeshBuilder::cushion(const Vector3d& center, const Vector3d& half, double exponent, int rows,
                          int columns) {
  const double power = 2.0 / exponent;
  surface(rows, columns, true, [&](double u, double v) -> Vector3d {
    const double polar = kPi * u, around = 2.0 * kPi * v;
    const double ring = signedPower(std::sin(polar), power);
    const Vector3d p(ring * signedPower(std::cos(around), power),
                     signedPower(std::cos(polar), power),
                     -ring * signedPower(std::sin(around), power));
    return center + half.cwiseProduct(p);
  });
}

void MeshBuilder::revolve(const Vector3d& base, const Profile& profile, int sides) {
  const int rows = static_cast<int>(profile.size()) - 1;
  surface(rows, sides, true, [&](double u, double v) -> Vector3d {
    const Eigen::Vector2d& p = profile[slotOf(std::lround(u * rows))];
    const double around = 2.0 * kPi * v;
    return base + Vector3d(p.x() * std::cos(around), p.y(), p.x() * std::sin(around));
  });
}

void MeshBuilder::tube(const std::vector<Vector3d>& line, double radius, int sides) {
  const std::size_t last = line.size() - 1;
  const int rows = static_cast<int>(line.size()) + 1;  // the first and last rings close the ends
  surface(rows, sides, true, [&](double u, double v) -> Vector3d {
    const auto row = std::lround(u * rows);
    const std::size_t k = row == 0 ? 0 : row == rows ? last : slotOf(row) - 1;
    const Vector3d along = (line[k == last ? k : k + 1] - line[k == 0 ? 0 : k - 1]).normalized();
    // No line here runs along (1,2,3), so this cross product never vanishes.
    const Vector3d side = along.cross(Vector3d(1.0, 2.0, 3.0)).normalized();
    const double around = 2.0 * kPi * v, ring = row == 0 || row == rows ? 0.0 : radius;
    return line[k] + ring * (std::cos(around) * side + std::sin(around) * along.cross(side));
  });
}

std::size_t MeshBuilder::numTriangles() const {
  std::size_t total = 0;
  for (const MeshObject& object : objects_) {
    total += object.triangles.size();
  }
  return total;
}

}  // namespace foretouch::examples
