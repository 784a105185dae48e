// One walk for many boxes, on every width of the lanes, against every triangle's box in double.
#include "middleware/scene/flat_bvh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <thread>
#include <tuple>

#include <gtest/gtest.h>

#include "judge/plain_motion.h"
#include "lss/rounding.h"
#include "lss/simd.h"
#include "middleware/scene/scene_parts.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::BvhLeaf;
using internal::FlatBvh;
using internal::LeafHit;
using oracle::Precise3;
using test::Random;
using Real = oracle::Precise;

/// Boxes of the world, and what the walk takes of them.
struct Boxes {
  std::vector<Aabb> world;
  std::vector<float> lower[3], upper[3];

  void add(const Aabb& box, const Vector3d& origin) {
    world.push_back(box);
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis].push_back(internal::floatBelow(box.min[axis] - origin[axis]));
      upper[axis].push_back(internal::floatAbove(box.max[axis] - origin[axis]));
    }
  }
  [[nodiscard]] internal::BoxLanes lanes() const {
    internal::BoxLanes lanes;
    lanes.count = static_cast<int>(world.size());
    for (int axis = 0; axis < 3; ++axis) {
      lanes.lower[axis] = lower[axis].data();
      lanes.upper[axis] = upper[axis].data();
    }
    return lanes;
  }
};

/// Boxes of every size; three in ten are a point: a vertex of the scene, whose box they touch.
Boxes randomBoxes(Random& random, const Scene& scene, const Vector3d& center, int count) {
  Boxes boxes;
  for (int i = 0; i < count; ++i) {
    Aabb box;
    if (random.chance(0.3)) {
      const auto numTriangles = static_cast<int>(scene.numTriangles());
      const Triangle& triangle = scene.triangle(random.below(numTriangles));
      box.add(triangle.vertices[static_cast<std::size_t>(random.below(3))]);
    } else {
      box.add(center + random.inBox(2.5));
      box.grow(random.magnitude(1e-9, 1.0));
    }
    boxes.add(box, scene.parts().bvh.origin());
  }
  return boxes;
}

struct Walked {
  std::vector<LeafHit> hits;
  std::uint64_t nodes = 0, leaves = 0;
};

bool same(const Walked& x, const Walked& y) {
  const auto alike = [](const LeafHit& a, const LeafHit& b) {
    return std::tie(a.leaf, a.box, a.triangles) == std::tie(b.leaf, b.box, b.triangles);
  };
  return x.nodes == y.nodes && x.leaves == y.leaves &&
         std::equal(x.hits.begin(), x.hits.end(), y.hits.begin(), y.hits.end(), alike);
}

Walked walk(const FlatBvh& bvh, const Boxes& boxes) {
  Walked walked;
  bvh.collectLeaves(boxes.lanes(), walked.hits, walked.nodes, walked.leaves);
  return walked;
}

/// As found on every width, which must agree bit for bit.
Walked walkOnEveryWidth(const FlatBvh& bvh, const Boxes& boxes) {
  const Walked walked = walk(bvh, boxes);
  for (const Simd simd : supportedSimd()) {
    EXPECT_TRUE(useSimd(simd));
    EXPECT_TRUE(same(walk(bvh, boxes), walked)) << toString(simd);
  }
  useSimd(std::nullopt);
  return walked;
}

/// Does the box of a leaf's triangle, of its rounded vertices, meet the box?
bool meets(const BvhLeaf& leaf, int place, const Boxes& boxes, std::size_t box) {
  for (int axis = 0; axis < 3; ++axis) {
    const float a = leaf.vertex[0][axis][place], b = leaf.vertex[1][axis][place],
                c = leaf.vertex[2][axis][place];
    if (std::max({a, b, c}) < boxes.lower[axis][box]) return false;
    if (std::min({a, b, c}) > boxes.upper[axis][box]) return false;
  }
  return true;
}

