// tests/bench/trade_strategies_test.cpp: each strategy against what it promises, where the
// answer can be worked out by hand, and in random clutter against the truth.
#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/trade/runner.h"
#include "bench/trade/strategies.h"
#include "bench/trade/truth.h"
#include "lss/segment_triangle.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

/// A sphere on a single joint.
Avatar ball(double radius) {
  RawSkeleton raw;
  raw.joints.push_back({"ball", kNoParent, Eigen::Vector3d::Zero(), Quaternion::Identity()});
  return Avatar::build(Skeleton::build(raw).value(),
                       {{Lss{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), radius}}})
      .value();
}

Pose ballAt(const Avatar& avatar, double x) {
  Pose pose = restPose(avatar.skeleton());
  pose.translations[0] = {x, 0.25, 0.25};
  return validatedPose(avatar.skeleton(), pose).value();
}

constexpr double kRadius = 0.1, kTolerance = 1e-4;

/// The ball goes along x; a wall without thickness stands at x = 0.
class TradeWall : public ::testing::Test {
 protected:
  LinkTouch ask(Strategy& strategy, double from, double to, bool continues = false) {
    const Pose start = ballAt(world_.avatar, from), end = ballAt(world_.avatar, to);
    std::vector<LinkTouch> touches;
    strategy.solve({start, end, continues}, touches, work_);
    return touches.at(0);
  }

  /// Those that promise not to miss, and to be within the tolerance.
  std::vector<std::unique_ptr<Strategy>> accurate() {
    std::vector<std::unique_ptr<Strategy>> all;
    all.push_back(subdivision(world_, kTolerance));
    all.push_back(advancement(world_, kTolerance));
    all.push_back(certificates(world_, kTolerance));
    QueryOptions options;
    options.tolerance = kTolerance;
    all.push_back(foretouchQuery(world_, options, "Foretouch"));
    ReferenceOptions scalar;
    scalar.backtracking = Backtracking::Scalar;
    all.push_back(foretouchQuery(world_, options, "Foretouch, scalar", scalar));
    return all;
  }

  TradeWorld world_{ball(kRadius), Scene::build(test::wallAt(0.0, "wall")).value()};
  TradeWork work_;
};

TEST_F(TradeWall, PosesAndSparseSamplesMissItBetweenThem) {
  // The control: were the wall found here, the trade would measure nothing.
  EXPECT_FALSE(ask(*sampling(world_, 1, kTolerance), -1.0, 1.0).touches);
  EXPECT_FALSE(ask(*sampling(world_, 3, kTolerance), -1.0, 1.0).touches);
  const LinkTouch found = ask(*sampling(world_, 20, kTolerance), -1.0, 1.0);
  EXPECT_TRUE(found.touches);
  EXPECT_NEAR(found.toi, 0.45, 1e-12);  // |x| = 0.1 there: the very instant
  EXPECT_TRUE(ask(*sampling(world_, 1, kTolerance), -1.0, -0.05).touches);
}

TEST_F(TradeWall, IsMissedByNoneThatPromises) {
  for (const auto& strategy : accurate()) {
    for (const double speed : {0.5, 2.0, 40.0, 1000.0}) {
      const double begin = -0.4 * speed - 2.0 * kRadius;
      const LinkTouch touch = ask(*strategy, begin, begin + speed);
      const double first = (-kRadius - begin) / speed;  // by hand
      EXPECT_EQ(touch.touches, first <= 1.0) << strategy->name() << " " << speed;
      if (!touch.touches) continue;
      EXPECT_LE(touch.toi, first + 1e-12) << strategy->name() << " " << speed;
      EXPECT_GE(touch.toi, first - 1.001 * kTolerance / speed) << strategy->name() << " " << speed;
    }
  }
}

TEST_F(TradeWall, IsNotReportedFromAfar) {
  for (const auto& strategy : accurate()) {
    EXPECT_FALSE(ask(*strategy, -1.0, -kRadius - 2.0 * kTolerance).touches) << strategy->name();
    EXPECT_TRUE(ask(*strategy, -0.05, 1.0).touches) << strategy->name();
    EXPECT_EQ(ask(*strategy, -0.05, 1.0).toi, 0.0) << strategy->name();
  }
}

TEST_F(TradeWall, IsNotMissedByVoxelsWhichMayBeEarly) {
  const auto voxels = voxelSweep(world_);
  const double slack = 2.0 * VoxelGrid::kCellM + 0.5 * VoxelGrid::kCellM;
  for (const double speed : {2.0, 40.0}) {
    const double begin = -0.4 * speed - 2.0 * kRadius;
    const double first = (-kRadius - begin) / speed;
    const LinkTouch touch = ask(*voxels, begin, begin + speed);
    ASSERT_TRUE(touch.touches);
    EXPECT_LE(touch.toi, first);
    EXPECT_GE(touch.toi, first - slack / speed);
  }
  EXPECT_FALSE(ask(*voxels, -1.0, -kRadius - slack).touches);
}

TEST_F(TradeWall, CertificatesSkipWhatIsFarAndNothingElse) {
  const auto carried = certificates(world_, kTolerance);
  constexpr double kStep = 0.01;
  double x = -0.55;
  EXPECT_FALSE(ask(*carried, x, x + kStep).touches);
  const std::uint64_t once = work_.states;
  for (x += kStep; x + kStep < -kRadius - 5.0 * kStep; x += kStep) {
    EXPECT_FALSE(ask(*carried, x, x + kStep, true).touches);
  }
  EXPECT_EQ(work_.states, once);  // nothing was asked on the way
  EXPECT_TRUE(ask(*carried, x, 0.5, true).touches);
  // A jump: what was known says nothing of here.
  EXPECT_FALSE(ask(*carried, -0.6, -0.59).touches);
  EXPECT_TRUE(ask(*carried, -0.09, -0.08, false).touches);
}

