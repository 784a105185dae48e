// Our own builder of trees: what it owes to the walk, the same tree everywhere, the same answers.
#include <algorithm>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "middleware/query/query.h"
#include "middleware/scene/bvh_tree.h"
#include "middleware/scene/scene_parts.h"
#include "tests/middleware/random_scene.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using internal::buildBinnedTree;
using internal::BvhTree;
using internal::FlatBvh;
using internal::TreeBox;
using internal::TreeBuilder;
using internal::TreeInner;
using internal::TreeLeaf;
using internal::TreeNode;
using test::Random;

/// Back to the library's own builder at the end of a test.
struct BuilderGuard {
  ~BuilderGuard() { internal::useTreeBuilder(std::nullopt); }
};

std::vector<TriangleId> idsOf(const std::vector<Triangle>& triangles) {
  std::vector<TriangleId> ids(triangles.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<TriangleId>(i);
  return ids;
}

bool contains(const TreeBox& outer, const TreeBox& inner) {
  for (int axis = 0; axis < 3; ++axis) {
    if (inner.lower[axis] < outer.lower[axis] || inner.upper[axis] > outer.upper[axis]) {
      return false;
    }
  }
  return true;
}

TreeBox boxOf(const Triangle& triangle, const Vector3d& origin) {
  const Aabb box = internal::boxOf(triangle);
  TreeBox rounded;
  for (int axis = 0; axis < 3; ++axis) {
    rounded.lower[axis] = internal::floatBelow(box.min[axis] - origin[axis]);
    rounded.upper[axis] = internal::floatAbove(box.max[axis] - origin[axis]);
  }
  return rounded;
}

/// What a tree is made of, its laws checked on the way.
struct TreeFacts {
  std::multiset<unsigned> places;
  int leaves = 0, deepestInner = -1;

  void read(const std::vector<Triangle>& triangles, const Vector3d& origin, const TreeNode& node,
            const TreeBox& box, int depth) {
    if (node.numChildren == 0) {
      const auto& leaf = static_cast<const TreeLeaf&>(node);
      ++leaves;
      ASSERT_GE(leaf.size, 1u);
      ASSERT_LE(leaf.size, static_cast<unsigned>(internal::kBvhWidth));
      for (unsigned i = 0; i < leaf.size; ++i) {
        places.insert(leaf.primitives[i]);
        ASSERT_TRUE(contains(box, boxOf(triangles[leaf.primitives[i]], origin)));
      }
      return;
    }
    const auto& inner = static_cast<const TreeInner&>(node);
    deepestInner = std::max(deepestInner, depth);
    ASSERT_GE(inner.numChildren, 2u);
    ASSERT_LE(inner.numChildren, static_cast<unsigned>(internal::kBvhWidth));
    for (unsigned i = 0; i < inner.numChildren; ++i) {
      ASSERT_TRUE(contains(box, inner.boxes[i]));
      ASSERT_NO_FATAL_FAILURE(
          read(triangles, origin, *inner.children[i], inner.boxes[i], depth + 1));
    }
  }
};

TreeFacts factsOf(const BvhTree& tree, const std::vector<Triangle>& triangles,
                  const Vector3d& origin) {
  TreeFacts facts;
  facts.read(triangles, origin, *tree.root, tree.box, 0);
  EXPECT_EQ(facts.places.size(), triangles.size());
  for (unsigned place = 0; place < triangles.size(); ++place) {
    EXPECT_EQ(facts.places.count(place), 1u) << place;
  }
  return facts;
}

/// Triangles whose sizes and distances from the origin fall from 1e6 m to 1e-30 m: the most
/// lopsided that floats allow, and some that have no size.
std::vector<Triangle> shrinking(int count) {
  std::vector<Triangle> triangles;
  double size = 1e6;
  for (int i = 0; i < count; ++i, size *= 0.9) {
    const Vector3d corner(size, i % 2 == 0 ? 0.0 : size, 0.0);
    triangles.push_back({{corner, corner, i % 5 == 0 ? corner : Vector3d(1.1 * corner)}});
  }
  return triangles;
}

TEST(BinnedTree, HoldsEveryTriangleOnceInsideTheBoxesAboveIt) {
  const int counts[] = {1, 2, 8, 9, 17, 300, 5000};
  for (int i = 0; i < 42; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = i % 3 == 0 ? Vector3d(1e6 * random.direction()) : random.inBox(3.0);
    const auto triangles = test::clutter(random, counts[i % 7], 1, center).triangles;
    const auto tree = buildBinnedTree(triangles, idsOf(triangles), center);
    const TreeFacts facts = factsOf(*tree, triangles, center);
    EXPECT_LE(facts.leaves, std::max(1, counts[i % 7] / 4)) << "leaves that are hardly filled";
  }
}

TEST(BinnedTree, TakesHeapsLinesAndSizesOfEveryMagnitude) {
  const Triangle one{{Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)}};
  const std::vector<Triangle> heap(20000, one);
  EXPECT_LE(factsOf(*buildBinnedTree(heap, idsOf(heap), Vector3d::Zero()), heap, Vector3d::Zero())
                .deepestInner,
            8);
  const std::vector<Triangle> lopsided = shrinking(800);
  factsOf(*buildBinnedTree(lopsided, idsOf(lopsided), Vector3d::Zero()), lopsided,
          Vector3d::Zero());
  std::vector<Triangle> line = heap;
  for (std::size_t i = 0; i < line.size(); ++i) {
    for (Vector3d& vertex : line[i].vertices) vertex.x() += 1e-3 * static_cast<double>(i);
  }
  factsOf(*buildBinnedTree(line, idsOf(line), Vector3d::Zero()), line, Vector3d::Zero());
}

