// Holds the chain in a link's frame against world frames in fifty digits.
#include "articulated/relative_motion.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "articulated/chain_nodes.h"
#include "articulated/motion.h"
#include "tests/support/random_motion.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise;
using oracle::Precise3;
using oracle::PreciseFrame;
using test::asDouble;
using test::Random;
using test::RandomMotion;

/// Several random trees side by side, all around one place.
RandomMotion forest(Random& random, int trees, const Vector3d& place) {
  RandomMotion all;
  RawSkeleton raw;
  for (int tree = 0; tree < trees; ++tree) {
    const RandomMotion one = test::randomMotion(random, 1 + random.below(8));
    const JointId first = static_cast<JointId>(raw.joints.size());
    for (JointId j = 0; j < one.skeleton.numJoints(); ++j) {
      const JointId parent = one.skeleton.parent(j);
      raw.joints.push_back({"joint" + std::to_string(first + j),
                            parent == kNoParent ? kNoParent : first + parent,
                            one.skeleton.restOffset(j), one.skeleton.restRotation(j)});
      const bool isRoot = parent == kNoParent;
      const Vector3d drift = one.to.translations[slotOf(j)] - one.from.translations[slotOf(j)];
      const Vector3d start = isRoot ? place + random.inBox(1.0) : one.from.translations[slotOf(j)];
      all.from.rotations.push_back(one.from.rotations[slotOf(j)]);
      all.to.rotations.push_back(one.to.rotations[slotOf(j)]);
      all.from.translations.push_back(start);
      all.to.translations.push_back(isRoot ? Vector3d(start + drift)
                                           : one.to.translations[slotOf(j)]);
    }
  }
  all.skeleton = Skeleton::build(raw).value();
  all.precise = test::plainJoints(all.skeleton, all.from, all.to);
  return all;
}

struct InFrame {
  RelativeChain chain;
  Pose from, to;
  ChainMotion motion;

  InFrame(const RandomMotion& m, JointId frame)
      : chain(RelativeChain::build(m.skeleton, frame).value()) {
    chain.pose(m.from, from);
    chain.pose(m.to, to);
    motion.assign(chain.skeleton(), from, to);
  }
};

/// A point of a link as the frame sees it.
Precise3 seenFrom(const PreciseFrame& frame, const Precise3& p_W) {
  const oracle::PreciseQuaternion back{frame.rotation.w, -frame.rotation.x, -frame.rotation.y,
                                       -frame.rotation.z};
  return rotate(back, p_W - frame.origin);
}

struct Worst {
  double metres = 0.0, share = 0.0;
};

/// All links at one instant, a point of each a body's size away from its origin.
void compare(const RandomMotion& m, const InFrame& in, JointId frame, double t, Random& random,
             Worst& worst) {
  const auto truth = oracle::preciseFrames(m.precise, Precise(t));
  for (LinkId link = 0; link < m.skeleton.numJoints(); ++link) {
    const Vector3d p_L = random.inBox(0.5);
    const Vector3d got = in.motion.stateAt(in.chain.linkOf(link), t).pointAt(p_L);
    const Precise3 expected = seenFrom(truth[slotOf(frame)], truth[slotOf(link)].at(p_L));
    const double off = asDouble(norm(Precise3(got) - expected));
    const double allowed =
        in.motion.bounds(in.chain.linkOf(link)).positionRoundingAt(p_L.norm() * (1.0 + 1e-15));
    ASSERT_LE(off, allowed) << "link " << link << " in the frame of " << frame << " at " << t;
    worst.metres = std::max(worst.metres, off);
    if (off > 0.0) worst.share = std::max(worst.share, off / allowed);
  }
}

TEST(RelativeChain, HasTheWorldsFramesWithinItsBounds) {
  Worst near, far;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const bool isFar = random.chance(0.5);
    const RandomMotion m = forest(random, 1 + random.below(3),
                                  isFar ? Vector3d(1e4 * random.direction()) : Vector3d::Zero());
    const JointId frame = random.below(m.skeleton.numJoints());
    const InFrame in(m, frame);
    for (const double t : {0.0, random.uniform(0.0, 1.0), 1.0}) {
      compare(m, in, frame, t, random, isFar ? far : near);
      if (HasFatalFailure()) return;
    }
  }
  // Bodies of a few metres; the place in the world does not matter.
  EXPECT_LT(near.metres, 1e-14);
  EXPECT_LT(far.metres, 1e-14);
  EXPECT_GT(near.share, 1e-3);  // the bounds are not empty words
}

TEST(RelativeChain, LeavesTheFrameWhereItIs) {
  for (int i = 0; i < 50; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = forest(random, 2, Vector3d::Zero());
    const JointId frame = random.below(m.skeleton.numJoints());
    const InFrame in(m, frame);
    const LinkId own = in.chain.linkOf(frame);
    EXPECT_LT(in.motion.bounds(own).speedAt(1.0), 1e-13);
    EXPECT_TRUE(in.motion.stateAt(own, 0.5).R_WL.isIdentity(0.0));
    EXPECT_EQ(in.motion.stateAt(own, 0.5).p_WL, Vector3d::Zero());
  }
}

