// What a service believes, and what neither strangers nor a disk can keep it from.
#include <chrono>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "network/service/service.h"
#include "network/wire/message_key.h"
#include "tests/network/service/service_stage.h"

namespace foretouch {
namespace {

using std::chrono::milliseconds;
using test::eventually;
using test::kContacts;
using test::kPoses;
using test::kSkeletons;
using test::poseOf;
using test::rejectsFor;
using test::skeletonOf;
using test::Stage;
using test::withWorkers;

constexpr UdpmSender kTrue{0x0100007f, 1000}, kOther{0x0100007f, 2000};

Bytes garbageOf(std::int64_t sequence) {
  PoseMessage message = test::nthPose(sequence);
  ++message.skeletonHash;
  return test::bytesOf(message);
}

// A mailbox of four, its stream at work for as long as the test likes: a thousand poses of nobody's
// skeleton take no place, where one more true pose would push out the oldest.
TEST(ServiceTrust, GarbageTakesNoPlaceInAMailbox) {
  Stage stage(1, withWorkers(1, 4));
  stage.outbox->gate.set(false);
  stage.sendSkeletons(1);
  stage.inbox->send(kPoses, poseOf(0, 1));
  ASSERT_TRUE(eventually([&] { return stage.outbox->gate.held() == 1; }));
  for (std::int64_t n = 2; n <= 5; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  for (std::int64_t n = 0; n < 1000; ++n) stage.inbox->send(kPoses, garbageOf(n));
  ASSERT_TRUE(eventually([&] { return stage.service().counts().received == 1005; }));
  stage.outbox->gate.set(true);
  ASSERT_TRUE(stage.settles(1005));
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 5U);
  EXPECT_EQ(rejectsFor(stage.service().counts(), Reject::SkeletonMismatch), 1000U);
  EXPECT_EQ(rejectsFor(stage.service().counts(), Reject::Overrun), 0U);
}

TEST(ServiceTrust, OtherSendersTakeNoPlaceAndNoStream) {
  Stage stage(1, withWorkers(1), true);
  stage.inbox->send(kSkeletons, skeletonOf(0), 1, kTrue);
  for (std::int64_t n = 1; n <= 100; ++n) {
    stage.inbox->send(kPoses, poseOf(0, n), n * 1000, kTrue);
    if (n < 5) continue;
    for (std::int64_t k = 0; k < 20; ++k) {
      stage.inbox->send(kPoses, poseOf(0, n * 1000 + k), n * 1000, kOther);
    }
  }
  ASSERT_TRUE(stage.settles(100 + 96 * 20));
  const ServiceCounts counts = stage.service().counts();
  EXPECT_EQ(counts.answered, 100U);
  EXPECT_EQ(rejectsFor(counts, Reject::OtherSender), 96U * 20);
  EXPECT_EQ(counts.gaps, 0U);
  stage.service().stop();
  std::size_t poses = 0;
  for (const test::Recorded& event : stage.book->events()) poses += event.channel == kPoses;
  EXPECT_EQ(poses, 100U);
}

MessageKey someKey(std::uint8_t first = 1) {
  return MessageKey({first, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
}

TEST(ServiceTrust, WithAKeyNothingIsTakenWithoutIt) {
  ServiceOptions options = withWorkers(1);
  options.key = someKey();
  Stage stage(1, options, true);
  constexpr std::int64_t kNowUs = 100'000'000;
  std::int64_t sentUs = kNowUs;
  const auto sealed = [&](const std::string& channel, Bytes payload, const MessageKey& key) {
    key.sign(channel, ++sentUs, payload);
    return payload;
  };
  const Bytes first = sealed(kPoses, poseOf(0, 1), someKey());
  stage.inbox->send(kSkeletons, skeletonOf(0), kNowUs);
  stage.inbox->send(kSkeletons, sealed(kSkeletons, skeletonOf(0), someKey()), kNowUs);
  stage.inbox->send(kPoses, first, kNowUs);
  stage.inbox->send(kPoses, sealed(kPoses, poseOf(0, 2), someKey()), kNowUs);
  ASSERT_TRUE(stage.settles(2));
  stage.inbox->send(kPoses, first, kNowUs);                                       // replayed
  stage.inbox->send(kPoses, poseOf(0, 3), kNowUs);                                // not signed
  stage.inbox->send(kPoses, sealed(kPoses, poseOf(0, 3), someKey(9)), kNowUs);    // another key
  stage.inbox->send(kPoses, sealed(kContacts, poseOf(0, 3), someKey()), kNowUs);  // another channel
  const std::int64_t lateUs = sentUs + kMostSignatureAgeUs + 2;
  stage.inbox->send(kPoses, sealed(kPoses, poseOf(0, 3), someKey()), lateUs);
  ASSERT_TRUE(stage.settles(7));
  const ServiceCounts counts = stage.service().counts();
  EXPECT_EQ(counts.answered, 2U);
  EXPECT_EQ(rejectsFor(counts, Reject::Replayed), 2U);
  EXPECT_EQ(rejectsFor(counts, Reject::Unauthenticated), 3U);
  EXPECT_EQ(counts.skeletonRejects[static_cast<std::size_t>(Reject::Unauthenticated)], 1U);

  // What it says is signed; what it records is as without a key.
  std::int64_t lastUs = 0;
  for (const Bytes& payload : stage.outbox->on(kContacts)) {
    SignedPayload opened;
    ASSERT_EQ(someKey().open(kContacts, payload, opened), Reject::None);
    ContactsMessage answer;
    EXPECT_EQ(decode(opened.content, answer), Reject::None);
    EXPECT_GT(opened.sentUtimeUs, lastUs);
    lastUs = opened.sentUtimeUs;
  }
  stage.service().stop();
  for (const test::Recorded& event : stage.book->events()) {
    EXPECT_EQ(withoutSignature(event.payload).size, event.payload.size());
  }
}

TEST(ServiceTrust, WithoutAKeySignedMessagesAreTakenAsWell) {
  Stage stage(1, withWorkers(1));
  Bytes skeleton = skeletonOf(0), pose = poseOf(0, 1);
  someKey().sign(kSkeletons, 1, skeleton);
  someKey().sign(kPoses, 2, pose);
  stage.inbox->send(kSkeletons, skeleton);
  stage.inbox->send(kPoses, pose);
  ASSERT_TRUE(stage.settles(1));
  EXPECT_EQ(stage.service().counts().answered, 1U);
}

TEST(ServiceTrust, ADiskThatStallsHarmsNothingButTheLog) {
  ServiceOptions options = withWorkers(1);
  options.stuckAfter = milliseconds(3000);  // of a busy machine's threads
  options.journal.closeWithin = milliseconds(200);
  Stage stage(1, options, true);
  stage.book->gate.set(false);
  stage.sendSkeletons(1);
  for (std::int64_t n = 1; n <= 50; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(stage.settles(50));
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 50U);
  ASSERT_TRUE(eventually([&] {
    return stage.service().health().text.find("degraded: the log") != std::string::npos;
  }));
  EXPECT_TRUE(stage.service().health().isWell);
  EXPECT_TRUE(stage.service().health().isAlive);
  stage.service().stop();  // ends
  EXPECT_GT(stage.service().counts().journalFailures, 50U);
  EXPECT_NE(stage.service().journalFailure().find("is not closed"), std::string::npos);
  stage.book->gate.set(true);  // for the thread that was left behind
}

TEST(ServiceTrust, PosesThatAreAllRefusedAreIllHealth) {
  ServiceOptions options = withWorkers(1);
  options.unacceptedAfter = milliseconds(100);
  Stage stage(1, options);
  stage.sendSkeletons(1);
  std::int64_t sent = 0;
  const auto isRefusing = [&] {
    stage.inbox->send(kPoses, garbageOf(sent++));
    return stage.service().health().text.find("refusing: poses have come") != std::string::npos;
  };
  ASSERT_TRUE(eventually(isRefusing));
  const ServiceHealth health = stage.service().health();
  EXPECT_FALSE(health.isWell);
  EXPECT_TRUE(health.isAlive);  // no sender can make a watchdog end the service
  stage.inbox->send(kPoses, poseOf(0, 1));
  ASSERT_TRUE(eventually([&] { return stage.service().health().isWell; }));
  // Poses of avatars of other services are nobody's fault.
  for (int i = 0; i < 50; ++i) {
    stage.inbox->send(kPoses, poseOf(77, i));
    std::this_thread::sleep_for(milliseconds(5));
  }
  EXPECT_TRUE(stage.service().health().isWell);
}

}  // namespace
}  // namespace foretouch