// Lopsided triangles need 5 levels where there is room; 512 have just room in two levels of inner
// nodes, and one more in none.
TEST(BinnedTree, GoesNoDeeperThanItMay) {
  const auto deepest = [](int count, int limit) {
    const std::vector<Triangle> triangles = shrinking(count);
    const auto tree = buildBinnedTree(triangles, idsOf(triangles), Vector3d::Zero(), limit);
    return factsOf(*tree, triangles, Vector3d::Zero()).deepestInner;
  };
  EXPECT_GT(deepest(512, internal::kMaxBvhDepth), 2) << "the limit would force nothing";
  EXPECT_EQ(deepest(512, 1), 1);
  EXPECT_EQ(deepest(512, 2), 2);
  EXPECT_EQ(deepest(64, 0), 0);
  for (int count = 1; count < 64; ++count) EXPECT_LE(deepest(count, 0), 0);
}

/// FNV-1a.
struct Digest {
  std::uint64_t value = 0xcbf29ce484222325u;

  template <typename Value>
  void add(const Value& added) {
    unsigned char bytes[sizeof(Value)];
    std::memcpy(bytes, &added, sizeof added);
    for (const unsigned char byte : bytes) value = (value ^ byte) * 0x100000001b3u;
  }
  void add(const TreeNode& node) {
    add(node.numChildren);
    if (node.numChildren == 0) {
      const auto& leaf = static_cast<const TreeLeaf&>(node);
      for (unsigned i = 0; i < leaf.size; ++i) add(leaf.primitives[i]);
      return;
    }
    const auto& inner = static_cast<const TreeInner&>(node);
    for (unsigned i = 0; i < inner.numChildren; ++i) {
      add(inner.boxes[i]);
      add(*inner.children[i]);
    }
  }
};

