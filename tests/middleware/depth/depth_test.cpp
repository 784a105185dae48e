// Depths of sets: never a lower bound above what some clear translation needs, never a way out that
// the judge finds blocked.
#include "middleware/depth/depth.h"

#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "tests/middleware/depth/depth_pieces.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::DepthPiece;
using oracle::Real;

/// The hand: a few LSS near each other.
std::vector<Lss> randomHand(test::Random& random, int count) {
  std::vector<Lss> hand;
  Vector3d at = random.inBox(0.05);
  for (int i = 0; i < count; ++i) {
    const Vector3d next = at + 0.08 * random.direction();
    hand.push_back({at, random.chance(0.1) ? at : next, random.uniform(0.005, 0.03)});
    at = next;
  }
  return hand;
}

std::vector<Triangle> randomSoup(test::Random& random, int count, double size) {
  std::vector<Triangle> soup;
  for (int i = 0; i < count; ++i) {
    soup.push_back({test::randomPair(random, size, random.inBox(0.05)).v});
  }
  return soup;
}

Scene sceneOf(const std::vector<Triangle>& triangles) {
  RawScene raw;
  raw.objectNames = {"soup"};
  raw.triangles = triangles;
  raw.objectOf.assign(triangles.size(), 0);
  return Scene::build(std::move(raw)).value();
}

struct Tally {
  int deep = 0, certified = 0, apart = 0, tight = 0;
};

/// The judge looks at the way out, and for shorter ones: at random, and along it.
void check(const Depth& depth, const std::vector<DepthPiece>& moved,
           const std::vector<DepthPiece>& others, test::Random& random, Tally& tally) {
  const Real before = oracle::separationAfter(moved, {}, others);
  ASSERT_LE(depth.lower, depth.upper);
  if (before > 1e-12L) {
    ++tally.apart;
    EXPECT_EQ(depth.lower, 0.0);
    EXPECT_EQ(depth.upper, 0.0);
    return;
  }
  ++tally.deep;
  ASSERT_GT(depth.numPairs, 0);
  // Each pair has to be left, so the deepest one has.
  const auto& deepest = moved[static_cast<std::size_t>(depth.deepestMoved)];
  ASSERT_LE(
      oracle::separationAfter(deepest, {}, others[static_cast<std::size_t>(depth.deepestOther)]),
      1e-12L);
  for (int i = 0; i < 60 && depth.lower > 0.0; ++i) {
    const Vector3d shorter = random.uniform(0.5, 0.999) * depth.lower * random.direction();
    ASSERT_LE(oracle::separationAfter(moved, oracle::Vec3d(shorter), others), 1e-15L)
        << "clear by less than the lower bound";
  }
  if (!depth.isCertified) {
    EXPECT_EQ(depth.wayOut, Vector3d::Zero());
    return;
  }
  ++tally.certified;
  ASSERT_GE(depth.upper, depth.wayOut.norm() * (1.0 - 1e-15));
  ASSERT_GE(oracle::separationAfter(moved, oracle::Vec3d(depth.wayOut), others), -1e-16L)
      << "the way out is blocked";
  const Vector3d least = (1.0 - 1e-3) * depth.wayOut;
  if (oracle::separationAfter(moved, oracle::Vec3d(least), others) <= 0.0L) ++tally.tight;
}

TEST(Depth, OfAHandInASoupIsBoundedOnBothSides) {
  Tally tally;
  Scratch scratch;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const auto hand = randomHand(random, 1 + random.below(4));
    const auto soup = randomSoup(random, 1 + random.below(12), random.magnitude(0.02, 0.5));
    const Scene scene = sceneOf(soup);
    std::vector<DepthPiece> pieces;
    for (TriangleId id = 0; id < static_cast<TriangleId>(soup.size()); ++id) {
      pieces.push_back(test::pieceOf(scene.triangle(id)));
    }
    check(depthIn(hand, scene, scratch), test::piecesOf(hand), pieces, random, tally);
    if (HasFatalFailure()) return;
  }
  std::cout << tally.deep << " deep, " << tally.certified << " certified, " << tally.tight
            << " that cannot be a thousandth shorter, " << tally.apart << " apart\n";
  EXPECT_GT(tally.deep, 150);
  EXPECT_EQ(tally.certified, tally.deep) << "some way out exists, and straight on finds it";
  EXPECT_GT(tally.tight, tally.deep * 4 / 5);
}

TEST(Depth, OfABodyInAnotherIsBoundedOnBothSides) {
  Tally tally;
  Scratch scratch;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const auto one = randomHand(random, 1 + random.below(6));
    const auto other = randomHand(random, 1 + random.below(6));
    check(depthAmong(one, other, scratch), test::piecesOf(one), test::piecesOf(other), random,
          tally);
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(tally.deep, 100);
  EXPECT_EQ(tally.certified, tally.deep);
  EXPECT_GT(tally.tight, tally.deep * 4 / 5);
}

