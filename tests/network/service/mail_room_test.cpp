#include "network/service/mail_room.h"

#include <atomic>
#include <map>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace foretouch {
namespace {

using std::chrono::milliseconds;
using Posted = MailRoom::Posted;
using Taken = MailRoom::Taken;

Posted post(MailRoom& room, std::size_t avatar, MailKind kind, std::int64_t stamp) {
  auto mail = std::make_unique<Mail>();
  mail->kind = kind;
  mail->receiveUtimeUs = stamp;
  mail->skeleton.hash = stamp;
  return room.post(avatar, mail);
}

/// The next mail; Nothing where there would be none but the lead.
Taken take(MailRoom& room, std::size_t& avatar, std::unique_ptr<Mail>& mail) {
  const Taken taken = room.takeOrLead(avatar, mail, milliseconds(0));
  if (taken != Taken::Lead) return taken;
  room.endLead(false);
  return Taken::Nothing;
}

/// Everything that is waiting, in order, handled at once.
std::vector<std::int64_t> drain(MailRoom& room) {
  std::vector<std::int64_t> stamps;
  std::size_t avatar = 0;
  auto mail = std::make_unique<Mail>();
  while (take(room, avatar, mail) == Taken::Mail) {
    stamps.push_back(mail->receiveUtimeUs);
    room.finish(avatar);
  }
  return stamps;
}

TEST(MailRoom, DropsTheOldestPoseAndOnlyPosesForPoses) {
  MailRoom room(1, 3);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 1), Posted::Kept);
  for (std::int64_t n = 2; n <= 4; ++n) EXPECT_EQ(post(room, 0, MailKind::Pose, n), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Pose, 5), Posted::DroppedPose);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 6), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Pose, 7), Posted::DroppedPose);
  EXPECT_EQ(drain(room), (std::vector<std::int64_t>{1, 4, 5, 6, 7}));
}

TEST(MailRoom, BoundsSkeletonsToo) {
  MailRoom room(1, 2);
  for (std::size_t n = 0; n < kMaxWaitingSkeletons; ++n) {
    EXPECT_EQ(post(room, 0, MailKind::Skeleton, static_cast<std::int64_t>(n)), Posted::Kept);
  }
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 100), Posted::DroppedSkeleton);
  const auto stamps = drain(room);
  EXPECT_EQ(stamps.size(), kMaxWaitingSkeletons);
  EXPECT_EQ(stamps.front(), 1);
  EXPECT_EQ(stamps.back(), 100);
}

TEST(MailRoom, RefusesPosesOfSkeletonsThatNobodyHasSaid) {
  MailRoom room(1, 3);
  const auto pose = [&](std::int64_t hash) {
    auto mail = std::make_unique<Mail>();
    mail->pose.skeletonHash = hash;
    return room.post(0, mail);
  };
  EXPECT_EQ(pose(7), Posted::Kept);  // not asked yet
  drain(room);
  room.know(0, {});
  EXPECT_EQ(pose(7), Posted::TooEarly);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 7), Posted::Kept);
  EXPECT_EQ(pose(7), Posted::Kept);  // its skeleton waits
  std::size_t avatar = 0;
  auto mail = std::make_unique<Mail>();
  ASSERT_EQ(take(room, avatar, mail), Taken::Mail);
  ASSERT_EQ(mail->kind, MailKind::Skeleton);
  EXPECT_EQ(pose(7), Posted::Kept);  // ... is being handled
  room.know(0, {5, 7});
  room.finish(0);
  EXPECT_EQ(pose(5), Posted::Kept);
  EXPECT_EQ(pose(6), Posted::Unwanted);
  EXPECT_EQ(drain(room).size(), 3U);
  // A skeleton that was refused is nobody's.
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 6), Posted::Kept);
  drain(room);
  EXPECT_EQ(pose(6), Posted::Unwanted);
}

TEST(MailRoom, TakesASkeletonThatRepeatsTheLastWaitingOneOnce) {
  MailRoom room(1, 3);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 1), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Pose, 2), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 1), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 3), Posted::Kept);
  EXPECT_EQ(post(room, 0, MailKind::Skeleton, 1), Posted::Kept);  // says something again
  EXPECT_EQ(drain(room), (std::vector<std::int64_t>{1, 2, 3, 1}));
}

TEST(MailRoom, GivesAnAvatarToOneThreadAtATime) {
  MailRoom room(2, 10);
  post(room, 0, MailKind::Pose, 1);
  post(room, 0, MailKind::Pose, 2);
  post(room, 1, MailKind::Pose, 3);
  std::size_t first = 9, second = 9, third = 9;
  auto mail = std::make_unique<Mail>();
  ASSERT_EQ(take(room, first, mail), Taken::Mail);
  ASSERT_EQ(take(room, second, mail), Taken::Mail);
  EXPECT_NE(first, second);
  EXPECT_EQ(take(room, third, mail), Taken::Nothing);
  room.finish(1);
  EXPECT_EQ(take(room, third, mail), Taken::Nothing);
  room.finish(0);
  EXPECT_EQ(take(room, third, mail), Taken::Mail);
  EXPECT_EQ(third, 0u);
}

