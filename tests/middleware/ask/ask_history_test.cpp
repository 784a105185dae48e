// A world that remembers: what was answered about an instant is answered again later, to the bit,
// as long as it is remembered; what is not is refused; and what remembering costs.
#include <algorithm>
#include <string>
#include <vector>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <gtest/gtest.h>

#include "middleware/ask/ask.h"
#include "tests/middleware/world/random_worlds.h"
#include "tests/support/random_geometry.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kTickUs = 10'000, kKeptUs = 500'000;
constexpr int kBodies = 4, kTicks = 150;

/// Bodies that hop to a new pose each tick.
class Played {
 public:
  explicit Played(std::uint64_t seed) : random_(seed) {
    for (int i = 0; i < kBodies; ++i) {
      walkers_.push_back(test::randomWalker(random_, random_.inBox(0.8), 0.1));
      EXPECT_TRUE(world.add(walkers_.back().avatar).ok());
    }
  }
  void tick(std::int64_t us) {
    for (int i = 0; i < kBodies; ++i) {
      const Avatar& avatar = walkers_[slotOf(i)].avatar;
      Pose pose;
      for (LinkId link = 0; link < avatar.numLinks(); ++link) {
        pose.rotations.push_back(random_.rotation());
        pose.translations.push_back(avatar.skeleton().restOffset(link));
      }
      pose.translations.front() = random_.inBox(1.0);
      ASSERT_TRUE(world.push(i, us, pose).ok());
    }
  }
  World world = World::build(std::nullopt).value();

 private:
  test::Random random_;
  std::vector<test::Walker> walkers_;
};

struct Asked {
  WorldQuestion question;
  WorldAnswer answer;
};

WorldQuestion drawn(test::Random& random, std::int64_t fromUs, std::int64_t untilUs) {
  const auto time = [&] {
    const auto span = static_cast<int>(untilUs - fromUs);
    return WorldTime{fromUs + random.below(span), random.uniform(0.0, 1.0)};
  };
  const Vector3d from = random.inBox(3.0);
  WorldQuestion question = WorldQuestion::ray(from, random.inBox(1.0) - from, 9.0, time());
  const int kind = random.below(4);
  if (kind == 1) question.shape.radius = 0.1;
  if (kind == 2) question.hull = boxCorners(Vector3d(0.1, 0.2, 0.3), random.rotation());
  if (kind == 3) question.what = AskWhat::Nearest;
  if (random.chance(0.5)) question.which = AskWhich::All;
  for (BodyId body = 0; body < kBodies; ++body) {
    if (random.chance(0.3)) question.instants.push_back({body, time()});
  }
  return question;
}

std::int64_t earliest(const WorldQuestion& question) {
  std::int64_t us = question.time.us;
  for (const AskInstant& instant : question.instants) us = std::min(us, instant.time.us);
  return us;
}

void expectSame(const WorldAnswer& then, const WorldAnswer& now) {
  ASSERT_EQ(then.hits.size(), now.hits.size());
  for (std::size_t i = 0; i < then.hits.size(); ++i) {
    EXPECT_EQ(then.hits[i].distance, now.hits[i].distance);
    EXPECT_EQ(then.hits[i].what.p_W, now.hits[i].what.p_W);
    EXPECT_EQ(then.hits[i].nhat_W, now.hits[i].nhat_W);
    EXPECT_EQ(then.hits[i].what.body, now.hits[i].what.body);
    EXPECT_EQ(then.hits[i].what.link, now.hits[i].what.link);
    EXPECT_EQ(then.hits[i].what.lss, now.hits[i].what.lss);
  }
  EXPECT_EQ(then.unknown.size(), now.unknown.size());
}

// Asked again each tick: while the world goes on, and forgets what is older than half a second.
TEST(AskHistory, ThePastIsAnsweredAsItWasThenOrRefused) {
  Played played(1);
  test::Random random(2);
  Scratch scratch;
  WorldAnswer answer;
  std::vector<Asked> asked;
  int same = 0, refused = 0, hits = 0;
  for (int tick = 0; tick < kTicks; ++tick) {
    const std::int64_t nowUs = kTickUs * tick;
    played.tick(nowUs);
    played.world.forgetBefore(nowUs - kKeptUs);
    for (int i = 0; tick > 1 && i < 3; ++i) {
      Asked one{drawn(random, std::max<std::int64_t>(0, nowUs - 8 * kTickUs), nowUs), {}};
      ASSERT_TRUE(askWorld(played.world, one.question, scratch, one.answer).ok());
      hits += one.answer.hits.empty() ? 0 : 1;
      asked.push_back(one);
    }
    for (int i = 0; !asked.empty() && i < 6; ++i) {
      const Asked& one =
          asked[static_cast<std::size_t>(random.below(static_cast<int>(asked.size())))];
      const auto done = askWorld(played.world, one.question, scratch, answer);
      const bool isKept = earliest(one.question) >= nowUs - kKeptUs;
      ASSERT_EQ(done.ok(), isKept);
      if (isKept) {
        expectSame(one.answer, answer);
        ++same;
      } else {
        EXPECT_NE(describe(done.error()).find("forgotten"), std::string::npos);
        ++refused;
      }
    }
  }
  EXPECT_GT(same, 200);
  EXPECT_GT(refused, 200);
  EXPECT_GT(hits, 100);
}