// A ball pressed into a corner of three walls: each pair says 10 cm, the way out is the diagonal.
TEST(Depth, InACornerTheLowerBoundIsAWallAndTheWayTheDiagonal) {
  std::vector<Triangle> walls;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d u = Vector3d::Unit((axis + 1) % 3), v = Vector3d::Unit((axis + 2) % 3);
    walls.push_back({{-10.0 * u - 10.0 * v, 30.0 * u - 10.0 * v, -10.0 * u + 30.0 * v}});
  }
  Scratch scratch;
  const std::vector<Lss> ball{{Vector3d::Constant(0.1), Vector3d::Constant(0.1), 0.2}};
  const Depth depth = depthIn(ball, sceneOf(walls), scratch);
  EXPECT_NEAR(depth.lower, 0.1, 1e-9);
  ASSERT_TRUE(depth.isCertified);
  EXPECT_NEAR(depth.upper, 0.1 * std::sqrt(3.0), 1e-6);
  EXPECT_LT((depth.wayOut - Vector3d::Constant(0.1)).norm(), 1e-6);
  EXPECT_EQ(depth.numPairs, 3);
}

// Between two walls that both press, no small step helps: it leaves along them.
TEST(Depth, BetweenTwoWallsItGoesAround) {
  const double far = 0.3;
  std::vector<Triangle> walls;
  for (const double x : {-0.04, 0.04}) {
    walls.push_back({{Vector3d(x, -1, -1), Vector3d(x, far, -1), Vector3d(x, far, 1)}});
    walls.push_back({{Vector3d(x, -1, -1), Vector3d(x, far, 1), Vector3d(x, -1, 1)}});
  }
  Scratch scratch;
  const std::vector<Lss> ball{{Vector3d::Zero(), Vector3d::Zero(), 0.05}};
  const Scene scene = sceneOf(walls);
  const Depth depth = depthIn(ball, scene, scratch);
  EXPECT_NEAR(depth.lower, 0.01, 1e-9);
  ASSERT_TRUE(depth.isCertified);
  // Out through one of the walls: 9 cm.
  EXPECT_NEAR(depth.upper, 0.09, 1e-6);
  EXPECT_NEAR(std::abs(depth.wayOut.x()), 0.09, 1e-6);
}

TEST(Depth, WhatIsClearNeedsNoWay) {
  Scratch scratch;
  const Depth depth =
      depthAmong({{{0, 0, 0}, {1, 0, 0}, 0.1}}, {{{0, 1, 0}, {1, 1, 0}, 0.1}}, scratch);
  EXPECT_TRUE(depth.isCertified);
  EXPECT_EQ(depth.upper, 0.0);
  EXPECT_EQ(depth.numPairs, 0);
  EXPECT_EQ(depth.deepestMoved, -1);
  EXPECT_TRUE(depthAmong({}, {}, scratch).isCertified);
}

// Where doubles are 1 nm apart, a way is still certified, and the bounds stay sound.
TEST(Depth, FarFromTheOriginAWayIsStillCertified) {
  Scratch scratch;
  Tally tally;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    test::Random random(static_cast<std::uint64_t>(i));
    const Vector3d far = random.inBox(5e6);
    auto hand = randomHand(random, 3), other = randomHand(random, 3);
    for (auto* lss : {&hand, &other}) {
      for (Lss& one : *lss) one.a += far, one.b += far;
    }
    const Depth depth = depthAmong(hand, other, scratch, 1e-8);
    if (depth.numPairs == 0) continue;
    ++tally.deep;
    EXPECT_TRUE(depth.isCertified);
    EXPECT_LE(depth.lower, depth.upper);
    EXPECT_GT(oracle::separationAfter(test::piecesOf(hand), oracle::Vec3d(depth.wayOut),
                                      test::piecesOf(other)),
              0.0L);
  }
  EXPECT_GT(tally.deep, 30);
}

TEST(Depth, TheSameQuestionHasTheSameAnswer) {
  test::Random random(7);
  const auto hand = randomHand(random, 4);
  const Scene scene = sceneOf(randomSoup(random, 20, 0.3));
  Scratch one, other;
  const Depth first = depthIn(hand, scene, one), again = depthIn(hand, scene, one);
  const Depth fresh = depthIn(hand, scene, other);
  EXPECT_EQ(first.wayOut, again.wayOut);
  EXPECT_EQ(first.wayOut, fresh.wayOut);
  EXPECT_EQ(first.lower, fresh.lower);
}

}  // namespace
}  // namespace foretouch
