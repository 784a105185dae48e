// Each rung's volumes contain those of the next, at every instant, in fifty digits; and are not
// much larger than they must be.
#include <algorithm>

#include <gtest/gtest.h>

#include "lss/simd.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/reference/random_step.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using oracle::Precise3;
using oracle::PreciseFrame;
using oracle::PreciseQuaternion;
using test::Random;
using test::RandomStep;
using Real = oracle::Precise;

/// What the yardstick itself rounds: a volume may be the very one below it.
const Real kDigits(1e-40);

/// One triangle, whose place does not matter.
Scene someScene(const Vector3d& center) {
  Random random(7);
  return Scene::build(test::clutter(random, 1, 1, center)).value();
}

Precise3 inFrame(const PreciseFrame& frame, const Precise3& p_W) {
  const PreciseQuaternion back{frame.rotation.w, -frame.rotation.x, -frame.rotation.y,
                               -frame.rotation.z};
  const Real square = frame.rotation.w * frame.rotation.w + frame.rotation.x * frame.rotation.x +
                      frame.rotation.y * frame.rotation.y + frame.rotation.z * frame.rotation.z;
  return (1 / square) * oracle::rotate(back, p_W - frame.origin);
}

Real axisDistance(const Lss& lss, const Precise3& p) {
  const Precise3 a(lss.a), u = Precise3(lss.b) - a, w = p - a;
  const Real uu = dot(u, u);
  Real s = uu > 0 ? dot(w, u) / uu : Real(0);
  s = s < 0 ? Real(0) : (s > 1 ? Real(1) : s);
  return norm(w - s * u);
}

/// How far balls of `lss`, carried by `inner`, stick out of `outer`, which is carried by another.
Real sticksOut(const Lss& outer, const PreciseFrame& carrier, const Lss& lss,
               const PreciseFrame& inner) {
  Real worst = -1;
  for (const Vector3d& end : {lss.a, lss.b}) {
    const Real reach = axisDistance(outer, inFrame(carrier, inner.at(end))) + lss.radius;
    worst = std::max(worst, Real(reach - outer.radius));
  }
  return worst;
}

/// By the support function: the ball at `p` (W) reaches at most as far as the spheroid in every
/// direction tried, the likeliest worst among them.
Real sticksOut(const Spheroid& spheroid, const Precise3& p, double radius, double t,
               Random& random) {
  const Precise3 center = Precise3(spheroid.start) + Real(t) * Precise3(spheroid.drift);
  const Precise3 axis(spheroid.axis), w = p - center;
  const auto inUnit = [&](const Precise3& x) {
    return Real(1 / Real(spheroid.across)) * x +
           Real((1 / Real(spheroid.along) - 1 / Real(spheroid.across)) * dot(axis, x)) * axis;
  };
  Real worst = -1;
  // The farthest point of the ball in the unit ball's space, by stepping along the gradient.
  Precise3 direction(random.direction());
  const int tries = radius > 0.0 ? 40 : 1;
  for (int i = 0; i < tries; ++i) {
    const Precise3 out = inUnit(w + Real(radius) * direction);
    worst = std::max(worst, Real(norm(out) - 1));
    const Precise3 gradient = inUnit(out);
    direction = Real(1 / norm(gradient)) * gradient;
  }
  return worst;
}

void expectContained(const RandomStep& step, Random& random, const Vector3d& center) {
  const ChainMotion motion = step.motion();
  const Scene scene = someScene(center);
  const auto limbs = rungVolumes(step.avatar, motion, scene, Rung::Limb);
  const auto trees = rungVolumes(step.avatar, motion, scene, Rung::Avatar);
  const auto spheroids = rungVolumes(step.avatar, motion, scene, Rung::Ellipsoid);
  ASSERT_EQ(trees.size(), spheroids.size());
  std::size_t covered = 0;
  for (const double t : test::instants(random, 8)) {
    const auto frames = oracle::preciseFrames(step.precise(), Real(t));
    const auto frame = [&](LinkId link) { return frames[static_cast<std::size_t>(link)]; };
    for (const RungVolume& limb : limbs) {
      for (const LinkId link : limb.links) {
        for (const Lss& lss : step.avatar.lss(link)) {
          EXPECT_LE(sticksOut(limb.lss, frame(limb.carrier), lss, frame(link)), kDigits)
              << "link " << link << " at " << t;
        }
        covered += t == 0.0;
      }
      for (const RungVolume& tree : trees) {
        if (!std::binary_search(tree.links.begin(), tree.links.end(), limb.links.front())) continue;
        EXPECT_LE(sticksOut(tree.lss, frame(tree.carrier), limb.lss, frame(limb.carrier)), kDigits)
            << "limb of " << limb.carrier << " at " << t;
      }
    }
    for (std::size_t i = 0; i < trees.size(); ++i) {
      EXPECT_EQ(spheroids[i].carrier, trees[i].carrier);
      for (const Vector3d& end : {trees[i].lss.a, trees[i].lss.b}) {
        EXPECT_LE(sticksOut(spheroids[i].spheroid, frame(trees[i].carrier).at(end),
                            trees[i].lss.radius, t, random),
                  kDigits)
            << "tree of " << trees[i].carrier << " at " << t;
      }
    }
  }
  for (LinkId link = 0; link < step.avatar.numLinks(); ++link) {
    covered -= step.avatar.lss(link).empty() ? 0 : 1;
  }
  EXPECT_EQ(covered, 0U) << "every link with LSS is in one limb";
}

