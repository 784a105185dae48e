// Following allocates nothing once everything has grown, and goes on where memory ran out. Of a
// program that counts the calls of malloc.
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/events/world_follower.h"
#include "tests/middleware/world/random_worlds.h"
#include "tests/support/allocation_count.h"

namespace foretouch {
namespace {

using Eigen::Vector3d;
using test::Random;

/// Sheets of 2 m across x, each an object of its own.
Scene sheets() {
  RawScene raw;
  for (int i = 0; i < 3; ++i) {
    const double x = 0.1 * i;
    raw.objectNames.push_back("sheet " + std::to_string(i));
    raw.triangles.push_back({{Vector3d(x, -1, -1), Vector3d(x, 1, -1), Vector3d(x, 0, 1)}});
    raw.objectOf.push_back(i);
  }
  return Scene::build(std::move(raw)).value();
}

/// Four people who go to and fro through each other and through sheets, with clocks of their own:
/// after four poses all comes again.
class Followed {
 public:
  Followed()
      : world_(World::build(sheets()).value()), follower_(WorldFollower::start(4000).value()) {
    Random random(5);
    for (BodyId body = 0; body < 4; ++body) {
      test::Walker walker = test::randomWalker(random, random.inBox(0.15), 0.0);
      BodyOptions options;
      if (const auto rules = PairRules::derive(walker.avatar); rules.ok()) {
        options.self = rules.value();
      }
      EXPECT_TRUE(world_.add(walker.avatar, options).ok());
      poses_.emplace_back();
      for (int k = 0; k < 4; ++k) {
        poses_.back().push_back(walker.pose);
        poses_.back().back().translations[0] += random.inBox(0.1);
        walker.step(random);
      }
    }
    while (now_ < 6) push();
  }
  void push() {
    for (BodyId body = 0; body < 4; ++body) {
      const Pose& pose = poses_[slotOf(body)][static_cast<std::size_t>(now_ % 4)];
      ASSERT_TRUE(world_.push(body, 1000 * now_ + 100 * body, pose).ok());
    }
    ++now_;
  }
  [[nodiscard]] Result<Done> follow() { return followTo(1000 * (now_ - 1)); }
  [[nodiscard]] Result<Done> followTo(std::int64_t untilUs) {
    return follower_.follow(world_, untilUs, answer_);
  }
  void forget() { world_.forgetBefore(1000 * (now_ - 1)); }
  [[nodiscard]] const WorldEvents& answer() const { return answer_; }
  [[nodiscard]] std::size_t numOpen() const { return follower_.open().size(); }

 private:
  World world_;
  WorldFollower follower_;
  std::vector<std::vector<Pose>> poses_;
  std::int64_t now_ = 0;
  WorldEvents answer_;
};

TEST(EventAllocations, AreNoneOnceEverythingHasGrown) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  Followed crowd;
  const auto tick = [&] {
    crowd.push();
    ASSERT_TRUE(crowd.follow().ok());
    crowd.forget();
  };
  for (int i = 0; i < 24; ++i) tick();
  ASSERT_GT(crowd.numOpen(), 5u);
  std::size_t events = 0;
  const std::uint64_t before = test::numAllocations();
  for (int i = 0; i < 8; ++i) {
    tick();
    events += crowd.answer().events.size();
  }
  EXPECT_EQ(test::numAllocations(), before);
  EXPECT_GT(events, 20u);
}

/// "enter of 0 1 and 2 0", one after the other.
std::string told(const WorldEvents& answer) {
  std::string text;
  for (const WorldEvent& event : answer.events) {
    text += std::string(toString(event.kind)) + " of " + std::to_string(event.a.body) + " " +
            std::to_string(event.a.link) + " and " + std::to_string(event.b.body) + " " +
            std::to_string(event.b.link) + " " + std::to_string(event.object) + "\n";
  }
  return text;
}

// Whatever of a call was done when memory ran out, the next one tells all of it: of what was found
// before, that what is open remains.
TEST(EventAllocations, AreLackingAndThenNot) {
  if (!test::countsAllocations()) GTEST_SKIP() << "this build has an allocator of its own";
  const auto begin = [](Followed& crowd) {
    crowd.push();
    ASSERT_TRUE(crowd.followTo(4200).ok());
    ASSERT_GT(crowd.numOpen(), 5u);
  };
  Followed whole;
  begin(whole);
  ASSERT_TRUE(whole.follow().ok());
  const std::string expected = told(whole.answer());
  ASSERT_GT(expected.size(), 200u);
  int failed = 0;
  for (int after = 0;; after += 1 + after / 20) {
    Followed crowd;
    begin(crowd);
    test::failAllocationAfter(after);
    const Result<Done> broken = crowd.follow();
    if (!test::stopFailing()) break;
    EXPECT_FALSE(broken.ok());
    ++failed;
    const Result<Done> again = crowd.follow();
    ASSERT_TRUE(again.ok()) << describe(again.error());
    EXPECT_EQ(told(crowd.answer()), expected) << "without allocation " << after;
  }
  EXPECT_GT(failed, 30);
}

}  // namespace
}  // namespace foretouch
