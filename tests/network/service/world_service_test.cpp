// tests/network/service/world_service_test.cpp: a service with a moving world, from datagrams'
// payloads to events_t, status, metrics and journal; and what hostile senders do to it.
#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "network/service/metrics_text.h"
#include "tests/network/service/service_stage.h"
#include "tests/network/world_stream/small_world.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

const std::string kBodies = kBodyChannel;
const std::string kRigid = kRigidPoseChannel;
const std::string kEvents = kEventsChannel;
std::int64_t tick(std::int64_t n) {
  return kStart + n * kStepUs;
}

/// Avatars 0 to `avatars` - 1, as the stage has them.
WorldSolver worldOf(std::int32_t avatars, const WorldPolicy& policy = {}) {
  WorldSetup setup = smallWorld();
  for (std::int32_t id = 0; id < avatars; ++id) setup.avatars.push_back({id, 0});
  return WorldSolver::make(std::move(setup), policy).value();
}

/// The same with a wall at x = 1, and avatar 0 solid among all that moves.
WorldSolver solidWorldOf(std::int32_t avatars) {
  WorldSetup setup = smallWorld();
  setup.still = farWall();
  for (std::int32_t id = 0; id < avatars; ++id) setup.avatars.push_back({id, 0});
  setup.avatars[0].solid.emplace();
  return WorldSolver::make(std::move(setup), {}).value();
}

/// A stage whose service has a world.
class WorldStage : public Stage {
 public:
  explicit WorldStage(std::int32_t avatars, const WorldPolicy& policy = {}, int workers = 2)
      : Stage(avatars, withWorkers(workers), /*isRecorded=*/true, nullptr, false,
              worldOf(avatars, policy)) {}
  WorldStage(std::int32_t avatars, WorldSolver world)
      : Stage(avatars, withWorkers(2), /*isRecorded=*/true, nullptr, false, std::move(world)) {}

  void say(const BodyMessage& message, std::int64_t receiveUtimeUs, const UdpmSender& sender = {}) {
    ++said_;
    inbox->send(kBodies, bytesOf(message), receiveUtimeUs, sender);
  }
  void say(const RigidPoseMessage& message, const UdpmSender& sender = {}) {
    said_ += message.bodies.size();
    inbox->send(kRigid, bytesOf(message), message.utimeUs + 100, sender);
  }
  /// The nth pose of an avatar, with its hips there, captured at tick(n).
  void move(std::int32_t avatar, std::int64_t n, const Vector3d& hips) {
    PoseMessage pose = poseMessage(smallSkeleton(), n, tick(n));
    pose.avatar = avatar;
    pose.translations[0].translation = hips;
    inbox->send(kPoses, bytesOf(pose), tick(n) + 100);
  }
  /// True once the world was told of every state and pose that was said so far.
  bool isTold() {
    return eventually([&] {
      const WorldCounts counts = service().world()->counts;
      return counts.states + counts.rigidPoses == said_ && inbox->isEmpty();
    });
  }
  [[nodiscard]] std::vector<EventsMessage> answers() const {
    std::vector<EventsMessage> messages;
    for (const Bytes& payload : outbox->on(kEvents)) {
      messages.emplace_back();
      EXPECT_EQ(decode(payload, messages.back()), Reject::None);
    }
    return messages;
  }
  [[nodiscard]] std::vector<ToldEvent> events() const {
    std::vector<ToldEvent> all;
    for (const EventsMessage& answer : answers()) {
      all.insert(all.end(), answer.events.begin(), answer.events.end());
    }
    return all;
  }
  [[nodiscard]] std::uint64_t refused(Reject reason) {
    return service().world()->counts.rejects[static_cast<std::size_t>(reason)];
  }
  [[nodiscard]] std::string metrics() {
    const auto world = service().world();
    return metricsText(service().facts(), service().counts(), service().times(),
                       service().solidCounts(), &*world);
  }
  /// Of the status; -1: it has no such row.
  [[nodiscard]] std::int64_t statusOf(const std::string& name) {
    for (const StatusMessage::Count& count : service().status().counts) {
      if (count.reason == name) return count.count;
    }
    return -1;
  }

 private:
  std::uint64_t said_ = 0;
};

