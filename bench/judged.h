// bench/judged.h: converts the product's types to the judge's plain ones.
#pragma once

#include <array>
#include <vector>

#include "articulated/skeleton.h"
#include "judge/motion.h"
#include "judge/vector.h"
#include "lss/index.h"
#include "lss/lss.h"

namespace foretouch::tools {

inline oracle::Vec3d plain(const Eigen::Vector3d& v) {
  return oracle::Vec3d(v);
}
inline Eigen::Vector3d rich(const oracle::Vec3d& v) {
  return {v.x, v.y, v.z};
}
/// w, x, y, z.
inline std::array<double, 4> plain(const Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}
inline oracle::Triangle plain(const Triangle& t) {
  return {plain(t.vertices[0]), plain(t.vertices[1]), plain(t.vertices[2])};
}
inline std::vector<oracle::Triangle> plain(const std::vector<Triangle>& triangles) {
  std::vector<oracle::Triangle> result;
  for (const Triangle& t : triangles) result.push_back(plain(t));
  return result;
}

inline std::vector<oracle::Joint> plainJoints(const Skeleton& skeleton, const Pose& from,
                                              const Pose& to) {
  std::vector<oracle::Joint> joints;
  for (JointId j = 0; j < skeleton.numJoints(); ++j) {
    const auto i = slotOf(j);
    joints.push_back({skeleton.parent(j), plain(from.rotations[i]), plain(to.rotations[i]),
                      plain(from.translations[i]), plain(to.translations[i])});
  }
  return joints;
}

/// The triangles of a product's scene, without those that are not finite, which nothing touches.
template <typename Scene>
std::vector<Triangle> finiteTriangles(const Scene& scene) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i < scene.numTriangles(); ++i) {
    const Triangle& triangle = scene.triangle(static_cast<int>(i));
    if (isFinite(triangle)) triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace foretouch::tools