// What docs/ask.md says: so many bytes per body and second, with all that an allocator takes
// beside.
TEST(AskHistory, RemembersASecondInAsManyBytesAsItsPosesHave) {
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  constexpr int kJoints = 22, kHz = 128, kSeconds = 5;
  RawSkeleton raw;
  std::vector<std::vector<Lss>> lss;
  for (int i = 0; i < kJoints; ++i) {
    raw.joints.push_back({"joint" + std::to_string(i), i == 0 ? kNoParent : i - 1,
                          Vector3d(0, 0.1, 0), Quaternion::Identity()});
    lss.push_back({{Vector3d::Zero(), Vector3d(0, 0.1, 0), 0.03}});
  }
  const Avatar avatar = Avatar::build(Skeleton::build(raw).value(), lss).value();
  World world = World::build(std::nullopt).value();
  const BodyId body = world.add(avatar).value();
  Pose pose;
  pose.rotations.assign(kJoints, Quaternion::Identity());
  pose.translations.assign(kJoints, Vector3d(0, 0.1, 0));
  const auto bytes = [] {
    const struct mallinfo2 info = mallinfo2();
    return static_cast<double>(info.uordblks + info.hblkhd);
  };
  const double before = bytes();
  for (int tick = 0; tick < kHz * kSeconds; ++tick) {
    const std::int64_t us = 1'000'000LL * tick / kHz;
    ASSERT_TRUE(world.push(body, us, pose).ok());
    world.forgetBefore(us - 1'000'000);
  }
  const double perPose = (bytes() - before) / kHz;
  EXPECT_GT(perPose, 56.0 * kJoints);
  EXPECT_LT(perPose, 56.0 * kJoints + 256.0);
#else
  GTEST_SKIP() << "this build's allocator does not say what it has given";
#endif
}

// Boxes around what a body does are kept for a quarter of a second of world time. What was
// forgotten in between is no part of one that is gone on with.
TEST(AskHistory, GoesOnAfterPosesWereForgottenThatItHasNotSeen) {
  Played played(5);
  Scratch scratch;
  WorldAnswer kept, anew;
  test::Random random(6);
  int hits = 0;
  std::int64_t us = 0;
  for (int round = 0; round < 40; ++round) {
    // A few ticks are asked about; then many come, and go, that nobody asks about.
    for (int tick = 0; tick < 20; ++tick, us += kTickUs) {
      played.tick(us);
      played.world.forgetBefore(us - 3 * kTickUs);
      if (tick > 1 && tick < 17) continue;
      for (int i = 0; tick > 1 && i < 4; ++i) {
        const WorldQuestion question = drawn(random, us - 2 * kTickUs, us);
        ASSERT_TRUE(askWorld(played.world, question, scratch, kept).ok());
        Scratch other;
        ASSERT_TRUE(askWorld(played.world, question, other, anew).ok());
        expectSame(anew, kept);
        hits += kept.hits.empty() ? 0 : 1;
      }
    }
  }
  EXPECT_GT(hits, 50);
}

// A replay of the poses, asked in another order by a memory of its own.
TEST(AskHistory, AReplayOfTheLogHasTheSameVerdicts) {
  Played played(3), replay(3);
  test::Random random(4);
  std::vector<Asked> asked;
  Scratch scratch;
  for (int tick = 0; tick < 40; ++tick) {
    played.tick(kTickUs * tick);
    if (tick < 2) continue;
    Asked one{drawn(random, 0, kTickUs * tick), {}};
    ASSERT_TRUE(askWorld(played.world, one.question, scratch, one.answer).ok());
    asked.push_back(one);
  }
  for (int tick = 0; tick < 40; ++tick) replay.tick(kTickUs * tick);
  Scratch anew;
  WorldAnswer answer;
  for (auto one = asked.rbegin(); one != asked.rend(); ++one) {
    ASSERT_TRUE(askWorld(replay.world, one->question, anew, answer).ok());
    expectSame(one->answer, answer);
  }
}

}  // namespace
}  // namespace foretouch
