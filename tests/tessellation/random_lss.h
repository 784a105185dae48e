// tests/tessellation/random_lss.h: a random moving chain with random LSS on its links.
#pragma once

#include <vector>

#include "articulated/avatar.h"
#include "tests/support/random_motion.h"

namespace foretouch::test {

struct MovingBody {
  RandomMotion motion;
  Avatar avatar;

  MovingBody(Random& random, int joints)
      : motion(randomMotion(random, joints)),
        avatar(Avatar::build(motion.skeleton, randomLss(random, joints)).value()) {}

 private:
  /// None to three per link, at least one in all; includes spheres and radius zero.
  static std::vector<std::vector<Lss>> randomLss(Random& random, int joints) {
    std::vector<std::vector<Lss>> lss(static_cast<std::size_t>(joints));
    for (std::size_t j = 0; j < lss.size(); ++j) {
      const int count = j + 1 == lss.size() ? 1 + random.below(3) : random.below(4);
      for (int k = 0; k < count; ++k) {
        Lss one{random.inBox(0.3), random.inBox(0.3),
                random.chance(0.2) ? 0.0 : random.magnitude(1e-6, 1.0)};
        if (random.chance(0.2)) one.b = one.a;
        if (random.chance(0.1)) one.a = Eigen::Vector3d::Zero();
        lss[j].push_back(one);
      }
    }
    return lss;
  }
};

}  // namespace foretouch::test
