// tests/middleware/mesh_body.h: meshes for the links of a random body.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "lss/triangle.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {

/// Triangles inside the link's LSS, `count` in each: their corners lie within `share` of the radius
/// of the axis.
inline std::vector<std::vector<Triangle>> meshWithin(const Avatar& avatar, Random& random,
                                                     int count, double share) {
  std::vector<std::vector<Triangle>> meshes(static_cast<std::size_t>(avatar.numLinks()));
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    for (const Lss& lss : avatar.lss(link)) {
      for (int i = 0; i < count; ++i) {
        Triangle triangle;
        const double along = random.uniform(0.0, 1.0);
        for (Eigen::Vector3d& v : triangle.vertices) {
          const double s = std::min(1.0, std::max(0.0, along + random.uniform(-0.1, 0.1)));
          v = lss.a + s * (lss.b - lss.a) +
              random.uniform(0.0, share) * lss.radius * random.direction();
        }
        meshes[static_cast<std::size_t>(link)].push_back(triangle);
      }
    }
  }
  return meshes;
}

}  // namespace foretouch::test