/// What the journal holds, told to fresh solvers in its order, gives what the journal holds.
void expectReplaysAlike(const WorldStage& stage, std::int32_t avatars, WorldSolver world) {
  std::vector<StreamSolver> streams = solversOf(avatars);
  std::vector<Bytes> recorded, replayed;
  std::vector<EventsMessage> answers;
  const auto keep = [&](const auto& message) {
    const Bytes bytes = bytesOf(message);
    const ByteView view = verdictBytes(bytes);
    replayed.emplace_back(view.data, view.data + view.size);
  };
  const auto advance = [&](Reject reason) {
    if (reason != Reject::None) return;
    world.advance(answers);
    for (const ShownBody& body : world.shown()) {
      keep(body.solid);
      keep(body.pushes);
    }
    for (const EventsMessage& answer : answers) keep(answer);
  };
  ContactsMessage contacts;
  for (const Recorded& event : stage.book->events()) {
    if (event.channel == kPoses) {
      PoseMessage pose;
      ASSERT_EQ(decode(event.payload, pose), Reject::None);
      StreamSolver& stream = streams[static_cast<std::size_t>(pose.avatar)];
      if (stream.take(pose, contacts) != Reject::None) continue;
      advance(world.take(pose.avatar, stream.lastStep(), event.utimeUs));
    } else if (event.channel == kSkeletons) {
      SkeletonMessage skeleton;
      ASSERT_EQ(decode(event.payload, skeleton), Reject::None);
      static_cast<void>(streams[static_cast<std::size_t>(skeleton.avatar)].take(skeleton));
    } else if (event.channel == kBodies) {
      BodyMessage body;
      ASSERT_EQ(decode(event.payload, body), Reject::None);
      advance(world.take(body, event.utimeUs));
    } else if (event.channel == kRigid) {
      RigidPoseMessage poses;
      ASSERT_EQ(decode(event.payload, poses), Reject::None);
      advance(world.take(poses, event.utimeUs));
    } else if (event.channel == kSpeakerChannel) {
      SpeakerMessage speaker;
      ASSERT_EQ(decode(event.payload, speaker), Reject::None);
      if (speaker.avatar < avatars) {
        streams[static_cast<std::size_t>(speaker.avatar)].changeSpeaker();
      } else {
        world.changeSpeaker(speaker.avatar);
      }
    } else if (event.channel == kEvents || event.channel == kSolidChannel ||
               event.channel == kPushesChannel) {
      const ByteView view = verdictBytes(event.payload);
      recorded.emplace_back(view.data, view.data + view.size);
    }
  }
  EXPECT_GT(recorded.size(), 3U);
  ASSERT_EQ(replayed.size(), recorded.size());
  EXPECT_EQ(replayed, recorded);
}

void expectReplaysAlike(const WorldStage& stage, std::int32_t avatars,
                        const WorldPolicy& policy = {}) {
  expectReplaysAlike(stage, avatars, worldOf(avatars, policy));
}