class RungVolumesOf : public testing::TestWithParam<Simd> {
 protected:
  void SetUp() override { ASSERT_TRUE(useSimd(GetParam())); }
  void TearDown() override { useSimd(std::nullopt); }
};

TEST_P(RungVolumesOf, RandomStepsContainWhatIsBelowThem) {
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    const Vector3d center =
        i % 5 == 0 ? Vector3d(1e4 * random.direction()) : Vector3d(random.inBox(2));
    expectContained(test::randomStep(random, 1 + random.below(14), i % 2 == 0, center), random,
                    center);
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(EveryWidth, RungVolumesOf, testing::ValuesIn(supportedSimd()),
                         [](const auto& tested) { return std::string(toString(tested.param)); });

/// Without a radius there is nothing in an ellipsoid but what the turn asks for.
TEST(RungVolumes, OfAThinTurningLinkContainIt) {
  const Scene scene = someScene(Vector3d::Zero());
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE(i);
    Random random(static_cast<std::uint64_t>(i));
    RawSkeleton raw;
    raw.joints.push_back({"alone", kNoParent, random.inBox(1.0), Quaternion::Identity()});
    const Vector3d end = random.inBox(0.5);
    const Lss lss{end, random.chance(0.5) ? Vector3d(-end) : random.inBox(0.5), 0.0};
    RandomStep step{Avatar::build(Skeleton::build(raw).value(), {{lss}}).value(), {}, {}};
    step.from = step.to = restPose(step.avatar.skeleton());
    step.to.rotations[0] = random.turn(random.uniform(0.5, 3.1));
    const auto volume = rungVolumes(step.avatar, step.motion(), scene, Rung::Ellipsoid).front();
    for (const double t : test::instants(random, 30)) {
      const auto frame = oracle::preciseFrames(step.precise(), Real(t)).front();
      for (const Vector3d& point : {lss.a, lss.b}) {
        EXPECT_LE(sticksOut(volume.spheroid, frame.at(point), 0.0, t, random), kDigits);
      }
    }
    if (HasFailure()) return;
  }
}

TEST(RungVolumes, OfALinkWithOneLssAreThatLss) {
  RawSkeleton raw;
  raw.joints.push_back({"alone", kNoParent, Vector3d(1, 2, 3), Quaternion::Identity()});
  const Lss lss{{0.1, 0, 0}, {0.3, 0.2, 0}, 0.05};
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), {{lss}}).value();
  Random random(3);
  Pose to = restPose(avatar.skeleton());
  to.rotations[0] = random.turn(2.0);
  const ChainMotion motion(avatar.skeleton(), restPose(avatar.skeleton()), to);
  for (const Rung rung : {Rung::Limb, Rung::Avatar}) {
    const auto volumes = rungVolumes(avatar, motion, someScene(Vector3d::Zero()), rung);
    ASSERT_EQ(volumes.size(), 1U);
    EXPECT_EQ(volumes[0].lss.a, lss.a);
    EXPECT_EQ(volumes[0].lss.b, lss.b);
    EXPECT_EQ(volumes[0].lss.radius, lss.radius);
  }
}

/// A straight chain along x that stays as it is.
TEST(RungVolumes, OfAStraightChainAreAsThinAsTheChain) {
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (JointId j = 0; j < 128; ++j) {
    raw.joints.push_back({"link" + std::to_string(j), j - 1,
                          j == 0 ? Vector3d(0, 0, 0) : Vector3d(0.1, 0, 0),
                          Quaternion::Identity()});
    lss.push_back({{Vector3d::Zero(), Vector3d(0.1, 0, 0), 0.04}});
  }
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), lss).value();
  const Pose rest = restPose(avatar.skeleton());
  Pose shifted = rest;
  shifted.translations[0] += Vector3d(1, 2, 3);
  const ChainMotion motion(avatar.skeleton(), rest, shifted);
  const Scene scene = someScene(Vector3d::Zero());
  const auto tree = rungVolumes(avatar, motion, scene, Rung::Avatar);
  ASSERT_EQ(tree.size(), 1U);
  EXPECT_NEAR(tree[0].lss.radius, 0.04, 1e-7);
  EXPECT_NEAR((tree[0].lss.b - tree[0].lss.a).norm(), 12.8, 1e-7);
  const auto spheroid = rungVolumes(avatar, motion, scene, Rung::Ellipsoid);
  EXPECT_GT(spheroid[0].spheroid.along, 6.44);
  EXPECT_LT(spheroid[0].spheroid.along, 2.0 * 6.44);
  EXPECT_LT(spheroid[0].spheroid.across, 3.0 * 0.04);
  EXPECT_EQ(spheroid[0].spheroid.drift, Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace foretouch
