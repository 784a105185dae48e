#include "network/watch/view_feed.h"

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "articulated/skeleton.h"
#include "tests/network/small_stream.h"

namespace foretouch {
namespace {

/// A contact by its step and its place among the step's.
using ContactId = std::pair<std::int64_t, LinkId>;

/// Steps of one avatar, as a service says them.
class Steps {
 public:
  Steps() : pose_(restPose(test::smallAvatar().skeleton())) {}

  /// The next one, with so many contacts; shown to `observer`.
  void show(StepObserver& observer, std::size_t avatar, std::size_t contacts) {
    ++sequence_;
    pose_.translations[0].x() = static_cast<double>(sequence_);
    StreamStep step;
    step.from = step.to = &pose_;
    answer_.sequenceTo = sequence_;
    answer_.utimeFromUs = 1000 * (sequence_ - 1);
    answer_.utimeToUs = 1000 * sequence_;
    answer_.contacts.assign(contacts, {});
    for (std::size_t i = 0; i < contacts; ++i) {
      answer_.contacts[i].contact.link = static_cast<LinkId>(i);
      shown_.emplace_back(sequence_, static_cast<LinkId>(i));
    }
    observer.observe(avatar, step, answer_, nullptr, nullptr);
  }
  [[nodiscard]] std::int64_t sequence() const { return sequence_; }
  [[nodiscard]] const std::vector<ContactId>& shown() const { return shown_; }

 private:
  Pose pose_;
  ContactsMessage answer_;
  std::int64_t sequence_ = 0;
  std::vector<ContactId> shown_;
};

void append(const StepBatch& batch, std::vector<ContactId>& seen) {
  std::size_t next = 0;
  for (const BatchedStep& step : batch.touchingSteps()) {
    EXPECT_LT(next, step.endOfContacts);
    for (; next < step.endOfContacts; ++next) {
      seen.emplace_back(step.sequence, batch.contacts()[next].link);
    }
  }
  EXPECT_EQ(next, batch.contacts().size());
}

TEST(ShowPace, LetsThroughSoManyASecondWhateverComes) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    std::mt19937 random(seed);
    ShowPace pace;
    std::int64_t nowUs = 0, passed = 0;
    const std::int64_t mostUs = seed % 2 == 0 ? 2000 : 100'000;
    while (nowUs < 60'000'000) {
      nowUs += std::uniform_int_distribution<std::int64_t>(0, mostUs)(random);
      passed += pace.passes(nowUs) ? 1 : 0;
    }
    EXPECT_LE(passed, kMaxShownStepsPerS * nowUs / 1'000'000 + 2) << seed;
    EXPECT_GT(passed, 60 * (mostUs > 2000 ? 15 : kMaxShownStepsPerS - 1)) << seed;
  }
}

TEST(ShowPace, LosesNothingOfAStreamOfItsOwnRateThatJitters) {
  std::mt19937 random(1);
  ShowPace pace;
  std::int64_t waiting = 0, joined = 0;
  constexpr std::int64_t kTickUs = 10'000, kPeriodUs = 33'334, kPosesSent = 3000;
  std::int64_t nextPoseUs = 0, pose = 0;
  for (std::int64_t nowUs = 0; pose < kPosesSent; nowUs += kTickUs) {
    for (; nextPoseUs <= nowUs && pose < kPosesSent; ++pose) {
      joined += waiting > 0 ? 1 : 0;
      waiting = 1;
      nextPoseUs = (pose + 1) * kPeriodUs + static_cast<std::int64_t>(random() % 8000);
    }
    if (waiting > 0 && pace.passes(nowUs)) waiting = 0;
  }
  EXPECT_LT(joined, kPosesSent / 100);
}

