// tests/tools/random_clutter.h: triangles scattered in a box, as a scene for motions to hit.
#pragma once

#include <cstdint>
#include <vector>

#include "lss/lss.h"
#include "middleware/scene/scene.h"
#include "tools/portable_random.h"

namespace foretouch::test {

/// Triangles of up to 0.4 m with their first corners in a box of 3 m around the origin.
inline std::vector<Triangle> randomClutter(std::size_t count, std::uint64_t seed) {
  tools::PortableRandom random(seed);
  std::vector<Triangle> triangles(count);
  for (Triangle& t : triangles) {
    t.vertices[0] = random.inBox(1.5);
    t.vertices[1] = t.vertices[0] + random.inBox(0.2);
    t.vertices[2] = t.vertices[0] + random.inBox(0.2);
  }
  return triangles;
}

inline Scene clutterScene(std::size_t count, std::uint64_t seed) {
  return Scene::build({randomClutter(count, seed), std::vector<ObjectId>(count, 0), {"clutter"}})
      .value();
}

}  // namespace foretouch::test