TEST(WorldService, ShowsSolidBodiesAndCountsWhatPressesAgainstThem) {
  WorldStage stage(2, solidWorldOf(2));
  stage.sendSkeletons(2);
  stage.say(ballMessage(10), tick(0));
  // Avatar 0 walks at the wall, and a ball flies at its hips; avatar 1 stands far away.
  for (std::int64_t n = 0; n <= 60; ++n) {
    stage.move(0, n, {0.03 * static_cast<double>(n), 1.0, 0.0});
    stage.move(1, n, {-5.0, 1.0, 3.0});
    const double x = 0.05 * static_cast<double>(n) - 2.5;
    stage.say(rigidPoses(n, tick(n), {ballAt(10, {x, 1.1, 0.0})}));
    if (n % 8 != 0) continue;
    ASSERT_TRUE(stage.isTold());
    ASSERT_TRUE(stage.settles(static_cast<std::uint64_t>(2 * (n + 1))));
  }
  ASSERT_TRUE(stage.settles(2 * 61));
  ASSERT_TRUE(stage.isTold());
  const std::string metrics = stage.metrics();
  const SolidCounts counts = stage.service().solidCounts();
  stage.service().stop();
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 122U) << "every accepted pose has its answer";
  const std::vector<Bytes> solids = stage.outbox->on(kSolidChannel);
  EXPECT_GE(solids.size(), 55U);
  EXPECT_EQ(stage.outbox->on(kPushesChannel).size(), solids.size());
  int held = 0;
  for (const Bytes& payload : solids) {
    SolidMessage message;
    ASSERT_EQ(decode(payload, message), Reject::None);
    EXPECT_EQ(message.avatar, 0);
    EXPECT_LT(message.shown().translations[0].x(), 1.0);
    held += message.contacts.empty() ? 0 : 1;
  }
  EXPECT_GT(held, 10);
  ASSERT_EQ(counts.avatars.size(), 1U);
  EXPECT_EQ(counts.avatars[0].avatar, 0);
  EXPECT_NE(metrics.find("\nforetouch_solid_poses_total{avatar=\"0\",state=\"equal\"} "),
            std::string::npos);
  EXPECT_NE(metrics.find("\nforetouch_solid_crushed_total{avatar=\"0\"} "), std::string::npos);
  const auto isOfWall = [](const ToldEvent& told) {
    return told.event.kind == EventKind::Enter && told.event.a.body == 0 &&
           told.event.b.body == kStillScene;
  };
  const std::vector<ToldEvent> events = stage.events();
  EXPECT_TRUE(std::any_of(events.begin(), events.end(), isOfWall));
  expectReplaysAlike(stage, 2, solidWorldOf(2));
}

TEST(WorldService, RefusesAnAvatarThatIsSolidTwice) {
  ServiceParts parts;
  parts.receiver = std::make_unique<FakeReceiver>(std::make_shared<Inbox>());
  parts.publisher = std::make_unique<FakePublisher>(std::make_shared<Outbox>());
  parts.world = solidWorldOf(1);
  const auto started = Service::start(solversOf(1, /*areSolid=*/true), std::move(parts), {});
  ASSERT_FALSE(started.ok());
  EXPECT_NE(describe(started.error()).find("expected avatar 0 to be solid by itself, or in the"),
            std::string::npos);
}

TEST(WorldService, TellsOfBodiesThatComeAndGoAmongAvatars) {
  WorldStage stage(2);
  stage.sendSkeletons(2);
  stage.say(ballMessage(10), tick(0));
  // The ball comes from afar, through avatar 0's hips at x = 0, and is gone inside of avatar 1's.
  for (std::int64_t n = 0; n <= 40; ++n) {
    stage.move(0, n, {0.0, 1.0, 0.0});
    stage.move(1, n, {0.8, 1.0, 3.0});
    stage.say(rigidPoses(n, tick(n), {ballAt(10, {0.1 * static_cast<double>(n) - 2.0, 1.1, 0.0})}));
    if (n % 8 == 0) {
      ASSERT_TRUE(stage.isTold());
      ASSERT_TRUE(stage.settles(static_cast<std::uint64_t>(2 * (n + 1))));
    }
  }
  BodyMessage gone = ballMessage(10, 1);
  gone.isPresent = false;
  gone.utimeUs = gone.sinceUs = tick(40) + 1;
  stage.say(gone, tick(41));
  for (std::int64_t n = 41; n <= 50; ++n) {
    stage.move(0, n, {0.0, 1.0, 0.0});
    stage.move(1, n, {0.8, 1.0, 3.0});
  }
  ASSERT_TRUE(stage.settles(2 * 51));
  ASSERT_TRUE(stage.isTold());
  stage.service().stop();
  int entered = 0, left = 0, farewells = 0;
  std::string text;
  for (const ToldEvent& told : stage.events()) {
    if (told.event.a.body != 10 && told.event.b.body != 10) continue;
    text += std::string(toString(told.event.kind)) + " of " + std::to_string(told.event.a.body) +
            ":" + std::to_string(told.event.a.link) + " and " + std::to_string(told.event.b.body) +
            ":" + std::to_string(told.event.b.link) + " at " + std::to_string(told.event.time.us) +
            ", cause " + std::to_string(static_cast<int>(told.cause)) + "\n";
    const bool begins =
        told.event.kind == EventKind::Enter || told.event.kind == EventKind::StartsInside;
    entered += begins ? 1 : 0;
    // Once it is gone it says so, whoever it was in contact with.
    const bool isGone = told.cause == ToldCause::BodyGone;
    farewells += isGone ? 1 : 0;
    left += told.event.kind == EventKind::Leave && !isGone ? 1 : 0;
  }
  EXPECT_GE(entered, 1);
  EXPECT_EQ(left, entered) << text;
  EXPECT_EQ(farewells, 1) << text;
  const std::vector<EventsMessage> answers = stage.answers();
  for (std::size_t i = 1; i < answers.size(); ++i) {
    EXPECT_EQ(answers[i].sequence, answers[i - 1].sequence + 1);
    EXPECT_EQ(answers[i].fromUs,
              answers[i - 1].hasMore ? answers[i - 1].fromUs : answers[i - 1].toUs);
  }
  const auto isThere = [](const EventsMessage& answer) {
    return std::any_of(answer.bodies.begin(), answer.bodies.end(),
                       [](const ToldBody& body) { return body.body == 10; });
  };
  EXPECT_TRUE(std::any_of(answers.begin(), answers.end(), isThere));
  EXPECT_FALSE(isThere(answers.back()));
  EXPECT_EQ(stage.service().counts().answered, 102U);  // every accepted pose_t has its contacts_t
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 102U);
  expectReplaysAlike(stage, 2);
}