TEST(StepBatch, KeepsTheNewestStepAndEveryContact) {
  ViewFeed feed(1);
  feed.watch(true);
  Steps steps;
  for (const std::size_t contacts : {2u, 0u, 3u}) steps.show(feed, 0, contacts);
  StepBatch batch;
  ASSERT_TRUE(feed.take(0, 1, batch));
  EXPECT_EQ(batch.numSteps(), 3u);
  EXPECT_EQ(batch.newest().sequence, 3);
  EXPECT_EQ(batch.newest().to.translations[0].x(), 3.0);
  EXPECT_EQ(batch.newest().utimeFromUs, 2000);
  std::vector<ContactId> seen;
  append(batch, seen);
  EXPECT_EQ(seen, steps.shown());
  EXPECT_FALSE(feed.take(0, 1'000'000, batch));
}

TEST(StepBatch, IsBoundedAndCountsWhatItCannotHold) {
  ViewFeed feed(1);
  feed.watch(true);
  Steps steps;
  for (int i = 0; i < 100; ++i) steps.show(feed, 0, 100);
  StepBatch batch;
  ASSERT_TRUE(feed.take(0, 1, batch));
  EXPECT_EQ(batch.contacts().size(), kMaxBatchContacts);
  EXPECT_EQ(batch.numLeftOut(), 100u * 100u - kMaxBatchContacts);
  EXPECT_EQ(batch.newest().sequence, 100);
}

TEST(ViewFeed, WantsNothingWhileNobodyWatches) {
  ViewFeed feed(2);
  EXPECT_FALSE(feed.wants(0));
  feed.watch(true);
  EXPECT_TRUE(feed.wants(0));
  EXPECT_TRUE(feed.wants(1));
  feed.watch(false);
  EXPECT_FALSE(feed.wants(1));
}

TEST(ViewFeed, SamplesOneStepOfEachAvatar) {
  ViewFeed feed(2);
  Steps steps, others;
  for (int round = 0; round < 3; ++round) {
    feed.sample();
    EXPECT_TRUE(feed.wants(0));
    steps.show(feed, 0, 2);
    EXPECT_FALSE(feed.wants(0));
    EXPECT_TRUE(feed.wants(1));
  }
  others.show(feed, 1, 1);
  feed.watch(true);
  StepBatch batch;
  ASSERT_TRUE(feed.take(0, 1, batch));  // the last sample alone
  EXPECT_EQ(batch.numSteps(), 1u);
  EXPECT_EQ(batch.newest().sequence, 3);
  EXPECT_EQ(batch.contacts().size(), 2u);
  ASSERT_TRUE(feed.take(1, 1, batch));
}

// The one that answers and the one that watches, at once, each as fast as it can.
TEST(ViewFeed, HandsOverEveryStepAndContactInOrder) {
  constexpr std::int64_t kSteps = 50'000;
  ViewFeed feed(1);
  feed.watch(true);
  Steps steps;
  std::atomic<bool> isOver{false};
  std::vector<ContactId> seen;
  std::atomic<std::int64_t> numSteps{0};
  std::thread watching([&] {
    StepBatch batch;
    std::int64_t nowUs = 0;
    std::uint64_t leftOut = 0;
    for (bool isLast = false; !isLast;) {
      isLast = isOver;
      nowUs += 1'000'000;
      if (!feed.take(0, nowUs, batch)) continue;
      append(batch, seen);
      numSteps += static_cast<std::int64_t>(batch.numSteps());
      leftOut += batch.numLeftOut();
      if (batch.numSteps() % 7 == 0) std::this_thread::yield();
    }
    EXPECT_EQ(leftOut, 0u);
  });
  std::mt19937 random(3);
  for (std::int64_t i = 0; i < kSteps; ++i) {
    steps.show(feed, 0, random() % 3);
    // Where the other does not get to run, a batch has its bound.
    while (i - numSteps > 1000) std::this_thread::yield();
  }
  isOver = true;
  watching.join();
  EXPECT_EQ(numSteps, kSteps);
  EXPECT_EQ(seen, steps.shown());
  EXPECT_EQ(feed.numFailed(), 0u);
}

}  // namespace
}  // namespace foretouch
