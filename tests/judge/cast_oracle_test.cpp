// How near what moves along a line comes, by planes and by sections: held against the distance at
// many places of the way, which nothing is left out of.
#include "judge/cast_oracle.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::oracle {
namespace {

using test::Random;

/// Near each other or far, along ways of a millimetre up to a kilometre.
struct Draw {
  CastShape shape;
  OraclePart part;
  Real until = 0;

  explicit Draw(std::uint64_t seed) {
    Random random(seed);
    const Eigen::Vector3d at = random.inBox(1.0);
    shape.a = Vec3d(at);
    shape.b = random.chance(0.3) ? shape.a : Vec3d(Eigen::Vector3d(at + random.inBox(0.5)));
    shape.radius = random.chance(0.3) ? 0.0 : random.magnitude(1e-3, 0.3);
    if (random.chance(0.3)) {
      std::vector<Vec3d> corners;
      for (int i = random.below(6); i >= 0; --i) corners.push_back(Vec3d(random.inBox(0.4)));
      shape.setHull(corners, 1);
    }
    part.count = random.chance(0.5) ? 2 : 3;
    part.radius = part.count == 2 ? random.magnitude(1e-3, 0.3) : 0.0;
    for (Vec3d& corner : part.corners) corner = Vec3d(random.inBox(1.0));
    const Eigen::Vector3d past = random.inBox(0.4);
    shape.direction = part.corners[0] + Vec3d(past) - shape.a;
    until = random.chance(0.2) ? 0 : static_cast<Real>(random.uniform(0.0, 3.0));
    if (random.chance(0.1)) until = static_cast<Real>(random.magnitude(1e-3, 1e3));
  }

  [[nodiscard]] Real leastSeen() const {
    constexpr int kPlaces = 100;
    Real least = gapAfter(shape, 0, part);
    for (int i = 1; i <= kPlaces; ++i) {
      least = std::min(least, gapAfter(shape, until * i / kPlaces, part));
    }
    return least;
  }
};

TEST(CastOracle, LeastGapIsNeverAboveWhatIsSeenOnTheWay) {
  int apart = 0, touching = 0, near = 0;
  for (std::uint64_t seed = 0; seed < 800; ++seed) {
    SCOPED_TRACE(seed);
    const Draw draw(seed);
    const Real seen = draw.leastSeen();
    // Just short of it, at it and beyond, and where nothing is looked for.
    for (const Real beyond : {Real(-1e-11L), Real(0), seen / 2, seen - 1e-7L, seen + 1e-7L}) {
      const Real least = leastGap(draw.shape, draw.until, draw.part, beyond);
      EXPECT_LE(std::min(least, beyond), seen + 1e-13L);
      near += least <= beyond;
    }
    apart += seen > 0;
    touching += seen < 0;
  }
  EXPECT_GT(apart, 150);
  EXPECT_GT(touching, 100);
  EXPECT_GT(near, 500);
}

// What rests needs no sections, and what is not left out is told as it is.
TEST(CastOracle, WhatRestsIsAsFarAsItIs) {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE(seed);
    const Draw draw(seed);
    const Real gap = gapAfter(draw.shape, 0, draw.part);
    EXPECT_EQ(leastGap(draw.shape, 0, draw.part, gap + 1e-7L), gap);
  }
}

}  // namespace
}  // namespace foretouch::oracle