TEST(WorldService, GoesOnWithoutOneSilentSenderAmongTenAndSaysSo) {
  WorldPolicy policy;
  policy.waitUs = 5 * kStepUs;
  WorldStage stage(1, policy, 1);
  for (BodyNumber body = 10; body < 20; ++body) stage.say(ballMessage(body), tick(0));
  for (std::int64_t n = 0; n <= 40; ++n) {
    for (BodyNumber body = 10; body < 20; ++body) {
      if (body == 14 && n > 10) continue;
      stage.say(
          rigidPoses(n, tick(n), {ballAt(body, {static_cast<double>(body), 0.0, 0.0})}, body + 1));
    }
    ASSERT_TRUE(stage.isTold());
    // Avatar 0 never says anything: it is not there yet, and nobody waits for it.
    if (n > 16) {
      EXPECT_GE(stage.service().world()->counts.answeredUntilUs, tick(n - 6)) << n;
    }
  }
  const WorldCounts counts = stage.service().world()->counts;
  EXPECT_EQ(counts.answeredUntilUs, tick(40));
  EXPECT_EQ(counts.silences, 1U);
  EXPECT_EQ(counts.silent, 1U);
  EXPECT_EQ(stage.statusOf("world-silences"), 1);
  EXPECT_NE(stage.metrics().find("\nforetouch_world_silences_total 1\n"), std::string::npos);
  EXPECT_NE(stage.metrics().find("\nforetouch_world_silent 1\n"), std::string::npos);
  // Who is silent, and since when, is in every answer.
  const EventsMessage last = stage.answers().back();
  std::vector<BodyNumber> unknown;
  for (const UnknownPart& part : last.unknown) unknown.push_back(part.body);
  EXPECT_EQ(std::count(unknown.begin(), unknown.end(), 14), 1);
  for (const ToldBody& body : last.bodies) {
    EXPECT_TRUE(body.body < 10 || body.isWaitedFor == (body.body != 14)) << body.body;
  }
  stage.service().stop();
  expectReplaysAlike(stage, 1, policy);
}

