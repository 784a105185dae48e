// tests/bench/surface_test.cpp: the skins of LSS.
#include "bench/surface.h"

#include <array>
#include <map>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/surface/avatar_surface.h"
#include "tests/bench/world.h"

namespace foretouch::tools {
namespace {

double distanceToAxis(const Eigen::Vector3d& p, const Lss& lss) {
  const Eigen::Vector3d axis = lss.b - lss.a;
  const double length2 = axis.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - lss.a).dot(axis) / length2, 0.0, 1.0) : 0.0;
  return (p - lss.a - t * axis).norm();
}

TEST(LssSkins, LieOnTheirLssAndAreAsFineAsAllowed) {
  const Avatar man = parseAvatar(test::kManAvatar, "man.json").value();
  for (const std::size_t count : {100u, 1000u, 20'000u}) {
    const auto skins = lssSkins(man, count);
    ASSERT_EQ(skins.size(), 2u);
    std::size_t all = 0;
    for (LinkId link = 0; link < 2; ++link) {
      const Lss& lss = man.lss(link).front();
      for (const Triangle& t : skins[static_cast<std::size_t>(link)]) {
        ++all;
        for (const Eigen::Vector3d& v : t.vertices) {
          EXPECT_NEAR(distanceToAxis(v, lss), lss.radius, 1e-9);
        }
      }
    }
    EXPECT_LE(all, count);
    EXPECT_GE(all, count / 2);
    EXPECT_TRUE(AvatarSurface::build(man, skins).ok());
  }
}

/// Closed: every edge belongs to two triangles.
TEST(LssSkins, AreClosed) {
  const Avatar man = parseAvatar(test::kManAvatar, "man.json").value();
  for (const auto& skin : lssSkins(man, 500)) {
    std::map<std::array<long, 6>, int> edges;
    const auto grid = [](double x) { return std::lround(1e7 * x); };
    for (const Triangle& t : skin) {
      for (std::size_t c = 0; c < 3; ++c) {
        std::array<long, 3> a, b;
        for (int k = 0; k < 3; ++k) {
          a[static_cast<std::size_t>(k)] = grid(t.vertices[c][k]);
          b[static_cast<std::size_t>(k)] = grid(t.vertices[(c + 1) % 3][k]);
        }
        EXPECT_NE(a, b);
        if (b < a) std::swap(a, b);
        ++edges[{a[0], a[1], a[2], b[0], b[1], b[2]}];
      }
    }
    for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
  }
}

}  // namespace
}  // namespace foretouch::tools