/// The pairs (box, triangle) of all hits, of triangles whose own boxes meet the box; a failure
/// where one comes twice.
std::set<std::pair<int, TriangleId>> pairsOf(const FlatBvh& bvh, const Boxes& boxes,
                                             const Walked& walked) {
  std::set<std::pair<int, TriangleId>> pairs;
  for (const LeafHit& hit : walked.hits) {
    EXPECT_NE(hit.triangles, 0);
    const BvhLeaf& leaf = bvh.leaf(hit.leaf);
    for (int i = 0; i < internal::kBvhWidth; ++i) {
      if (((hit.triangles >> i) & 1) == 0) continue;
      EXPECT_LT(i, leaf.count()) << "a place without a triangle";
      if (!meets(leaf, i, boxes, hit.box)) continue;
      EXPECT_TRUE(pairs.insert({hit.box, leaf.id[i]}).second) << "a triangle twice";
    }
  }
  return pairs;
}

/// Do the triangle's box and the rounded box meet, when the triangle may be off by the rounding of
/// its vertices? Differences of doubles are good to 2^-63 here, far below that rounding.
bool meetsWithinRounding(const FlatBvh& bvh, const Boxes& boxes, int box,
                         const Triangle& triangle) {
  const Aabb own = internal::boxOf(triangle);
  const auto slack = static_cast<long double>(bvh.vertexRounding()) * (1 + 1e-9L);
  const auto i = static_cast<std::size_t>(box);
  for (int axis = 0; axis < 3; ++axis) {
    const long double origin = bvh.origin()[axis];
    if (own.min[axis] - origin - slack > boxes.upper[axis][i]) return false;
    if (own.max[axis] - origin + slack < boxes.lower[axis][i]) return false;
  }
  return true;
}

Vector3d centerOf(Random& random, int kind) {
  if (kind == 1) return 1e4 * random.direction();
  if (kind == 2) return 1e6 * random.direction();
  return random.inBox(3.0);
}

TEST(CollectLeaves, FindsEveryTriangleWhoseBoxOverlapsAndNoneThatIsApart) {
  const int boxCounts[] = {1, 16, 31, 64, 65, 200};
  const int triangleCounts[] = {1, 2, 9, 300, 2000};
  std::size_t overlapping = 0, found = 0;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = centerOf(random, i % 3);
    const int count = triangleCounts[i % 5];
    const Scene scene = Scene::build(test::clutter(random, count, 3, center)).value();
    const FlatBvh& bvh = scene.parts().bvh;
    const Boxes boxes = randomBoxes(random, scene, center, boxCounts[i % 6]);
    const auto pairs = pairsOf(bvh, boxes, walkOnEveryWidth(bvh, boxes));
    for (int box = 0; box < static_cast<int>(boxes.world.size()); ++box) {
      for (TriangleId id = 0; id < count; ++id) {
        if (!internal::boxOf(scene.triangle(id)).overlaps(boxes.world[std::size_t(box)])) continue;
        ++overlapping;
        ASSERT_EQ(pairs.count({box, id}), 1u) << "box " << box << " triangle " << id;
      }
    }
    for (const auto& [box, id] : pairs) {
      ASSERT_TRUE(meetsWithinRounding(bvh, boxes, box, scene.triangle(id)));
    }
    found += pairs.size();
  }
  EXPECT_GT(overlapping, 5000u);
  EXPECT_LT(found, overlapping + overlapping / 10)
      << "a walk that returns everything culls nothing";
}

TEST(CollectLeaves, FindsWhatOneBoxAtATimeFinds) {
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = centerOf(random, i % 3);
    const Scene scene = Scene::build(test::clutter(random, 1000, 1, center)).value();
    const FlatBvh& bvh = scene.parts().bvh;
    const Boxes boxes = randomBoxes(random, scene, center, 80);
    std::set<std::pair<int, TriangleId>> oneByOne;
    for (std::size_t box = 0; box < boxes.world.size(); ++box) {
      std::vector<TriangleId> ids;
      std::uint64_t visited = 0;
      bvh.collect(boxes.world[box], ids, visited);
      for (const TriangleId id : ids) oneByOne.insert({static_cast<int>(box), id});
    }
    EXPECT_EQ(pairsOf(bvh, boxes, walk(bvh, boxes)), oneByOne);
  }
}