/// A clock that stands holds nobody up; one that jumps ahead hurries nobody.
TEST(WorldService, NoClockStallsOrHurriesTheWatermark) {
  WorldPolicy policy;
  policy.waitUs = 5 * kStepUs;
  WorldStage stage(1, policy, 1);
  for (BodyNumber body = 10; body < 13; ++body) stage.say(ballMessage(body), tick(0));
  const auto place = [](BodyNumber body) { return Vector3d(static_cast<double>(body), 0.0, 0.0); };
  for (std::int64_t n = 0; n <= 40; ++n) {
    stage.say(rigidPoses(n, tick(n), {ballAt(10, place(10))}, 1));
    // Eleven's clock crawls: a microsecond per message. Twelve's is two hours ahead.
    RigidPoseMessage slow = rigidPoses(n, tick(0) + n, {ballAt(11, place(11))}, 2);
    RigidPoseMessage fast = rigidPoses(n, tick(n) + 7'200'000'000, {ballAt(12, place(12))}, 3);
    stage.say(slow);
    fast.sendUtimeUs = tick(n);
    stage.inbox->send(kRigid, bytesOf(fast), tick(n) + 200);
    const auto isTold = [&] {
      const WorldCounts counts = stage.service().world()->counts;
      return counts.rigidPoses == static_cast<std::uint64_t>(3 * (n + 1)) && stage.inbox->isEmpty();
    };
    ASSERT_TRUE(eventually(isTold));
    const std::int64_t answered = stage.service().world()->counts.answeredUntilUs;
    EXPECT_LE(answered, tick(n));
    if (n > 8) {
      EXPECT_GE(answered, tick(n - 6)) << n;
    }
  }
  EXPECT_EQ(stage.refused(Reject::FutureStamp), 41U);
  EXPECT_GT(stage.refused(Reject::Late), 20U);
  EXPECT_EQ(stage.statusOf("world-refused-future-stamp"), 41);
  stage.service().stop();
  expectReplaysAlike(stage, 1, policy);
}

TEST(WorldService, NamesEveryRefusal) {
  WorldPolicy policy;
  policy.maxBodies = 5;
  WorldStage stage(1, policy, 1);
  const auto body = [&](BodyMessage message, Reject expected) {
    const std::uint64_t before = stage.refused(expected);
    stage.say(message, tick(0));
    ASSERT_TRUE(stage.isTold());
    EXPECT_EQ(stage.refused(expected), before + 1) << toString(expected);
  };
  const auto poses = [&](RigidPoseMessage message, Reject expected) {
    const std::uint64_t before = stage.refused(expected);
    stage.say(message);
    ASSERT_TRUE(stage.isTold());
    EXPECT_EQ(stage.refused(expected), before + message.bodies.size()) << toString(expected);
  };
  const auto bytes = [&](const std::string& channel, Bytes payload, Reject expected) {
    const std::uint64_t before = stage.refused(expected);
    stage.inbox->send(channel, std::move(payload), tick(0));
    ASSERT_TRUE(eventually([&] { return stage.refused(expected) == before + 1; }))
        << toString(expected);
  };
  BodyMessage message = ballMessage(7);
  message.shape = "cube";
  body(message, Reject::UnknownShape);
  message = ballMessage(7);
  message.shapeHash = 1;
  body(message, Reject::BadHash);
  stage.say(ballMessage(7, 5, 2), tick(0));
  ASSERT_TRUE(stage.isTold());
  body(ballMessage(7, 5, 2), Reject::Duplicate);
  body(ballMessage(7, 4, 2), Reject::OutOfOrder);
  body(ballMessage(7, 5, 1), Reject::OldSession);
  message = ballMessage(8);
  message.carrier = 99;
  body(message, Reject::UnknownBody);
  message.carrier = 7;
  stage.say(message, tick(0));
  ASSERT_TRUE(stage.isTold());
  message = ballMessage(7, 6, 2);
  message.carrier = 8;
  body(message, Reject::CarrierLoop);
  stage.say(ballMessage(9), tick(0));
  stage.say(ballMessage(10), tick(0));
  ASSERT_TRUE(stage.isTold());
  body(ballMessage(11), Reject::Limit);
  poses(rigidPoses(0, tick(0), {ballAt(50, Vector3d::Zero())}), Reject::UnknownBody);
  poses(rigidPoses(0, tick(0), {ballAt(8, Vector3d::Zero())}), Reject::HeldFast);
  const Bytes ahead = bytesOf(rigidPoses(0, tick(1000), {ballAt(7, Vector3d::Zero())}));
  bytes(kRigid, ahead, Reject::FutureStamp);
  Bytes whole = bytesOf(rigidPoses(1, tick(1), {ballAt(7, Vector3d::Zero())}));
  Bytes cut(whole.begin(), whole.end() - 3);
  bytes(kRigid, cut, Reject::Length);
  Bytes other = whole;
  other[0] ^= 1;
  bytes(kRigid, other, Reject::Fingerprint);
  RigidPoseMessage nan = rigidPoses(1, tick(1), {ballAt(7, Vector3d::Zero())});
  nan.bodies[0].pose.translation.x() = std::numeric_limits<double>::quiet_NaN();
  bytes(kRigid, bytesOf(nan), Reject::NonFinite);
  RigidPoseMessage bent = rigidPoses(1, tick(1), {ballAt(7, Vector3d::Zero())});
  bent.bodies[0].pose.rotation = Quaternion(2.0, 0.0, 0.0, 0.0);
  bytes(kRigid, bytesOf(bent), Reject::NonUnit);
  // Each word is in the status and in the metrics.
  const std::string metrics = stage.metrics();
  const WorldCounts counts = stage.service().world()->counts;
  int words = 0;
  for (std::size_t i = 1; i < kNumRejects; ++i) {
    if (counts.rejects[i] == 0) continue;
    ++words;
    const std::string word = toString(static_cast<Reject>(i));
    EXPECT_EQ(stage.statusOf("world-refused-" + word),
              static_cast<std::int64_t>(counts.rejects[i]));
    EXPECT_NE(metrics.find("foretouch_world_refused_total{reason=\"" + word + "\"} " +
                           std::to_string(counts.rejects[i]) + "\n"),
              std::string::npos)
        << word;
  }
  EXPECT_GE(words, 13);
}

/// Random bytes, cut and bent messages, floods of bodies: nothing is lost of what is right.
TEST(WorldService, NobodyTakesAllPlaces) {
  WorldPolicy policy;
  policy.maxBodies = 33;  // one is the avatar's
  WorldStage stage(1, policy, 1);
  BodyNumber next = 100;
  std::vector<std::size_t> places;
  for (std::uint16_t sender = 1; sender <= 4; ++sender) {
    const std::size_t before = stage.service().world()->counts.bodies;
    for (int i = 0; i < 40; ++i) stage.say(ballMessage(next++), tick(0), {0x0100007F, sender});
    ASSERT_TRUE(stage.isTold());
    places.push_back(stage.service().world()->counts.bodies - before);
  }
  EXPECT_EQ(places, (std::vector<std::size_t>{16, 8, 4, 2}));
  EXPECT_EQ(stage.refused(Reject::Limit), 160U - 30U);
  EXPECT_EQ(stage.service().world()->counts.states, 160U);
}

TEST(WorldService, AnAvatarsAnswersDoNotWaitForTheWorld) {
  // The world is busy for as long as its events are not sent.
  WorldStage stage(1, {}, 1);
  stage.sendSkeletons(1);
  for (const BodyNumber body : {7, 8}) stage.say(ballMessage(body), tick(0));
  for (std::int64_t n = 0; n < 2; ++n) {
    stage.say(rigidPoses(n, tick(n), {ballAt(7, Vector3d::Zero()), ballAt(8, Vector3d::Zero())}));
    stage.move(0, n, Vector3d(0.0, 5.0, 0.0));
  }
  ASSERT_TRUE(stage.isTold() && stage.settles(2));
  stage.outbox->worldsGate.set(false);
  for (std::int64_t n = 2; n < 40; ++n) {
    stage.say(rigidPoses(n, tick(n), {ballAt(7, Vector3d::Zero()), ballAt(8, Vector3d::Zero())}));
    stage.move(0, n, Vector3d(0.0, 5.0, 0.0));
  }
  EXPECT_TRUE(stage.settles(40)) << "they wait for the world";
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 40U);
  EXPECT_EQ(stage.outbox->worldsGate.held(), 1) << "the world is busy";
  EXPECT_GT(stage.service().world()->counts.advances, 0U) << "and yet it can be looked at";
  stage.outbox->worldsGate.set(true);
  ASSERT_TRUE(stage.isTold());
  stage.service().stop();
  expectReplaysAlike(stage, 1, {});
}