/// A chain of joints that turn, in a cloud of triangles.
struct RandomTrade {
  explicit RandomTrade(std::uint64_t seed) : random(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(random() >> 11) * 0x1p-53);
  }
  Eigen::Vector3d inBox(double half) {
    return {uniform(-half, half), uniform(-half, half), uniform(-half, half)};
  }
  Avatar avatar() {
    RawSkeleton raw;
    std::vector<std::vector<Lss>> lss;
    for (int i = 0; i < 4; ++i) {
      raw.joints.push_back(
          {"joint" + std::to_string(i), i - 1, {0, i == 0 ? 0.0 : 0.3, 0}, Quaternion::Identity()});
      lss.push_back({Lss{{0, 0, 0}, {0, 0.3, 0}, 0.04}});
    }
    return Avatar::build(Skeleton::build(raw).value(), std::move(lss)).value();
  }
  Pose pose(const Avatar& avatar, const Eigen::Vector3d& root) {
    Pose pose = restPose(avatar.skeleton());
    for (Quaternion& q : pose.rotations) {
      q = Quaternion(Eigen::AngleAxisd(uniform(-1.0, 1.0), inBox(1.0).normalized()));
    }
    pose.translations[0] = root;
    return validatedPose(avatar.skeleton(), pose).value();
  }
  Scene scene() {
    RawScene raw;
    raw.objectNames = {"cloud"};
    for (int i = 0; i < 60; ++i) {
      const Eigen::Vector3d middle = inBox(1.5);
      raw.triangles.push_back({{middle + inBox(0.2), middle + inBox(0.2), middle + inBox(0.2)}});
      raw.objectOf.push_back(0);
    }
    return Scene::build(std::move(raw)).value();
  }
  std::mt19937_64 random;
};

TEST(TradeClutter, PromisesAreKeptAndSamplesDoMiss) {
  RandomTrade random(7);
  const Avatar avatar = random.avatar();
  TradeScore poses;
  for (int world = 0; world < 3; ++world) {
    const TradeWorld place(avatar, random.scene());
    TradeRun run;
    run.passes = 1;
    run.judged = 20;
    for (int w = 0; w < 3; ++w) {
      TradeWindow window;
      Pose from = random.pose(avatar, random.inBox(1.5));
      for (int i = 0; i < 12; ++i) {
        Pose to = random.pose(avatar, from.translations[0] + random.inBox(0.5));
        window.push_back({from, to});
        from = to;
      }
      run.windows.push_back(std::move(window));
    }
    std::vector<TradeContender> contenders;
    const auto add = [&](std::unique_ptr<Strategy> strategy, double tolerance) {
      contenders.push_back({std::move(strategy), tolerance, false});
    };
    add(sampling(place, 1, 1e-3), 1e-3);
    for (const double tolerance : {1e-2, 1e-5}) {
      add(voxelSweep(place), tolerance);
      add(subdivision(place, tolerance), tolerance);
      add(advancement(place, tolerance), tolerance);
      add(certificates(place, tolerance), tolerance);
      QueryOptions options;
      options.tolerance = tolerance;
      add(foretouchQuery(place, options, "link"), tolerance);
      for (const Rung rung : {Rung::Limb, Rung::Avatar, Rung::Ellipsoid}) {
        ReferenceOptions above;
        above.rung = rung;
        add(foretouchQuery(place, options, toString(rung), above), tolerance);
      }
    }
    const auto result = runTrade(place, std::nullopt, run, contenders);
    ASSERT_TRUE(result.ok());
    EXPECT_GE(result.value().judged.links, 10);
    EXPECT_EQ(result.value().judged.wrong, 0);
    EXPECT_EQ(result.value().judged.touching, result.value().judged.contacts);
    for (const TradeRow& row : result.value().rows) {
      if (row.promise == TradePromise::Nothing) {
        poses.missed += row.score.missed;
        poses.contacts += row.score.contacts;
        continue;
      }
      EXPECT_EQ(row.score.missed, 0) << row.strategy << " " << row.tolerance;
      EXPECT_EQ(row.score.late, 0) << row.strategy << " " << row.tolerance;
      if (row.promise != TradePromise::Accurate) continue;
      EXPECT_EQ(row.score.falseOnes, 0) << row.strategy << " " << row.tolerance;
      EXPECT_LE(row.score.distanceErrorMax, 1.0001 * row.tolerance) << row.strategy;
    }
  }
  EXPECT_GT(poses.contacts, 20);
  EXPECT_GT(poses.missed, 5);  // the control
}

TEST(NearestTree, FindsWhatLookingAtAllFinds) {
  RandomTrade random(3);
  const Scene scene = random.scene();
  const NearestTree tree(scene);
  TradeWork work;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d a = random.inBox(2.5), b = random.inBox(2.5);
    double least = 1.0;
    for (std::size_t k = 0; k < scene.numTriangles(); ++k) {
      least =
          std::min(least, closestPoints(a, b, scene.triangle(static_cast<TriangleId>(k))).distance);
    }
    EXPECT_EQ(tree.distance(a, b, 1.0, 0.0, work), least);
  }
}

}  // namespace
}  // namespace foretouch::tools