// A hit has all triangles of its leaf, comes once a box, and a box's hits ascend.
TEST(CollectLeaves, TakesThemWholeAndInOrder) {
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(40 + i));
    const Vector3d center = centerOf(random, i % 3);
    const Scene scene = Scene::build(test::clutter(random, 3000, 1, center)).value();
    const FlatBvh& bvh = scene.parts().bvh;
    const Boxes boxes = randomBoxes(random, scene, center, 80);
    const std::vector<LeafHit> whole = walk(bvh, boxes).hits;
    std::set<std::pair<std::uint32_t, int>> leavesOfBoxes;
    std::map<int, std::uint32_t> last;
    for (const LeafHit& hit : whole) {
      EXPECT_EQ(hit.triangles, (1u << bvh.leaf(hit.leaf).count()) - 1u);
      EXPECT_TRUE(leavesOfBoxes.insert({hit.leaf, hit.box}).second);
      const auto before = last.find(hit.box);
      EXPECT_TRUE(before == last.end() || before->second < hit.leaf);
      last[hit.box] = hit.leaf;
    }
    EXPECT_LT(whole.size(), 80u * bvh.numLeaves() / 2);
  }
}

// Vectors that the last boxes fill, share with boxes before them, or do not fill.
TEST(CollectLeaves, TakesAnyNumberOfBoxes) {
  Random random(1);
  const Vector3d center = Vector3d::Zero();
  const Scene scene = Scene::build(test::clutter(random, 200, 1, center)).value();
  const FlatBvh& bvh = scene.parts().bvh;
  for (int count = 1; count <= 66; ++count) {
    SCOPED_TRACE(count);
    const Boxes boxes = randomBoxes(random, scene, center, count);
    std::set<std::pair<int, TriangleId>> oneByOne;
    for (std::size_t box = 0; box < boxes.world.size(); ++box) {
      std::vector<TriangleId> ids;
      std::uint64_t visited = 0;
      bvh.collect(boxes.world[box], ids, visited);
      for (const TriangleId id : ids) oneByOne.insert({static_cast<int>(box), id});
    }
    EXPECT_EQ(pairsOf(bvh, boxes, walkOnEveryWidth(bvh, boxes)), oneByOne);
  }
}

TEST(CollectLeaves, AppendsAndCounts) {
  Random random(1);
  const Scene scene = Scene::build(test::clutter(random, 500, 1, Vector3d::Zero())).value();
  const FlatBvh& bvh = scene.parts().bvh;
  const Boxes boxes = randomBoxes(random, scene, Vector3d::Zero(), 70);
  const Walked once = walk(bvh, boxes);
  Walked twice = once;
  bvh.collectLeaves(boxes.lanes(), twice.hits, twice.nodes, twice.leaves);
  EXPECT_GT(once.hits.size(), 0u);
  EXPECT_GE(once.leaves, 1u);
  EXPECT_LE(once.leaves, 2 * bvh.numLeaves()) << "once for every 64 boxes";
  EXPECT_EQ(twice.hits.size(), 2 * once.hits.size());
  EXPECT_EQ(twice.nodes, 2 * once.nodes);
  EXPECT_EQ(twice.leaves, 2 * once.leaves);
}

