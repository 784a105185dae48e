// Random worlds, each answer held against the judge's own world: avatars with clocks of their own,
// meshes that fly and spin, tools in hands, lifts.
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "lss/index.h"
#include "tests/middleware/own_body.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

TEST(WorldOracle, ProvesAvatarsWithOneClock) {
  WorldTally sum;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(i));
    BothWorlds both(randomTolerance(random));
    const Vector3d place =
        random.chance(0.3) ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, place + random.inBox(0.4), 0.15);
      walk(both, both.add(walker.avatar), walker, 33333, kWindowUs, random);
    }
    both.judgeAll(0, kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 500);
  EXPECT_GT(sum.contact, 100);
  EXPECT_GT(sum.start, 50);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

TEST(WorldOracle, ProvesAvatarsWithClocksOfTheirOwn) {
  WorldTally sum;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(1000 + i));
    BothWorlds both(randomTolerance(random));
    const Vector3d place =
        random.chance(0.3) ? Vector3d(1e4 * random.direction()) : Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, place + random.inBox(0.4), 0.15);
      walk(both, both.add(walker.avatar), walker, randomPeriod(random), kWindowUs, random);
    }
    const std::int64_t begin = random.below(40'000), end = kWindowUs - random.below(40'000);
    both.judgeAll(begin, end);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 500);
  EXPECT_GT(sum.contact, 100);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

// What is known of a body's pieces serves one window after the other: windows that cut pieces, that
// hold several, and that are so short that a piece is not looked at as a whole.
TEST(WorldOracle, ProvesOneWindowAfterTheOther) {
  WorldTally sum;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(4000 + i));
    BothWorlds both(randomTolerance(random));
    for (int k = 0; k < 2; ++k) {
      Walker walker = randomWalker(random, random.inBox(0.3), 0.1);
      BodyOptions options;
      if (const auto rules = PairRules::derive(walker.avatar); rules.ok()) {
        options.self = rules.value();
      }
      walk(both, both.add(walker.avatar, options), walker, randomPeriod(random), kWindowUs, random);
    }
    std::int64_t begin = random.below(20'000);
    while (begin < kWindowUs) {
      const int longest = random.chance(0.3) ? 2'000 : 50'000;
      const std::int64_t end = std::min(kWindowUs, begin + 500 + random.below(longest));
      both.judgeAll(begin, end);
      begin = end;
    }
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 1000);
  EXPECT_GT(sum.contact, 150);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

