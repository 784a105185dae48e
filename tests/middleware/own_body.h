// tests/middleware/own_body.h: random bodies whose own links meet.
#pragma once

#include <utility>
#include <vector>

#include "articulated/avatar.h"
#include "articulated/motion.h"
#include "middleware/scene/scene.h"
#include "tests/support/random_motion.h"

namespace foretouch::test {

/// A random tree of links with LSS, on its way from one random pose to another.
struct OwnBody {
  RandomMotion steps;
  Avatar avatar;

  [[nodiscard]] ChainMotion motion() const { return {steps.skeleton, steps.from, steps.to}; }
};

inline std::vector<Lss> randomLss(Random& random) {
  std::vector<Lss> lss;
  const int count = 1 + random.below(3);
  for (int i = 0; i < count; ++i) {
    Lss one{random.inBox(0.15), random.inBox(0.3), random.magnitude(1e-3, 0.08)};
    if (random.chance(0.1)) one.b = one.a;
    if (random.chance(0.1)) one.radius = 0.0;
    lss.push_back(one);
  }
  return lss;
}

inline OwnBody randomOwnBody(Random& random) {
  RandomMotion steps = randomMotion(random, 3 + random.below(8));
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < steps.skeleton.numJoints(); ++link) {
    lss.push_back(link > 1 && random.chance(0.2) ? std::vector<Lss>{} : randomLss(random));
  }
  Avatar avatar = Avatar::build(steps.skeleton, lss).value();
  return {std::move(steps), std::move(avatar)};
}

/// A triangle that no body here reaches.
inline const Scene& farScene() {
  static const Scene scene = [] {
    using Eigen::Vector3d;
    RawScene raw;
    raw.objectNames = {"far"};
    raw.triangles.push_back({{Vector3d(90, 90, 90), Vector3d(91, 90, 90), Vector3d(90, 91, 90)}});
    raw.objectOf = {0};
    return Scene::build(std::move(raw)).value();
  }();
  return scene;
}

}  // namespace foretouch::test