TEST(CollectLeaves, IsNotMisledByEmptyBoxes) {
  Random random(2);
  const Scene scene = Scene::build(test::clutter(random, 500, 1, Vector3d::Zero())).value();
  const FlatBvh& bvh = scene.parts().bvh;
  EXPECT_TRUE(same(walkOnEveryWidth(bvh, Boxes{}), Walked{})) << "no box";

  Boxes empty;
  for (int i = 0; i < 70; ++i) empty.add(Aabb{}, bvh.origin());
  Aabb inverted;  // within every large triangle's box on x, and yet empty
  inverted.min = Vector3d(1e-3, -5, -5);
  inverted.max = Vector3d(-1e-3, 5, 5);
  empty.add(inverted, bvh.origin());
  EXPECT_TRUE(same(walkOnEveryWidth(bvh, empty), Walked{})) << "nothing but empty boxes";

  Boxes mixed = empty;
  Aabb everything;
  everything.add(Vector3d::Constant(-10));
  everything.add(Vector3d::Constant(10));
  mixed.add(everything, bvh.origin());
  const auto pairs = pairsOf(bvh, mixed, walkOnEveryWidth(bvh, mixed));
  EXPECT_EQ(pairs.size(), 500u);
  for (const auto& pair : pairs) EXPECT_EQ(pair.first, 71);
}

TEST(CollectLeaves, TakesNotANumberForNoBound) {
  Random random(3);
  const Scene scene = Scene::build(test::clutter(random, 300, 1, Vector3d::Zero())).value();
  const FlatBvh& bvh = scene.parts().bvh;
  Boxes boxes = randomBoxes(random, scene, Vector3d::Zero(), 20);
  Boxes endless = boxes;
  for (std::size_t i = 0; i < 20; ++i) {
    const int axis = static_cast<int>(i % 3);
    (i % 2 == 0 ? boxes.lower : boxes.upper)[axis][i] = std::numeric_limits<float>::quiet_NaN();
    (i % 2 == 0 ? endless.lower : endless.upper)[axis][i] =
        (i % 2 == 0 ? -1.0f : 1.0f) * std::numeric_limits<float>::infinity();
  }
  EXPECT_TRUE(same(walkOnEveryWidth(bvh, boxes), walkOnEveryWidth(bvh, endless)));
}

TEST(CollectLeaves, GoesOnWhenItsRoomIsFull) {
  RawScene raw;
  raw.objectNames = {"heap"};
  for (int i = 0; i < 20000; ++i) {
    raw.triangles.push_back({{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}});
    raw.objectOf.push_back(0);
  }
  const Scene scene = Scene::build(raw).value();
  const FlatBvh& bvh = scene.parts().bvh;
  Aabb touching;
  touching.add(Vector3d(0.2, 0.2, 0.0));
  Boxes boxes;
  for (int i = 0; i < 100; ++i) boxes.add(touching, bvh.origin());
  const Walked walked = walkOnEveryWidth(bvh, boxes);
  EXPECT_GT(bvh.numLeaves(), static_cast<std::uint32_t>(internal::BvhWalk::kLeafRoom));
  EXPECT_EQ(walked.leaves, 2u * bvh.numLeaves());
  EXPECT_EQ(pairsOf(bvh, boxes, walked).size(), 20000u * 100u);
}

TEST(FlatBvhLeaves, HoldVerticesWithinTheirRounding) {
  Real worst = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = centerOf(random, i % 3);
    const Scene scene = Scene::build(test::clutter(random, 200, 1, center)).value();
    const FlatBvh& bvh = scene.parts().bvh;
    for (std::uint32_t index = 0; index < bvh.numLeaves(); ++index) {
      const BvhLeaf& leaf = bvh.leaf(index);
      for (int place = 0; place < leaf.count(); ++place) {
        const Triangle& triangle = scene.triangle(leaf.id[place]);
        for (std::size_t corner = 0; corner < 3; ++corner) {
          const Vector3d local(leaf.vertex[corner][0][place], leaf.vertex[corner][1][place],
                               leaf.vertex[corner][2][place]);
          const Real off =
              norm(Precise3(bvh.origin()) + Precise3(local) - Precise3(triangle.vertices[corner]));
          ASSERT_LE(off, Real(bvh.vertexRounding()));
          worst = std::max<Real>(worst, off / Real(bvh.vertexRounding()));
        }
      }
    }
  }
  EXPECT_GT(worst, 0.3) << "the bound is far too large";
}