TEST(WorldOracle, ProvesMeshesThatFlyAndSpin) {
  WorldTally sum;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(2000 + i));
    BothWorlds both(randomTolerance(random));
    const bool isMeshFirst = random.chance(0.5);
    const Scene mesh = randomMesh(random);
    Walker walker = randomWalker(random, random.inBox(0.3), 0.05);
    const BodyId first = isMeshFirst ? both.add(mesh) : both.add(walker.avatar);
    const BodyId second = isMeshFirst ? both.add(walker.avatar) : both.add(mesh);
    walk(both, isMeshFirst ? second : first, walker, randomPeriod(random), kWindowUs, random);
    fly(both, isMeshFirst ? first : second, random.inBox(0.5), randomPeriod(random), kWindowUs,
        random);
    both.judgeAll(random.below(20'000), kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 50);
  EXPECT_GT(sum.contact, 50);
  EXPECT_GT(sum.start, 20);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

/// A tool in the hand, against the body that holds it and against another one; let go on the way.
TEST(WorldOracle, ProvesToolsThatAreTakenAndLetGo) {
  WorldTally sum;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(3000 + i));
    BothWorlds both(randomTolerance(random));
    Walker holder = randomWalker(random, random.inBox(0.3), 0.05);
    Walker other = randomWalker(random, random.inBox(0.6), 0.05);
    const BodyId holding = both.add(holder.avatar), near = both.add(other.avatar);
    const bool isMesh = random.chance(0.5);
    const Walker rod = randomWalker(random, Vector3d::Zero(), 0.0);
    const std::vector<Lss> lss = rod.avatar.lss(0);
    RawSkeleton one;
    one.joints = {{"tool", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
    const Avatar ofLss = Avatar::build(Skeleton::build(one).value(), {lss}).value();
    const BodyId tool = isMesh ? both.add(randomMesh(random)) : both.add(ofLss);
    walk(both, holding, holder, randomPeriod(random), kWindowUs, random);
    walk(both, near, other, randomPeriod(random), kWindowUs, random);
    const LinkId hand = random.below(holder.avatar.numLinks());
    const std::int64_t taken = 20'000 + random.below(20'000),
                       let = taken + 1 + random.below(50'000);
    RigidPose place{random.rotation(), random.inBox(1.0)};
    both.push(tool, 0, place);
    both.push(tool, 50'000, {place.rotation, place.translation + random.inBox(0.2)});
    both.attach(tool, {holding, hand}, taken, {random.rotation(), random.inBox(0.3)});
    both.detach(tool, let, {random.rotation(), random.inBox(1.0)});
    both.push(tool, kWindowUs, {random.rotation(), random.inBox(1.0)});
    // From change to change, where the judge knows who is whose.
    for (const auto& [begin, end] :
         {std::pair(std::int64_t{0}, taken), std::pair(taken, let), std::pair(let, kWindowUs)}) {
      both.judgeAll(begin, end);
    }
    // Over the whole way, the two that stay themselves.
    both.judge(near, tool, 0, kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 500);
  EXPECT_GT(sum.contact, 100);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 10);
}

/// Two on a lift that turns and rises, by poses in its frame, and one who stands beside it.
TEST(WorldOracle, ProvesWhoRidesOnALift) {
  WorldTally sum;
  for (int i = 0; i < 150; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    Random random(static_cast<std::uint64_t>(4000 + i));
    BothWorlds both(randomTolerance(random));
    const BodyId lift = both.add(randomMesh(random));
    fly(both, lift, random.inBox(0.3), randomPeriod(random), kWindowUs, random);
    for (int k = 0; k < 2; ++k) {
      RawSkeleton one;
      one.joints = {{"rider", kNoParent, Vector3d::Zero(), Quaternion::Identity()}};
      const Avatar rider = Avatar::build(Skeleton::build(one).value(), {randomLss(random)}).value();
      const BodyId body = both.add(rider);
      RigidPose pose{random.rotation(), random.inBox(0.4)};
      both.attach(body, {lift, 0, true}, 0, pose);
      const std::int64_t period = randomPeriod(random);
      for (std::int64_t us = period; us < kWindowUs + period; us += period) {
        pose.translation += random.inBox(0.1);
        both.push(body, us, pose);
        // The judge's episode goes on.
      }
    }
    Walker walker = randomWalker(random, random.inBox(0.5), 0.1);
    walk(both, both.add(walker.avatar), walker, randomPeriod(random), kWindowUs, random);
    both.judgeAll(0, kWindowUs);
    add(both, sum);
  }
  EXPECT_GT(sum.clear, 200);
  EXPECT_GT(sum.contact, 100);
  EXPECT_EQ(sum.undecided, 0);
  EXPECT_LT(sum.grazing, 5);
}

/// Three avatars, answers changed before they are judged.
int problemsOf(const std::function<void(WorldContacts&)>& tamper, int& contacts) {
  int problems = 0;
  contacts = 0;
  for (int i = 0; i < 30; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    BothWorlds both(1e-6);
    both.tamper = tamper;
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random, random.inBox(0.4), 0.15);
      walk(both, both.add(walker.avatar), walker, randomPeriod(random), kWindowUs, random);
    }
    both.judgeAll(0, kWindowUs);
    problems += static_cast<int>(both.problems.size());
    contacts += both.tally.contact;
  }
  return problems;
}

// The control: every lie is named.
TEST(WorldOracle, NamesLies) {
  int contacts = 0;
  EXPECT_EQ(problemsOf(nullptr, contacts), 0);
  const int honest = contacts;
  ASSERT_GT(honest, 40);
  const auto ofContacts = [](const std::function<void(WorldContact&)>& lie) {
    return [lie](WorldContacts& answer) {
      for (WorldContact& contact : answer.contacts) {
        if (contact.verdict == Verdict::Contact) lie(contact);
      }
    };
  };
  EXPECT_GT(problemsOf([](WorldContacts& answer) { answer.contacts.clear(); }, contacts),
            honest * 8 / 10);
  EXPECT_EQ(problemsOf(ofContacts([](WorldContact& c) { c.time.us += 50; }), contacts), honest);
  EXPECT_GT(problemsOf(ofContacts([](WorldContact& c) { c.time.us -= 50; }), contacts),
            honest * 9 / 10);
  EXPECT_GT(problemsOf(ofContacts([](WorldContact& c) { c.verdict = Verdict::StartsInContact; }),
                       contacts),
            honest / 2);
  EXPECT_GT(problemsOf(ofContacts([](WorldContact& c) {
                         std::swap(c.a.p_W, c.b.p_W);
                         c.a.p_W.x() += 1e-6;
                       }),
                       contacts),
            honest * 9 / 10);
}

}  // namespace
}  // namespace foretouch::test