TEST(MailRoom, GivesOutWhatWaitsAfterItIsClosed) {
  MailRoom room(1, 10);
  post(room, 0, MailKind::Pose, 1);
  post(room, 0, MailKind::Pose, 2);
  room.close();
  EXPECT_EQ(post(room, 0, MailKind::Pose, 3), Posted::Closed);
  std::size_t avatar = 0;
  auto mail = std::make_unique<Mail>();
  ASSERT_EQ(take(room, avatar, mail), Taken::Mail);
  auto other = std::make_unique<Mail>();
  EXPECT_EQ(take(room, avatar, other), Taken::Nothing);  // more may become ready
  room.finish(0);
  ASSERT_EQ(take(room, avatar, mail), Taken::Mail);
  room.finish(0);
  EXPECT_EQ(take(room, avatar, mail), Taken::Closed);
}

TEST(MailRoom, KeepsEachAvatarsOrderWithManyThreads) {
  constexpr std::size_t kAvatars = 5;
  constexpr std::int64_t kEach = 500;
  MailRoom room(kAvatars, static_cast<std::size_t>(kEach));
  std::vector<std::int64_t> last(kAvatars, 0);  // guarded by the room: one thread an avatar
  std::atomic<int> outOfOrder{0};
  std::atomic<std::int64_t> handled{0};
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&] {
      auto mail = std::make_unique<Mail>();
      std::size_t avatar = 0;
      for (;;) {
        const Taken taken = take(room, avatar, mail);
        if (taken == Taken::Closed) return;
        if (taken == Taken::Nothing) continue;
        outOfOrder += mail->receiveUtimeUs != last[avatar] + 1;
        last[avatar] = mail->receiveUtimeUs;
        ++handled;
        room.finish(avatar);
      }
    });
  }
  for (std::int64_t n = 1; n <= kEach; ++n) {
    for (std::size_t avatar = 0; avatar < kAvatars; ++avatar) {
      post(room, avatar, MailKind::Pose, n);
    }
  }
  room.close();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(outOfOrder, 0);
  EXPECT_EQ(handled, kEach * static_cast<std::int64_t>(kAvatars));
}

// A leader and followers.

TEST(MailRoomLead, IsOneThreadsAtATimeAndComesAfterMail) {
  MailRoom room(2, 4, 1);
  std::size_t avatar = 9;
  auto mail = std::make_unique<Mail>();
  ASSERT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Lead);
  EXPECT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Nothing);
  post(room, 0, MailKind::Pose, 1);
  post(room, 1, MailKind::Pose, 2);
  room.endLead(false);
  ASSERT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Mail);
  EXPECT_EQ(mail->receiveUtimeUs, 1);
  // One handler is busy, and there may be no second one: who comes leads.
  ASSERT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Lead);
  EXPECT_EQ(take(room, avatar, mail), Taken::Nothing);
  room.finish(0);
  ASSERT_EQ(take(room, avatar, mail), Taken::Mail);
  EXPECT_EQ(mail->receiveUtimeUs, 2);
}

TEST(MailRoomLead, EndsForGood) {
  MailRoom room(1, 4, 1);
  std::size_t avatar = 9;
  auto mail = std::make_unique<Mail>();
  ASSERT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Lead);
  post(room, 0, MailKind::Pose, 7);
  room.endLead(true);
  room.waitForLastLead();  // at once
  ASSERT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Mail);
  EXPECT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Nothing);
  room.close();
  EXPECT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Nothing);  // one is handled
  room.finish(0);
  EXPECT_EQ(room.takeOrLead(avatar, mail, milliseconds(0)), Taken::Closed);
}

// Three threads take turns; each avatar's mail comes out once and in order, and never is more
// handled at a time than was said.
TEST(MailRoomLead, LosesNothingAmongThreads) {
  constexpr std::size_t kAvatars = 3;
  constexpr std::int64_t kMessages = 3000;
  MailRoom room(kAvatars, kMessages, 2);
  std::vector<std::vector<std::int64_t>> handled(kAvatars);
  std::atomic<std::int64_t> posted{0};
  std::atomic<int> busy{0}, most{0};
  const auto work = [&] {
    std::size_t avatar = 0;
    auto mail = std::make_unique<Mail>();
    for (;;) {
      const Taken taken = room.takeOrLead(avatar, mail, milliseconds(50));
      if (taken == Taken::Closed) return;
      if (taken == Taken::Lead) {
        const std::int64_t next = posted++;
        if (next < kMessages) {
          post(room, static_cast<std::size_t>(next) % kAvatars, MailKind::Pose, next);
        }
        room.endLead(next >= kMessages);
      }
      if (taken != Taken::Mail) continue;
      const int now = ++busy;
      if (now > most) most = now;
      handled[avatar].push_back(mail->receiveUtimeUs);
      --busy;
      room.finish(avatar);
    }
  };
  std::vector<std::thread> threads;
  for (int i = 0; i < 3; ++i) threads.emplace_back(work);
  room.waitForLastLead();
  room.close();
  for (std::thread& thread : threads) thread.join();
  for (std::size_t avatar = 0; avatar < kAvatars; ++avatar) {
    ASSERT_EQ(handled[avatar].size(), static_cast<std::size_t>(kMessages) / kAvatars);
    for (std::size_t i = 0; i < handled[avatar].size(); ++i) {
      ASSERT_EQ(handled[avatar][i], static_cast<std::int64_t>(avatar + i * kAvatars));
    }
  }
  EXPECT_LE(most, 2);
}

}  // namespace
}  // namespace foretouch
