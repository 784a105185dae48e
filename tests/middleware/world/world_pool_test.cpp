// The same question on several threads, and with what earlier windows have left: the same answers,
// to the bit.
#include <algorithm>
#include <cstring>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/contact.h"
#include "middleware/query/query.h"
#include "middleware/worker_pool.h"
#include "middleware/world/world.h"
#include "tests/middleware/own_body.h"

namespace foretouch {
namespace {

using test::Random;

constexpr std::int64_t kWindowUs = 30'000, kWindows = 6;

/// Forty bodies with clocks of their own in a narrow place, a mesh that flies past them, and one
/// that somebody carries.
World crowd() {
  World world = World::build(test::farScene()).value();
  for (BodyId body = 0; body < 40; ++body) {
    Random random(static_cast<std::uint64_t>(body));
    const test::OwnBody made = test::randomOwnBody(random);
    BodyOptions options;
    if (const auto rules = PairRules::derive(made.avatar); rules.ok()) options.self = rules.value();
    EXPECT_TRUE(world.add(made.avatar, options).ok());
    const Eigen::Vector3d place = random.inBox(1.5);
    const std::int64_t periodUs = 5'000 + random.below(60'000);
    std::int64_t us = -random.below(static_cast<int>(periodUs));
    for (int i = 0; us < kWindows * kWindowUs + periodUs; us += periodUs, ++i) {
      Pose pose = i % 2 == 0 ? made.steps.from : made.steps.to;
      pose.translations[0] = place + random.inBox(0.1);
      EXPECT_TRUE(world.push(body, us, pose).ok());
    }
  }
  RawScene raw;
  raw.objectNames = {"sail"};
  raw.triangles = {
      {{Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}}};
  raw.objectOf = {0};
  const Scene sail = Scene::build(std::move(raw)).value();
  const BodyId flying = world.add(sail).value(), carried = world.add(sail).value();
  for (std::int64_t us = 0; us <= kWindows * kWindowUs; us += 10'000) {
    const Eigen::Vector3d at(1e-5 * static_cast<double>(us) - 1.0, 0, 0);
    EXPECT_TRUE(world.push(flying, us, RigidPose{Quaternion::Identity(), at}).ok());
  }
  EXPECT_TRUE(world.attach(carried, {0, 0}, 0, RigidPose{}).ok());
  return world;
}

template <typename T>
bool areSameBits(const T& x, const T& y) {
  return std::memcmp(&x, &y, sizeof(T)) == 0;
}

void expectSame(const ContactSide& x, const ContactSide& y) {
  EXPECT_EQ(x.body, y.body);
  EXPECT_EQ(x.link, y.link);
  EXPECT_EQ(x.lss, y.lss);
  EXPECT_EQ(x.triangle, y.triangle);
  for (int k = 0; k < 3; ++k) EXPECT_TRUE(areSameBits(x.p_W[k], y.p_W[k]));
}

void expectSame(const WorldContacts& x, const WorldContacts& y) {
  ASSERT_EQ(x.contacts.size(), y.contacts.size());
  for (std::size_t i = 0; i < x.contacts.size(); ++i) {
    const WorldContact &one = x.contacts[i], &other = y.contacts[i];
    expectSame(one.a, other.a);
    expectSame(one.b, other.b);
    EXPECT_EQ(one.verdict, other.verdict);
    EXPECT_EQ(one.reason, other.reason);
    EXPECT_TRUE(one.time == other.time);
    EXPECT_TRUE(areSameBits(one.separation, other.separation));
    EXPECT_TRUE(areSameBits(one.penetration, other.penetration));
    for (int k = 0; k < 3; ++k) EXPECT_TRUE(areSameBits(one.nhat_BA_W[k], other.nhat_BA_W[k]));
  }
  EXPECT_EQ(x.counters.bodies, y.counters.bodies);
  EXPECT_EQ(x.counters.pairs, y.counters.pairs);
  EXPECT_EQ(x.counters.nearPairs, y.counters.nearPairs);
  EXPECT_EQ(x.counters.spans, y.counters.spans);
  for (const auto& field : kCounterFields) {
    EXPECT_EQ(x.counters.queries.*field.second, y.counters.queries.*field.second) << field.first;
  }
}

/// Every window by itself, with memory that has seen nothing.
std::vector<WorldContacts> answersOf(const World& world) {
  std::vector<WorldContacts> answers(static_cast<std::size_t>(kWindows));
  for (std::size_t i = 0; i < answers.size(); ++i) {
    Scratch scratch;
    const auto from = static_cast<std::int64_t>(i) * kWindowUs;
    EXPECT_TRUE(world.contacts(from, from + kWindowUs, scratch, answers[i]).ok());
  }
  return answers;
}

TEST(WorldOnThreads, GivesTheSameAnswersOnAnyNumberOfThreads) {
  const World world = crowd();
  const std::vector<WorldContacts> expected = answersOf(world);
  EXPECT_GT(expected.back().contacts.size(), 100u);
  EXPECT_GT(expected.back().counters.pairs, 30u);
  for (const int threads : {1, 2, 3, 8}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    WorkerPool pool = WorkerPool::start(threads).value();
    EXPECT_EQ(pool.threads(), threads);
    WorldContacts answer;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      const auto from = static_cast<std::int64_t>(i) * kWindowUs;
      const auto asked = world.contacts(from, from + kWindowUs, pool, answer);
      ASSERT_TRUE(asked.ok()) << describe(asked.error());
      expectSame(answer, expected[i]);
    }
  }
}