// Who rides on the frame's parent sees only what moves below it.
TEST(RelativeChain, CancelsWhatIsAboveBoth) {
  RawSkeleton raw;
  const Quaternion rest = Quaternion::Identity();
  raw.joints = {{"lift", kNoParent, Vector3d::Zero(), rest},
                {"door", 0, Vector3d(1, 0, 0), rest},
                {"man", 0, Vector3d(0, 0, 1), rest}};
  RandomMotion m;
  m.skeleton = Skeleton::build(raw).value();
  m.from = m.to = restPose(m.skeleton);
  Random random(1);
  m.to.rotations[0] = random.turn(2.0);
  m.to.translations[0] = Vector3d(0, 30, 0);
  const InFrame in(m, 1);
  const MotionBounds man = in.motion.bounds(in.chain.linkOf(2));
  EXPECT_LT(man.speedAt(1.0), 1e-12);
  EXPECT_LT((in.motion.stateAt(in.chain.linkOf(2), 0.5).p_WL - Vector3d(-1, 0, 1)).norm(), 1e-15);
}

// The arc of a half turn is chosen by the last bit, and the relative chain chooses the same.
TEST(RelativeChain, TurnsBackOnTheSameArc) {
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    RandomMotion m = forest(random, 2, Vector3d::Zero());
    const JointId frame = random.below(m.skeleton.numJoints());
    const double pi = std::acos(-1.0);
    m.to.rotations[slotOf(frame)] =
        m.from.rotations[slotOf(frame)] * random.turn(pi + random.below(5) * 1e-16);
    const InFrame in(m, frame);
    const ChainMotion world(m.skeleton, m.from, m.to);
    for (LinkId link = 0; link < m.skeleton.numJoints(); ++link) {
      const LinkState f = world.stateAt(frame, 0.5), l = world.stateAt(link, 0.5);
      const Vector3d expected = f.R_WL.transpose() * (l.p_WL - f.p_WL);
      EXPECT_LT((in.motion.stateAt(in.chain.linkOf(link), 0.5).p_WL - expected).norm(), 1e-13);
    }
  }
}

// The lanes' frames too, by their own bounds.
TEST(RelativeChain, HasTheWorldsFramesAtNodes) {
  ChainNodes nodes;
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const RandomMotion m = forest(random, 2, Vector3d(1e4 * random.direction()));
    const JointId frame = random.below(m.skeleton.numJoints());
    const InFrame in(m, frame);
    nodes.evaluate(in.motion, 0.0, 1.0, Vector3d::Zero());
    const int k = random.below(kNodes);
    const auto truth = oracle::preciseFrames(m.precise, Precise(nodes.instant(k)));
    for (LinkId link = 0; link < m.skeleton.numJoints(); ++link) {
      const LinkNodes& got = nodes.link(in.chain.linkOf(link));
      const Precise3 expected = seenFrom(truth[slotOf(frame)], truth[slotOf(link)].origin);
      const Precise3 p(Vector3d(got.p[0][k], got.p[1][k], got.p[2][k]));
      EXPECT_LE(asDouble(norm(p - expected)), nodes.bounds().positionRounding);
    }
  }
}

TEST(RelativeChain, NamesItsLinksAsTheOriginalDoes) {
  RawSkeleton raw;
  const Quaternion rest = Quaternion::Identity();
  raw.joints = {{"back 1", kNoParent, Vector3d::Zero(), rest},
                {"0", 0, Vector3d(1, 0, 0), rest},
                {"back 3", 1, Vector3d(0, 0, 1), rest}};
  const Skeleton skeleton = Skeleton::build(raw).value();
  for (JointId frame = 0; frame < 3; ++frame) {
    const auto chain = RelativeChain::build(skeleton, frame);
    ASSERT_TRUE(chain.ok()) << describe(chain.error());
    for (LinkId link = 0; link < 3; ++link) {
      EXPECT_EQ(chain.value().skeleton().name(chain.value().linkOf(link)), skeleton.name(link));
    }
  }
}

TEST(RelativeChain, RefusesAChainThatIsTooDeep) {
  RawSkeleton raw;
  const Quaternion rest = Quaternion::Identity();
  for (int tree = 0; tree < 2; ++tree) {
    for (int j = 0; j < 200; ++j) {
      const auto here = static_cast<JointId>(raw.joints.size());
      raw.joints.push_back(
          {"joint" + std::to_string(here), j == 0 ? kNoParent : here - 1, Vector3d::Zero(), rest});
    }
  }
  const Skeleton skeleton = Skeleton::build(raw).value();
  EXPECT_TRUE(RelativeChain::build(skeleton, 10).ok());
  const auto deep = RelativeChain::build(skeleton, 150);
  ASSERT_FALSE(deep.ok());
  EXPECT_EQ(deep.error().code, ErrorCode::LimitExceeded);
}

}  // namespace
}  // namespace foretouch