TEST(FlatBvhLeaves, RoundAlikeInAnyOrderOfTriangles) {
  Random random(5);
  RawScene raw = test::clutter(random, 300, 1, Vector3d(1e3, 0, 0));
  const Scene scene = Scene::build(raw).value();
  std::shuffle(raw.triangles.begin(), raw.triangles.end(), std::mt19937(1));
  const Scene shuffled = Scene::build(raw).value();
  EXPECT_EQ(scene.parts().bvh.vertexRounding(), shuffled.parts().bvh.vertexRounding());
}

TEST(FlatBvhLeaves, AreTheSameInEveryBuildAndWellFilled) {
  Random random(6);
  const RawScene raw = test::clutter(random, 5000, 1, Vector3d::Zero());
  const Scene scene = Scene::build(raw).value();
  const Scene again = Scene::build(raw).value();
  const FlatBvh& x = scene.parts().bvh;
  const FlatBvh& y = again.parts().bvh;
  ASSERT_EQ(x.numLeaves(), y.numLeaves());
  ASSERT_EQ(x.numNodes(), y.numNodes());
  for (std::uint32_t i = 0; i < x.numLeaves(); ++i) {
    ASSERT_EQ(std::memcmp(&x.leaf(i), &y.leaf(i), sizeof(BvhLeaf)), 0);
    ASSERT_EQ(std::memcmp(&x.cluster(i), &y.cluster(i), sizeof(internal::Cluster)), 0);
  }
  EXPECT_LT(x.numLeaves(), 5000u / 5) << "the tree is larger than it need be";
}

TEST(FlatBvhLeaves, RepeatTheLastTriangleInUnusedPlaces) {
  Random random(7);
  const Scene scene = Scene::build(test::clutter(random, 100, 1, Vector3d::Zero())).value();
  const FlatBvh& bvh = scene.parts().bvh;
  int unused = 0;
  for (std::uint32_t index = 0; index < bvh.numLeaves(); ++index) {
    const BvhLeaf& leaf = bvh.leaf(index);
    const int last = leaf.count() - 1;
    ASSERT_GE(last, 0);
    for (int place = last + 1; place < internal::kBvhWidth; ++place) {
      ++unused;
      EXPECT_EQ(leaf.id[place], -1);
      for (const auto& corner : leaf.vertex) {
        for (const auto& axis : corner) EXPECT_EQ(axis[place], axis[last]);
      }
    }
  }
  EXPECT_GT(unused, 0);
}

TEST(FlatBvhClusters, ContainTheTrueTriangles) {
  double tightness = 0.0;
  int clusters = 0;
  for (int i = 0; i < 30; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = centerOf(random, i % 3);
    const Scene scene = Scene::build(test::clutter(random, 200, 1, center)).value();
    const FlatBvh& bvh = scene.parts().bvh;
    for (std::uint32_t index = 0; index < bvh.numLeaves(); ++index) {
      const BvhLeaf& leaf = bvh.leaf(index);
      const internal::Cluster& cluster = bvh.cluster(index);
      const Precise3 middle =
          Precise3(bvh.origin()) +
          Precise3(Vector3d(cluster.centre[0], cluster.centre[1], cluster.centre[2]));
      Aabb box;
      for (int place = 0; place < leaf.count(); ++place) {
        for (const Vector3d& vertex : scene.triangle(leaf.id[place]).vertices) {
          ASSERT_LE(norm(Precise3(vertex) - middle), Real(cluster.radius));
          box.add(vertex);
        }
      }
      const double halfDiagonal = 0.5 * (box.max - box.min).norm();
      EXPECT_LE(cluster.radius, 1.01 * (halfDiagonal + 2 * bvh.vertexRounding()));
      tightness += cluster.radius / (halfDiagonal + 2 * bvh.vertexRounding());
      ++clusters;
    }
  }
  EXPECT_LT(tightness / clusters, 0.95) << "no better than the ball around the box";
}

}  // namespace
}  // namespace foretouch