TEST(WorldService, HostileMessagesHarmNobody) {
  WorldPolicy policy;
  policy.maxBodies = 20;
  WorldStage stage(1, policy, 2);
  std::mt19937_64 random(7);
  const auto below = [&](std::uint64_t end) { return random() % end; };
  stage.say(ballMessage(10), tick(0));
  stage.say(ballMessage(11), tick(0));
  const double wild[] = {std::numeric_limits<double>::quiet_NaN(),
                         std::numeric_limits<double>::infinity(), 1e300, -1e9, 0.5};
  for (std::int64_t n = 0; n <= 200; ++n) {
    const double x = 0.5 * static_cast<double>(n % 8) - 2.0;
    stage.inbox->send(
        kRigid,
        bytesOf(rigidPoses(n, tick(n), {ballAt(10, Vector3d::Zero()), ballAt(11, {x, 0.0, 0.0})})),
        tick(n) + 100);
    for (int bad = 0; bad < 20; ++bad) {
      Bytes payload;
      std::string channel = below(2) == 0 ? kRigid : kBodies;
      if (below(3) == 0) {
        payload.resize(below(400));
        for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random());
      } else if (channel == kBodies) {
        BodyMessage message = ballMessage(static_cast<BodyNumber>(below(1000)) + 20,
                                          static_cast<std::int64_t>(random() >> below(60)), 5);
        message.carrier = static_cast<BodyNumber>(below(40));
        message.carrierLink = static_cast<std::int32_t>(below(5));
        message.pose.translation.y() = wild[below(5)];
        message.sinceUs = tick(static_cast<std::int64_t>(below(300)));
        payload = bytesOf(message);
      } else {
        RigidPoseMessage message = rigidPoses(
            static_cast<std::int64_t>(below(1000)), tick(static_cast<std::int64_t>(below(400))),
            {ballAt(static_cast<BodyNumber>(below(60)) + 12, {wild[below(5)], 0.0, 0.0})}, 9);
        payload = bytesOf(message);
      }
      if (!payload.empty() && below(4) == 0) {
        std::uint8_t& byte = payload[below(payload.size())];
        byte = static_cast<std::uint8_t>(byte ^ (1U << below(8)));
      }
      if (!payload.empty() && below(6) == 0) payload.resize(below(payload.size()));
      stage.inbox->send(channel, std::move(payload), tick(n) + 150);
    }
    ASSERT_TRUE(eventually([&] { return stage.inbox->isEmpty(); }));
  }
  ASSERT_TRUE(eventually([&] { return stage.service().world()->counts.taken >= 2 * 201U; }))
      << stage.service().world()->counts.taken;
  EXPECT_FALSE(stage.service().failure().has_value());
  const WorldCounts counts = stage.service().world()->counts;
  EXPECT_LE(counts.bodies, 20U);
  EXPECT_GT(counts.rejected(), 1000U);
  EXPECT_EQ(counts.failures, 0U);
  stage.service().stop();
  // The two told the truth at all times, and what happens between them is told: none of it marked.
  int entered = 0;
  for (const ToldEvent& told : stage.events()) {
    if (told.event.a.body != 10 || told.event.b.body != 11) continue;
    entered += told.event.kind == EventKind::Enter ? 1 : 0;
    EXPECT_FALSE(told.event.isAssumed);
  }
  EXPECT_GE(entered, 20);
  expectReplaysAlike(stage, 1, policy);
}

/// Whoever takes over a body that is an avatar takes over no pose_t: a replay hears of none.
TEST(WorldService, OneWhoSpeaksOfAnAvatarsBodyChangesNothingOfItsStream) {
  WorldStage stage(1, {}, 1);
  stage.sendSkeletons(1);
  const UdpmSender first{1, 1}, second{2, 2};
  BodyMessage avatar = ballMessage(0);
  avatar.shape = "dancer";
  avatar.kind = BodyMessageKind::Avatar;
  stage.say(avatar, tick(0), first);
  for (std::int64_t n = 0; n <= 10; ++n) stage.move(0, n, {0.0, 1.0, 0.1 * static_cast<double>(n)});
  ASSERT_TRUE(stage.settles(11));
  avatar.session = 2;
  stage.say(avatar, tick(100'000), second);  // a quarter of an hour later
  ASSERT_TRUE(stage.isTold());
  stage.service().stop();
  for (const Recorded& event : stage.book->events()) EXPECT_NE(event.channel, kSpeakerChannel);
  expectReplaysAlike(stage, 1);
}

}  // namespace
}  // namespace foretouch::test