// Of numbers that every machine makes alike: no function but the four operations. The digests are
// those of x86-64; whoever changes the builder records them anew.
TEST(BinnedTree, IsTheSameOnEveryMachine) {
  Random random(7);
  RawScene raw;
  raw.objectNames = {"chips"};
  for (int i = 0; i < 30000; ++i) {
    const double z = random.uniform(-2, 2), y = random.uniform(0, 3), x = random.uniform(-4, 4);
    const Vector3d corner(x, y, z);
    Triangle triangle;
    for (Vector3d& vertex : triangle.vertices) {
      vertex = corner;
      for (int axis = 0; axis < 3; ++axis) vertex[axis] += random.uniform(0, 0.2);
    }
    raw.triangles.push_back(triangle);
    raw.objectOf.push_back(0);
  }
  Digest tree;
  tree.add(*buildBinnedTree(raw.triangles, idsOf(raw.triangles), Vector3d(0.1, 0.2, 0.3))->root);
  EXPECT_EQ(tree.value, 1922845678746743660u);

  const BuilderGuard guard;
  ASSERT_TRUE(internal::useTreeBuilder(TreeBuilder::Binned));
  const Scene scene = Scene::build(raw).value();
  const FlatBvh& bvh = scene.parts().bvh;
  Digest flat;
  for (std::uint32_t i = 0; i < bvh.numLeaves(); ++i) {
    flat.add(bvh.leaf(i));
    flat.add(bvh.cluster(i));
  }
  EXPECT_EQ(flat.value, 4980851654307507212u);
}

TEST(BinnedTree, DoesNotDependOnTheOrderOfTriangles) {
  const BuilderGuard guard;
  ASSERT_TRUE(internal::useTreeBuilder(TreeBuilder::Binned));
  Random random(3);
  RawScene raw = test::clutter(random, 3000, 1, Vector3d::Zero());
  const Scene scene = Scene::build(raw).value();
  std::reverse(raw.triangles.begin(), raw.triangles.end());
  const Scene reversed = Scene::build(raw).value();
  const FlatBvh &x = scene.parts().bvh, &y = reversed.parts().bvh;
  ASSERT_EQ(x.numLeaves(), y.numLeaves());
  for (std::uint32_t i = 0; i < x.numLeaves(); ++i) {
    ASSERT_EQ(std::memcmp(x.leaf(i).vertex, y.leaf(i).vertex, sizeof x.leaf(i).vertex), 0);
  }
}

// The trees differ, and so may instants within the tolerance; who meets something does not, except
// on a graze.
TEST(TreeBuilders, GiveTheSameAnswers) {
  const BuilderGuard guard;
  int contacts = 0, clear = 0, grazes = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center = random.inBox(2.0);
    const RawScene raw = test::clutter(random, 400, 1, center);
    const test::RandomBody body = test::bodyInClutter(random, 6, center);
    std::vector<StepContacts> answers;
    for (const TreeBuilder builder : internal::treeBuilders()) {
      ASSERT_TRUE(internal::useTreeBuilder(builder));
      const Scene scene = Scene::build(raw).value();
      answers.push_back(firstContacts(body.avatar, body.motion(), scene).value());
    }
    for (std::size_t link = 0; link < answers[0].links.size(); ++link) {
      const LinkContact &x = answers.front().links[link], &y = answers.back().links[link];
      (x.verdict == Verdict::Clear ? clear : contacts) += 1;
      if (x.verdict == y.verdict && std::abs(x.toi - y.toi) < 1e-2) continue;
      ++grazes;
      for (const LinkContact& answer : {x, y}) {
        EXPECT_TRUE(answer.verdict == Verdict::Clear ||
                    answer.separation <= QueryOptions{}.tolerance);
      }
    }
  }
  EXPECT_GT(contacts, 100);
  EXPECT_GT(clear, 100);
  EXPECT_LT(grazes, contacts / 50);
}

TEST(TreeBuilders, AreChosenAmongThoseThatThereAre) {
  const BuilderGuard guard;
  for (const TreeBuilder builder : internal::treeBuilders()) {
    EXPECT_TRUE(internal::useTreeBuilder(builder));
    EXPECT_EQ(internal::activeTreeBuilder(), builder);
  }
  EXPECT_EQ(internal::treeBuilders().back(), TreeBuilder::Binned);
  EXPECT_TRUE(internal::useTreeBuilder(std::nullopt));
  EXPECT_EQ(internal::activeTreeBuilder(), internal::treeBuilders().front());
  if (internal::treeBuilders().size() == 1) {
    EXPECT_FALSE(internal::useTreeBuilder(TreeBuilder::Embree));
    EXPECT_EQ(internal::activeTreeBuilder(), TreeBuilder::Binned);
  }
}

}  // namespace
}  // namespace foretouch
