#include "bench/surface.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"

namespace foretouch::tools {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Shrinks the radius of vertices by this share, so that rounding leaves them inside.
constexpr double kInside = 1.0 - 1e-12;
constexpr int kLeastAround = 6, kLeastRings = 2;

/// How an LSS is divided: around its axis, from a pole to the cylinder, along the cylinder.
struct Division {
  int around, rings, rows;  ///< No row: a sphere.
  [[nodiscard]] std::size_t triangles() const {
    return static_cast<std::size_t>(2 * around) * static_cast<std::size_t>(rows + 2 * rings - 1);
  }
};

Division divisionOf(const Lss& lss, double edge) {
  constexpr double kMost = 4096.0;
  const auto parts = [&](double length, int least) {
    return std::max(least, static_cast<int>(std::min(kMost, std::ceil(length / edge))));
  };
  return {parts(2.0 * kPi * lss.radius, kLeastAround), parts(0.5 * kPi * lss.radius, kLeastRings),
          lss.a == lss.b ? 0 : parts((lss.b - lss.a).norm(), 1)};
}

std::size_t trianglesOf(const Avatar& avatar, double edge) {
  std::size_t count = 0;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) count += divisionOf(lss, edge).triangles();
  }
  return count;
}

/// Circles from pole to pole; the poles are circles of one repeated point.
std::vector<std::vector<Eigen::Vector3d>> circlesOf(const Lss& lss, const Division& division) {
  const Eigen::Vector3d axis = lss.b - lss.a;
  const Eigen::Vector3d up =
      axis.norm() > 0.0 ? axis.normalized() : Eigen::Vector3d::UnitY().eval();
  const Eigen::Vector3d u = up.unitOrthogonal(), v = up.cross(u);
  const double radius = kInside * lss.radius;
  std::vector<std::vector<Eigen::Vector3d>> circles;
  const auto addCircle = [&](const Eigen::Vector3d& centre, double r, double height) {
    circles.emplace_back();
    for (int i = 0; i < division.around; ++i) {
      const double angle = 2.0 * kPi * i / division.around;
      circles.back().push_back(centre + height * up +
                               r * (std::cos(angle) * u + std::sin(angle) * v));
    }
  };
  for (int ring = 0; ring <= division.rings; ++ring) {
    const double angle = 0.5 * kPi * ring / division.rings;
    addCircle(lss.a, ring == 0 ? 0.0 : radius * std::sin(angle), -radius * std::cos(angle));
  }
  for (int row = 1; row < division.rows; ++row) {
    addCircle(lss.a + axis * (static_cast<double>(row) / division.rows), radius, 0.0);
  }
  const bool isSphere = division.rows == 0;  // whose two half spheres share their widest circle
  for (int ring = isSphere ? division.rings - 1 : division.rings; ring >= 0; --ring) {
    const double angle = 0.5 * kPi * ring / division.rings;
    addCircle(lss.b, ring == 0 ? 0.0 : radius * std::sin(angle), radius * std::cos(angle));
  }
  return circles;
}

void addSkin(const Lss& lss, const Division& division, std::vector<Triangle>& triangles) {
  const auto circles = circlesOf(lss, division);
  const auto around = static_cast<std::size_t>(division.around);
  for (std::size_t c = 0; c + 1 < circles.size(); ++c) {
    for (std::size_t i = 0; i < around; ++i) {
      const std::size_t next = (i + 1) % around;
      if (c + 2 < circles.size()) {  // not at the last pole, where these two corners are one
        triangles.push_back({{circles[c][i], circles[c + 1][i], circles[c + 1][next]}});
      }
      if (c > 0) triangles.push_back({{circles[c][i], circles[c + 1][next], circles[c][next]}});
    }
  }
}

}  // namespace

std::vector<std::vector<Triangle>> lssSkins(const Avatar& avatar, std::size_t count) {
  constexpr int kHalvings = 60;
  double fine = 1e-4, coarse = 10.0;  // metres
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (fine + coarse);
    (trianglesOf(avatar, middle) > count ? fine : coarse) = middle;
  }
  std::vector<std::vector<Triangle>> skins(countOf(avatar.numLinks()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      addSkin(lss, divisionOf(lss, coarse), skins[slotOf(link)]);
    }
  }
  return skins;
}

}  // namespace foretouch::tools
