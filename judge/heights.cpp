#include "judge/heights.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace foretouch::oracle {
namespace {

/// Where the vertical line through (x, z) meets the triangle, seen from above.
std::optional<double> heightAt(const Triangle& t, double x, double z) {
  constexpr double kUprightArea = 1e-9;
  const auto e1 = t[1] - t[0], e2 = t[2] - t[0];
  const double area = e1.x * e2.z - e1.z * e2.x;
  if (!(std::abs(area) > kUprightArea)) return std::nullopt;
  const double px = x - t[0].x, pz = z - t[0].z;
  const double u = (px * e2.z - pz * e2.x) / area, v = (e1.x * pz - e1.z * px) / area;
  if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) return std::nullopt;
  return t[0].y + u * e1.y + v * e2.y;
}

}  // namespace

std::vector<double> heightsAt(const Scene& scene, double x, double z) {
  const Box column{{x, scene.box().low.y, z}, {x, scene.box().high.y, z}};
  std::vector<int> met;
  scene.collect(column, static_cast<std::size_t>(scene.numTriangles()), met);
  std::vector<double> heights;
  for (const int id : met) {
    if (const auto y = heightAt(scene.triangle(id), x, z)) heights.push_back(*y);
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

}  // namespace foretouch::oracle
