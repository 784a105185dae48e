// Random worlds followed through time, each part of it sampled by the judge's own world from both
// sides.
#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/middleware/events/judged_events.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kUntilUs = 120'000;
constexpr int kInstants = 400;

/// Expects that nothing broke the promise.
void add(const EventTally& more, EventTally& sum) {
  for (const std::string& problem : more.problems) ADD_FAILURE() << problem;
  sum.add(more);
}

void expectAllSeen(const EventTally& sum) {
  EXPECT_GT(sum.touching, 1000u);
  EXPECT_GT(sum.kinds[static_cast<std::size_t>(EventKind::Enter)], 50u);
  EXPECT_GT(sum.kinds[static_cast<std::size_t>(EventKind::Leave)], 50u);
  EXPECT_EQ(sum.unresolved, 0u);
}

TEST(EventOracle, SamplesAvatarsWithClocksOfTheirOwn) {
  EventTally sum;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    BothWorlds both(randomTolerance(random));
    const Vector3d place =
        random.chance(0.3) ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, place + random.inBox(0.4), 0.15);
      BodyOptions ofBody;
      if (const auto rules = PairRules::derive(walker.avatar); rules.ok()) {
        ofBody.self = rules.value();
      }
      walk(both, both.add(walker.avatar, ofBody), walker, randomPeriod(random), kUntilUs, random);
    }
    // At every pose, or so that windows hold several poses of all.
    FollowOptions options;
    options.cutUs = i % 3 == 0 ? 0 : i % 3 == 1 ? kUntilUs / 12 : kUntilUs / 3;
    JudgedEvents judged(both, 0, options);
    judged.follow(kUntilUs / 3);
    judged.follow(kUntilUs);
    judged.judge(kInstants);
    add(judged.tally, sum);
  }
  expectAllSeen(sum);
}

TEST(EventOracle, SamplesMeshesThatFlyAndSpin) {
  EventTally sum;
  for (int i = 0; i < 80; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(2000 + i));
    BothWorlds both(randomTolerance(random));
    const bool isMeshFirst = random.chance(0.5);
    const Scene mesh = randomMesh(random);
    Walker walker = randomWalker(random, random.inBox(0.3), 0.05);
    const BodyId first = isMeshFirst ? both.add(mesh) : both.add(walker.avatar);
    const BodyId second = isMeshFirst ? both.add(walker.avatar) : both.add(mesh);
    walk(both, isMeshFirst ? second : first, walker, randomPeriod(random), kUntilUs, random);
    fly(both, isMeshFirst ? first : second, random.inBox(0.5), randomPeriod(random), kUntilUs,
        random);
    JudgedEvents judged(both, 0);
    judged.follow(kUntilUs);
    judged.judge(kInstants);
    add(judged.tally, sum);
  }
  expectAllSeen(sum);
}

/// Brings a surface mostly, and asks own links by half.
BodyOptions exactOptions(const Avatar& avatar, Random& random) {
  BodyOptions options;
  if (random.chance(0.8)) options.surface = randomSurface(avatar, random);
  if (random.chance(0.5)) {
    if (const auto rules = PairRules::derive(avatar); rules.ok()) options.self = rules.value();
  }
  return options;
}

// Among each other, with those that touch by their LSS, and with a mesh.
TEST(EventOracle, SamplesAvatarsThatTouchByTheirTriangles) {
  EventTally sum;
  for (int i = 0; i < 24; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(4000 + i));
    BothWorlds both(randomTolerance(random));
    // What is seen from a mesh far away is not known well enough.
    const BodyId mesh = random.chance(0.5) ? both.add(randomMesh(random)) : kStillScene;
    const bool isFar = mesh == kStillScene && random.chance(0.4);
    const Vector3d place = isFar ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, place + random.inBox(0.3), 0.15);
      const BodyId body = both.add(walker.avatar, exactOptions(walker.avatar, random));
      walk(both, body, walker, randomPeriod(random), kUntilUs, random);
    }
    if (mesh != kStillScene) {
      fly(both, mesh, place + random.inBox(0.4), randomPeriod(random), kUntilUs, random);
    }
    JudgedEvents judged(both, 0);
    judged.follow(kUntilUs / 3);
    judged.follow(kUntilUs);
    judged.judge(kInstants / 4);
    add(judged.tally, sum);
  }
  expectAllSeen(sum);
}

// Nothing else holds the samples: a follower that enters late, leaves early or stays too long.
TEST(EventOracle, NamesEveryLie) {
  const auto problemsWith = [](const std::function<void(std::vector<WorldPart>&)>& tamper) {
    std::size_t found = 0;
    for (int i = 0; i < 12; ++i) {
      Random random(static_cast<std::uint64_t>(i));
      BothWorlds both(1e-4);
      for (int k = 0; k < 2; ++k) {
        Walker walker = randomWalker(random, random.inBox(0.2), 0.15);
        walk(both, both.add(walker.avatar), walker, randomPeriod(random), kUntilUs, random);
      }
      JudgedEvents judged(both, 0);
      judged.tamper = tamper;
      judged.follow(kUntilUs);
      judged.judge(kInstants);
      found += judged.tally.problems.size();
    }
    return found;
  };
  EXPECT_EQ(problemsWith([](std::vector<WorldPart>&) {}), 0u);
  const auto moved = [](WorldTime& time, std::int64_t by) { time.us += by; };
  EXPECT_GT(problemsWith([&](std::vector<WorldPart>& parts) {
              for (WorldPart& part : parts) moved(part.from, 100);
            }),
            0u);
  EXPECT_GT(problemsWith([&](std::vector<WorldPart>& parts) {
              for (WorldPart& part : parts) moved(part.to, -100);
            }),
            0u);
  EXPECT_GT(problemsWith([&](std::vector<WorldPart>& parts) {
              for (WorldPart& part : parts) moved(part.to, 100);
            }),
            0u);
  EXPECT_GT(problemsWith([](std::vector<WorldPart>& parts) { parts.clear(); }), 0u);
}

}  // namespace
}  // namespace foretouch::test
