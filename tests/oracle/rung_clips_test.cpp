// tests/oracle/rung_clips_test.cpp: the volumes above the links on steps of real clips: what they
// contain, by the oracle's motion, and how much wider they are than they had to be.
#include <algorithm>
#include <iostream>
#include <vector>

#include <gtest/gtest.h>

#include "tests/oracle/sweep_inputs.h"
#include "tests/reference/rungs.h"
#include "tests/support/judged.h"
#include "tests/support/shared_data.h"

namespace foretouch::test {
namespace {

using oracle::Real;
using oracle::Vec3d;
using oracle::Vec3r;

Scene anyScene() {
  RawScene raw;
  raw.triangles = {
      {{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}}};
  raw.objectOf = {0};
  raw.objectNames = {"one"};
  return Scene::build(std::move(raw)).value();
}

/// The world's points in a link's frame.
class LinkFrame {
 public:
  LinkFrame(const oracle::Motion& motion, int link, Real t)
      : at_(motion.pointsAt<4>(link, {Vec3d{}, Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}, t,
                               0)) {}
  [[nodiscard]] Vec3r local(const Vec3r& p) const {
    const Vec3r w = p - at_[0].position;
    const auto along = [&](std::size_t i) { return dot(w, at_[i].position - at_[0].position); };
    return {along(1), along(2), along(3)};
  }

 private:
  std::array<oracle::MovingPoint, 4> at_;
};

Real axisDistance(const Lss& lss, const Vec3r& p) {
  return oracle::pointSegmentDistance(p, plain(lss.a).as<Real>(), plain(lss.b).as<Real>());
}

/// How far the balls of one volume reach from the axis of another, over some instants of a step.
Real reachFrom(const Lss& axis, LinkId carrier, const Lss& inner, LinkId innerLink,
               const oracle::Motion& motion) {
  Real reach = 0;
  constexpr int kInstants = 24;
  for (int k = 0; k <= kInstants; ++k) {
    const Real t = static_cast<Real>(k) / kInstants;
    const LinkFrame frame(motion, carrier, t);
    for (const auto& end : motion.pointsAt<2>(innerLink, {plain(inner.a), plain(inner.b)}, t, 0)) {
      reach = std::max(
          reach, axisDistance(axis, frame.local(end.position)) + static_cast<Real>(inner.radius));
    }
  }
  return reach;
}

struct Excess {
  std::vector<double> excess, radius;
  void add(const Lss& volume, Real needed) {
    excess.push_back(static_cast<double>(static_cast<Real>(volume.radius) - needed));
    radius.push_back(volume.radius);
  }
  void print(const char* rung) {
    std::sort(excess.begin(), excess.end());
    std::sort(radius.begin(), radius.end());
    const std::size_t middle = excess.size() / 2, last = excess.size() * 99 / 100;
    std::cout << rung << ": " << excess.size() << " volumes, radius median " << radius[middle]
              << " m, wider than the sampled motion asks for by " << 1e3 * excess[middle]
              << " mm (median), " << 1e3 * excess[last] << " mm (p99)\n";
  }
};

TEST(RungVolumesOfClips, ContainWhatIsBelowThemAndHardlyMore) {
  const Scene scene = anyScene();
  Excess ofLimbs, ofTrees;
  for (const char* name : {"cmu_01_01_playground_jumps.bvh", "bandai1_kick_normal_001.bvh",
                           "fair_dab.bvh", "pybvh_per_joint_orders.bvh"}) {
    FORETOUCH_REQUIRE_SHARED(path, std::string("mocap/") + name);
    const auto clip = loadClip(*path);
    ASSERT_TRUE(clip.ok()) << describe(clip.error());
    const Avatar& avatar = clip.value().avatar;
    const auto stride = static_cast<std::size_t>(strideFor(clip.value().clip, 5.0));
    const auto& frames = clip.value().clip.frames;
    for (std::size_t first = 0, steps = 0; first + stride < frames.size() && steps < 40;
         first += stride, ++steps) {
      SCOPED_TRACE(std::string(name) + " from frame " + std::to_string(first));
      const Pose from = placed(avatar.skeleton(), frames[first], {});
      const Pose to = placed(avatar.skeleton(), frames[first + stride], {});
      const ChainMotion motion(avatar.skeleton(), from, to);
      const oracle::Motion truth(plainJoints(avatar.skeleton(), from, to));
      constexpr Real kGuard = 1e-15L;
      const auto limbs = rungVolumes(avatar, motion, scene, Rung::Limb);
      for (const RungVolume& limb : limbs) {
        Real needed = 0;
        for (const LinkId link : limb.links) {
          for (const Lss& lss : avatar.lss(link)) {
            needed = std::max(needed, reachFrom(limb.lss, limb.carrier, lss, link, truth));
          }
        }
        EXPECT_LE(needed, static_cast<Real>(limb.lss.radius) + kGuard);
        ofLimbs.add(limb.lss, needed);
      }
      for (const RungVolume& tree : rungVolumes(avatar, motion, scene, Rung::Avatar)) {
        Real needed = 0;
        for (const RungVolume& limb : limbs) {
          needed =
              std::max(needed, reachFrom(tree.lss, tree.carrier, limb.lss, limb.carrier, truth));
        }
        EXPECT_LE(needed, static_cast<Real>(tree.lss.radius) + kGuard);
        ofTrees.add(tree.lss, needed);
      }
    }
  }
  ofLimbs.print("limb");
  ofTrees.print("avatar");
  EXPECT_LT(ofLimbs.excess[ofLimbs.excess.size() / 2], 2e-3);
  EXPECT_LT(ofTrees.excess[ofTrees.excess.size() / 2], 1e-2);
}

}  // namespace
}  // namespace foretouch::test