TEST(WorldOnThreads, GivesTheSameAnswersAfterAnyOtherWindows) {
  const World world = crowd();
  const std::vector<WorldContacts> expected = answersOf(world);
  Scratch scratch;
  WorldContacts answer;
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const auto window = static_cast<std::size_t>(random.below(static_cast<int>(expected.size())));
    const auto from = static_cast<std::int64_t>(window) * kWindowUs;
    ASSERT_TRUE(world.contacts(from, from + kWindowUs, scratch, answer).ok());
    expectSame(answer, expected[window]);
    // Cuts the same pieces elsewhere.
    const std::int64_t begin = random.below(static_cast<int>(kWindows * kWindowUs) - 2'000);
    ASSERT_TRUE(world.contacts(begin, begin + 1'000, scratch, answer).ok());
  }
}

TEST(WorldOnThreads, ListsContactsInTheirOrder) {
  const auto comesBefore = [](const WorldContact& x, const WorldContact& y) {
    if (!(x.time == y.time)) return x.time < y.time;
    return std::make_tuple(x.a.body, x.a.link, x.b.body, x.b.link) <
           std::make_tuple(y.a.body, y.a.link, y.b.body, y.b.link);
  };
  std::size_t atBegin = 0, later = 0;
  for (const WorldContacts& answer : answersOf(crowd())) {
    const auto& all = answer.contacts;
    EXPECT_TRUE(std::is_sorted(all.begin(), all.end(), comesBefore));
    for (const WorldContact& contact : all) {
      (contact.time == all.front().time ? atBegin : later) += 1;
    }
  }
  EXPECT_GT(atBegin, 50u);
  EXPECT_GT(later, 50u);
}

// What one thread keeps of a world serves no other one, even where both are made of the like.
TEST(WorldOnThreads, GivesTheSameAnswersInTurnsWithAnotherWorld) {
  const World one = crowd();
  World other = World::build(std::nullopt).value();
  for (BodyId body = 0; body < 10; ++body) {
    Random random(static_cast<std::uint64_t>(100 + body));
    const test::OwnBody made = test::randomOwnBody(random);
    EXPECT_TRUE(other.add(made.avatar, {}).ok());
    for (const std::int64_t us : {std::int64_t{0}, kWindows * kWindowUs}) {
      EXPECT_TRUE(other.push(body, us, us == 0 ? made.steps.from : made.steps.to).ok());
    }
  }
  const std::vector<WorldContacts> ofOne = answersOf(one), ofOther = answersOf(other);
  EXPECT_FALSE(ofOther.front().contacts.empty());
  Scratch scratch;
  WorldContacts answer;
  for (std::size_t i = 0; i < ofOne.size(); ++i) {
    const auto from = static_cast<std::int64_t>(i) * kWindowUs;
    ASSERT_TRUE(one.contacts(from, from + kWindowUs, scratch, answer).ok());
    expectSame(answer, ofOne[i]);
    ASSERT_TRUE(other.contacts(from, from + kWindowUs, scratch, answer).ok());
    expectSame(answer, ofOther[i]);
  }
}

TEST(WorldOnThreads, RefusesWhatWorldContactsRefuses) {
  EXPECT_FALSE(WorkerPool::start(0).ok());
  EXPECT_FALSE(WorkerPool::start(kMaxPoolThreads + 1).ok());
  const World world = crowd();
  WorkerPool pool = WorkerPool::start(2).value();
  WorldContacts answer;
  const auto asked = world.contacts(100, 100, pool, answer);
  ASSERT_FALSE(asked.ok());
  EXPECT_EQ(asked.error().code, ErrorCode::OutOfRange);
  EXPECT_TRUE(world.contacts(0, 100, pool, answer).ok());
}

}  // namespace
}  // namespace foretouch
