#include "tests/middleware/random_scene.h"

#include <string>

namespace foretouch::test {

using Eigen::Vector3d;

RawScene clutter(Random& random, int count, int objects, const Vector3d& center) {
  RawScene raw;
  for (int i = 0; i < objects; ++i) raw.objectNames.push_back("object" + std::to_string(i));
  for (int i = 0; i < count; ++i) {
    Triangle t;
    const Vector3d middle = center + random.inBox(2.0);
    const double size = random.magnitude(1e-3, 1.0);
    for (Vector3d& v : t.vertices) v = middle + random.inBox(size);
    if (!raw.triangles.empty() && random.chance(0.3)) {
      const Triangle& other = raw.triangles[static_cast<std::size_t>(random.below(i))];
      switch (random.below(3)) {
        case 0:
          t = {{other.vertices[1], other.vertices[2], other.vertices[0]}};
          break;                                                                     // coincident
        case 1: t = {{other.vertices[0], other.vertices[1], t.vertices[2]}}; break;  // shared edge
        default: t.vertices[2] = 0.5 * (t.vertices[0] + t.vertices[1]); break;       // no area
      }
    }
    raw.triangles.push_back(t);
    raw.objectOf.push_back(random.below(objects));
  }
  return raw;
}

RandomBody bodyInClutter(Random& random, int links, const Vector3d& center) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int j = 0; j < links; ++j) {
    const JointId parent = j == 0 ? kNoParent : (random.chance(0.6) ? j - 1 : random.below(j));
    const Vector3d offset = j == 0 ? center + random.inBox(1.0) : random.arrow(0.05, 0.4);
    raw.joints.push_back({"link" + std::to_string(j), parent, offset, random.rotation()});
    lss.emplace_back();
    for (int k = 0; k <= random.below(3); ++k) {
      lss.back().push_back({random.inBox(0.15), random.inBox(0.15), random.magnitude(1e-3, 0.03)});
    }
  }
  RandomBody body{Avatar::build(Skeleton::build(raw).value(), lss).value(), {}, {}};
  body.from = body.to = restPose(body.avatar.skeleton());
  const double strength = random.magnitude(1e-3, 1.0);
  for (std::size_t j = 0; j < body.to.rotations.size(); ++j) {
    body.to.rotations[j] =
        body.from.rotations[j] * random.turn(strength * random.uniform(0.0, 1.5));
  }
  body.to.translations[0] += strength * random.inBox(0.4);
  return body;
}

}  // namespace foretouch::test
