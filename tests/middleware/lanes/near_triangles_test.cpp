// What lanes say is near an LSS that stands still, against the oracle's distance, at every width.
#include "middleware/lanes/near_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "judge/distance.h"
#include "lss/simd.h"
#include "tests/support/random_geometry.h"

namespace foretouch::internal {
namespace {

using Eigen::Vector3d;
using test::Random;

class NearTriangles : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

using Corners = std::array<Vector3d, 3>;

/// Leaves of triangles that lie together, as in a tree; some have unused places.
struct Leaves {
  explicit Leaves(Random& random) {
    const auto count = static_cast<std::size_t>(1 + random.below(60));
    for (std::size_t i = 0; i < count; ++i) add(random);
    leaf.resize(count + kMaxLanes, -1);  // nothing may follow what is beyond the count
  }

  void add(Random& random) {
    const Vector3d centre = random.inBox(0.4);
    const double size = random.magnitude(0.003, 2.0);
    BvhLeaf added{};
    const int used = 1 + random.below(kBvhWidth);
    double reached = 0.0;
    for (int place = 0; place < kBvhWidth; ++place) {
      if (place < used) triangles.push_back(rounded(test::randomPair(random, size, centre).v));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        for (int axis = 0; axis < 3; ++axis) {
          added.vertex[corner][axis][place] = static_cast<float>(triangles.back()[corner][axis]);
        }
        reached = std::max(reached, (triangles.back()[corner] - rounded(centre)).norm());
      }
      added.id[place] = place < used ? static_cast<TriangleId>(triangles.size()) - 1 : -1;
    }
    const Vector3d at = rounded(centre);
    clusters.push_back(
        {{static_cast<float>(at.x()), static_cast<float>(at.y()), static_cast<float>(at.z())},
         static_cast<float>(1.000001 * reached)});
    // Which of them the walk found.
    asked.push_back(static_cast<std::uint8_t>(random.chance(0.7) ? (1U << used) - 1U
                                                                 : 1U << random.below(used)));
    leaf.push_back(static_cast<std::int32_t>(leaves.size()));
    leaves.push_back(added);
  }

  static Vector3d rounded(const Vector3d& p) { return p.cast<float>().cast<double>(); }
  static Corners rounded(const Corners& v) { return {rounded(v[0]), rounded(v[1]), rounded(v[2])}; }
  [[nodiscard]] bool isAsked(std::size_t leafIndex, int place) const {
    return (asked[leafIndex] >> place & 1U) != 0 && leaves[leafIndex].id[place] >= 0;
  }

  std::vector<Corners> triangles;
  std::vector<BvhLeaf> leaves;
  std::vector<Cluster> clusters;
  std::vector<std::int32_t> leaf;
  std::vector<std::uint8_t> asked;
};

oracle::Vec3<double> plain(const Vector3d& p) {
  return {p.x(), p.y(), p.z()};
}

TEST_P(NearTriangles, AreAllThatAreNearAndHardlyOthers) {
  constexpr double kLoose = 1e-4;  // m, beyond which nothing should be called near
  std::size_t near = 0, far = 0;
  foretouch::internal::NearTriangles found;
  for (std::uint64_t draw = 0; draw < 3000; ++draw) {
    Random random(7000 + draw);
    const Leaves leaves(random);
    const Vector3d a = random.inBox(0.8);
    const Vector3d b = random.chance(0.1) ? a : Vector3d(a + random.inBox(0.4));
    const double radius = random.chance(0.1) ? 0.0 : random.magnitude(1e-3, 0.2);
    const double within = random.magnitude(1e-5, 0.05);
    const Vector3d origin = Leaves::rounded(0.5 * (a + b));
    const float floats[3] = {static_cast<float>(origin.x()), static_cast<float>(origin.y()),
                             static_cast<float>(origin.z())};
    const Vector3d fromA = a - origin, fromB = b - origin;
    const StillLss lss = stillLss(fromA.data(), fromB.data(), radius, 0.0);
    findNearTriangles(lss, static_cast<float>(within),
                      {leaves.leaves.data(), leaves.clusters.data(), leaves.leaf.data(),
                       leaves.asked.data(), leaves.asked.size()},
                      floats, found);
    std::vector<std::optional<float>> gaps(leaves.triangles.size());
    for (std::size_t i = 0; i < found.count; ++i) {
      auto& gap = gaps.at(static_cast<std::size_t>(found.id[i]));
      ASSERT_FALSE(gap.has_value()) << draw << ": twice";
      gap = found.gap[i];
    }
    for (std::size_t i = 0; i < leaves.asked.size(); ++i) {
      for (int place = 0; place < leaves.leaves[i].count(); ++place) {
        const auto id = static_cast<std::size_t>(leaves.leaves[i].id[place]);
        const Corners& v = leaves.triangles[id];
        const double separation =
            oracle::closestPoints(plain(a), plain(b), {plain(v[0]), plain(v[1]), plain(v[2])})
                .distance -
            radius;
        if (!leaves.isAsked(i, place)) {
          ASSERT_FALSE(gaps[id].has_value()) << draw << ' ' << id << ": nobody asked";
          continue;
        }
        if (!gaps[id].has_value()) {
          ++far;
          ASSERT_GT(separation, static_cast<double>(static_cast<float>(within)))
              << draw << ' ' << id;
          continue;
        }
        ++near;
        ASSERT_GE(separation, static_cast<double>(*gaps[id])) << draw << ' ' << id;
        ASSERT_LT(separation, within + kLoose) << draw << ' ' << id;
      }
    }
  }
  EXPECT_GT(near, 2000U);
  EXPECT_GT(far, 30000U);
}

TEST_P(NearTriangles, AreNoneWithoutLeaves) {
  foretouch::internal::NearTriangles found;
  found.count = 3;
  const double ends[3] = {0.0, 0.0, 0.0};
  const float origin[3] = {0.0F, 0.0F, 0.0F};
  findNearTriangles(stillLss(ends, ends, 1.0, 0.0), 1.0F, {nullptr, nullptr, nullptr, nullptr, 0},
                    origin, found);
  EXPECT_EQ(found.count, 0U);
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, NearTriangles, testing::ValuesIn(supportedSimd()),
                         [](const auto& width) { return toString(width.param); });

}  // namespace
}  // namespace foretouch::internal
