#include "network/service/service.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "middleware/query_options.h"
#include "network/wire/codec.h"
#include "tests/network/service/service_stage.h"
#include "tests/network/small_stream.h"

namespace foretouch {
namespace {

using test::answerIn;
using test::bytesOf;
using test::eventually;
using test::kContacts;
using test::kPoses;
using test::kSkeletons;
using test::kStepUs;
using test::poseOf;
using test::rejectsFor;
using test::skeletonOf;
using test::smallAvatar;
using test::smallSkeleton;
using test::solversOf;
using test::Stage;
using test::withWorkers;

Bytes verdictsIn(const Bytes& payload) {
  const ByteView view = verdictBytes(payload);
  return {view.data, view.data + view.size};
}

bool addUp(const ServiceCounts& counts) {
  return counts.received == counts.answered + counts.rejected() + counts.waiting;
}

struct Sent {
  std::string channel;
  Bytes payload;
};

/// Streams of several avatars, mixed, with messages that are refused for many reasons.
std::vector<Sent> mixedStreams(std::int32_t avatars, int messages, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<std::int64_t> next(static_cast<std::size_t>(avatars), 1);
  std::vector<Sent> sent;
  for (std::int32_t id = 0; id < avatars; ++id) sent.push_back({kSkeletons, skeletonOf(id)});
  for (int i = 0; i < messages; ++i) {
    const auto id = static_cast<std::int32_t>(random() % static_cast<std::uint32_t>(avatars));
    std::int64_t& sequence = next[static_cast<std::size_t>(id)];
    switch (random() % 12) {
      case 0: sent.push_back({kPoses, poseOf(id, std::max<std::int64_t>(1, sequence - 2))}); break;
      case 1: sequence += 3; break;
      case 2: {
        Bytes broken = poseOf(id, sequence);
        broken[random() % broken.size()] ^= static_cast<std::uint8_t>(1u << (random() % 8));
        sent.push_back({kPoses, std::move(broken)});
        break;
      }
      case 3: sent.push_back({kPoses, poseOf(avatars + id, sequence)}); break;
      case 4: sent.push_back({kSkeletons, skeletonOf(id)}); break;
      default: sent.push_back({kPoses, poseOf(id, sequence++)});
    }
  }
  return sent;
}

/// The same through fresh solvers, one message after another.
std::map<std::int32_t, std::vector<Bytes>> verdictsOneByOne(const std::vector<Sent>& sent,
                                                            std::int32_t avatars) {
  std::vector<StreamSolver> solvers = solversOf(avatars);
  std::map<std::int32_t, std::vector<Bytes>> verdicts;
  for (const Sent& message : sent) {
    PoseMessage pose;
    SkeletonMessage skeleton;
    ContactsMessage answer;
    if (message.channel == kSkeletons) {
      if (decode(message.payload, skeleton) != Reject::None) continue;
      if (skeleton.avatar < 0 || skeleton.avatar >= avatars) continue;
      static_cast<void>(solvers[static_cast<std::size_t>(skeleton.avatar)].take(skeleton));
    } else if (message.channel == kPoses && decode(message.payload, pose) == Reject::None) {
      if (pose.avatar < 0 || pose.avatar >= avatars) continue;
      StreamSolver& solver = solvers[static_cast<std::size_t>(pose.avatar)];
      if (solver.take(pose, answer) != Reject::None) continue;
      verdicts[pose.avatar].push_back(verdictsIn(bytesOf(answer)));
    }
  }
  return verdicts;
}

std::map<std::int32_t, std::vector<Bytes>> verdictsByAvatar(const std::vector<Bytes>& answers) {
  std::map<std::int32_t, std::vector<Bytes>> verdicts;
  for (const Bytes& payload : answers) {
    verdicts[answerIn(payload).avatar].push_back(verdictsIn(payload));
  }
  return verdicts;
}

/// Without a print of every byte where they differ.
testing::AssertionResult same(const std::map<std::int32_t, std::vector<Bytes>>& got,
                              const std::map<std::int32_t, std::vector<Bytes>>& expected) {
  if (got == expected) return testing::AssertionSuccess();
  auto failure = testing::AssertionFailure();
  for (const auto& [avatar, verdicts] : expected) {
    const auto found = got.find(avatar);
    const std::vector<Bytes> theirs = found == got.end() ? std::vector<Bytes>() : found->second;
    const std::size_t both = std::min(theirs.size(), verdicts.size());
    std::size_t n = 0;
    while (n < both && theirs[n] == verdicts[n]) ++n;
    failure << "avatar " << avatar << ": " << theirs.size() << " answers, expected "
            << verdicts.size() << ", the first " << n << " alike\n";
  }
  return failure;
}

std::uint64_t posesIn(const std::vector<Sent>& sent) {
  return static_cast<std::uint64_t>(
      std::count_if(sent.begin(), sent.end(), [](const Sent& s) { return s.channel == kPoses; }));
}

// Oracle: the same messages through StreamSolver in one thread.
TEST(Service, AnswersEveryAcceptedPoseOnceAndInOrderOnAnyNumberOfWorkers) {
  constexpr std::int32_t kAvatars = 5;
  const std::vector<Sent> sent = mixedStreams(kAvatars, 1500, 1);
  const auto expected = verdictsOneByOne(sent, kAvatars);
  for (const int workers : {1, 2, 4}) {
    SCOPED_TRACE(workers);
    Stage stage(kAvatars, withWorkers(workers));
    for (const Sent& message : sent) stage.inbox->send(message.channel, message.payload);
    ASSERT_TRUE(stage.settles(posesIn(sent)));
    EXPECT_TRUE(same(verdictsByAvatar(stage.outbox->on(kContacts)), expected));
    const ServiceCounts counts = stage.service().counts();
    EXPECT_TRUE(addUp(counts));
    EXPECT_EQ(counts.answered, stage.outbox->on(kContacts).size());
    EXPECT_GT(counts.answered, posesIn(sent) / 2);
    EXPECT_GT(counts.gaps, 0u);
    EXPECT_GT(counts.lost, counts.gaps);
    EXPECT_GT(rejectsFor(counts, Reject::UnknownAvatar), 0u);
    EXPECT_EQ(rejectsFor(counts, Reject::Overrun), 0u);
    EXPECT_GT(counts.rejected(), rejectsFor(counts, Reject::UnknownAvatar));
  }
}

/// The shown poses that were sent, by avatar, without what differs between runs.
std::map<std::int32_t, std::vector<Bytes>> shownByAvatar(const std::vector<Bytes>& payloads) {
  std::map<std::int32_t, std::vector<Bytes>> shown;
  for (const Bytes& payload : payloads) {
    SolidMessage message;
    EXPECT_EQ(decode(payload, message), Reject::None);
    shown[message.avatar].push_back(verdictsIn(payload));
  }
  return shown;
}

// Each accepted pose is shown once, after its answer; the journal has both; the answers are those
// without a solid avatar, and no byte depends on the workers.
TEST(Service, ShowsEveryAcceptedPoseOnceAfterItsAnswer) {
  constexpr std::int32_t kAvatars = 3;
  const std::vector<Sent> sent = mixedStreams(kAvatars, 600, 5);
  const auto expected = verdictsOneByOne(sent, kAvatars);
  std::map<std::int32_t, std::vector<Bytes>> first;
  for (const int workers : {1, 3}) {
    SCOPED_TRACE(workers);
    Stage stage(kAvatars, withWorkers(workers), true, nullptr, true);
    for (const Sent& message : sent) stage.inbox->send(message.channel, message.payload);
    ASSERT_TRUE(stage.settles(posesIn(sent)));
    stage.service().stop();
    EXPECT_TRUE(same(verdictsByAvatar(stage.outbox->on(kContacts)), expected));
    const auto shown = shownByAvatar(stage.outbox->on(kSolidChannel));
    if (first.empty()) first = shown;
    EXPECT_TRUE(same(shown, first));
    for (const auto& [avatar, verdicts] : expected) {
      EXPECT_EQ(shown.at(avatar).size(), verdicts.size());
    }
    // In the journal: pose, answer, what is shown.
    std::map<std::int32_t, std::int64_t> answered;
    std::size_t inJournal = 0;
    for (const test::Recorded& event : stage.book->events()) {
      if (event.channel == kContacts) {
        const ContactsMessage answer = answerIn(event.payload);
        answered[answer.avatar] = answer.sequenceTo;
      } else if (event.channel == kSolidChannel) {
        SolidMessage message;
        ASSERT_EQ(decode(event.payload, message), Reject::None);
        EXPECT_EQ(answered[message.avatar], message.sequence);
        ++inJournal;
      }
    }
    EXPECT_EQ(inJournal, stage.outbox->on(kSolidChannel).size());
    const SolidCounts counts = stage.service().solidCounts();
    ASSERT_EQ(counts.avatars.size(), 3U);
    std::uint64_t poses = 0;
    for (const SolidCount& count : counts.avatars) {
      for (const std::uint64_t ofState : count.poses) poses += ofState;
    }
    EXPECT_EQ(poses, inJournal);
    EXPECT_EQ(counts.times.count(), inJournal);
  }
}

/// Of every avatar: what is 20 m/s^2 from a curve at most.
std::vector<PersonStream> personsOf(std::int32_t avatars) {
  BoundEntry entry;
  entry.part = "all";
  entry.bound.acceleration = 20.0;
  entry.bound.speed = 3.0;
  entry.bound.aheadAcceleration = 20.0;
  const PersonStreamOptions options{{"", "", {entry}}, MotionModel::CubicLate, 100'000, {}};
  std::vector<PersonStream> persons;
  for (std::int32_t id = 0; id < avatars; ++id) {
    persons.push_back(PersonStream::make(id, smallAvatar(), test::farWall(), options).value());
  }
  return persons;
}

// The answers are those without a person; each message about one comes after the answer of the pose
// that allows it, and is in the journal; no byte depends on the workers.
TEST(Service, SaysOfEveryPersonWhatPosesAllowAfterTheirAnswers) {
  constexpr std::int32_t kAvatars = 3;
  const std::vector<Sent> sent = mixedStreams(kAvatars, 600, 5);
  const auto expected = verdictsOneByOne(sent, kAvatars);
  std::map<std::int32_t, std::vector<Bytes>> first;
  for (const int workers : {1, 3}) {
    SCOPED_TRACE(workers);
    Stage stage(kAvatars, withWorkers(workers), true, nullptr, false, std::nullopt,
                personsOf(kAvatars));
    for (const Sent& message : sent) stage.inbox->send(message.channel, message.payload);
    ASSERT_TRUE(stage.settles(posesIn(sent)));
    stage.service().stop();
    EXPECT_TRUE(same(verdictsByAvatar(stage.outbox->on(kContacts)), expected));
    std::map<std::int32_t, std::vector<Bytes>> said;
    std::map<std::int32_t, std::int64_t> answered;
    std::uint64_t links = 0, inJournal = 0, ended = 0;
    for (const test::Recorded& event : stage.book->events()) {
      if (event.channel == kContacts) {
        const ContactsMessage answer = answerIn(event.payload);
        answered[answer.avatar] = answer.sequenceTo;
      } else if (event.channel == kPersonChannel) {
        PersonMessage message;
        ASSERT_EQ(decode(event.payload, message), Reject::None);
        EXPECT_EQ(answered[message.avatar], message.sequence);
        said[message.avatar].push_back(verdictsIn(event.payload));
        if (message.kind != StepKind::First) links += message.verdicts.size();
        // The step that the service's last pose ends: no later one bends it.
        if (message.kind == StepKind::Consecutive && message.sequenceTo == message.sequence)
          ++ended;
        ++inJournal;
      }
    }
    EXPECT_GE(ended, 1U);
    if (first.empty()) first = said;
    EXPECT_TRUE(same(said, first));
    for (const auto& [avatar, verdicts] : expected) {
      EXPECT_GE(said.at(avatar).size(), verdicts.size());
    }
    EXPECT_EQ(inJournal, stage.outbox->on(kPersonChannel).size());
    const PersonCounts counts = stage.service().personCounts();
    ASSERT_EQ(counts.avatars.size(), 3U);
    std::uint64_t counted = 0;
    for (const PersonCount& count : counts.avatars) {
      for (const std::uint64_t ofVerdict : count.links) counted += ofVerdict;
    }
    EXPECT_EQ(counted, links);
    EXPECT_EQ(counts.times.count(), inJournal);
  }
}

TEST(Service, RefusesAPersonOfNoAvatar) {
  ServiceParts parts;
  const auto inbox = std::make_shared<test::Inbox>();
  parts.receiver = std::make_unique<test::FakeReceiver>(inbox);
  parts.publisher = std::make_unique<test::FakePublisher>(std::make_shared<test::Outbox>());
  parts.persons = personsOf(2);
  const auto started = Service::start(test::solversOf(1), std::move(parts), {});
  ASSERT_FALSE(started.ok());
  EXPECT_NE(describe(started.error()).find("avatar 1"), std::string::npos);
}

/// Keeps what it is shown of the avatars that it wants.
class Onlooker final : public StepObserver {
 public:
  struct Shown {
    std::int64_t sequence = 0;
    std::size_t contacts = 0;
    double fromX = 0.0, toX = 0.0;
  };
  explicit Onlooker(std::size_t avatars) : shown(avatars) {}
  [[nodiscard]] bool wants(std::size_t avatar) const noexcept override {
    return avatar != kUnwanted;
  }
  void observe(std::size_t avatar, const StreamStep& step, const ContactsMessage& answer,
               const ShownStep* /*shown*/, const PersonStream* person) noexcept override {
    EXPECT_EQ(person, nullptr);
    EXPECT_EQ(answer.avatar, static_cast<std::int32_t>(avatar));
    shown[avatar].push_back({answer.sequenceTo, answer.contacts.size(),
                             step.from->translations[0].x(), step.to->translations[0].x()});
  }
  static constexpr std::size_t kUnwanted = 1;
  std::vector<std::vector<Shown>> shown;  // an avatar has one thread at a time
};

TEST(Service, ShowsWhoeverLooksEachStepThatIsAnswered) {
  constexpr std::int32_t kAvatars = 3;
  constexpr std::int64_t kPosesEach = 200;
  Onlooker onlooker(kAvatars);
  Stage stage(kAvatars, withWorkers(2), false, &onlooker);
  stage.sendSkeletons(kAvatars);
  for (std::int64_t n = 1; n <= kPosesEach; ++n) {
    for (std::int32_t id = 0; id < kAvatars; ++id) stage.inbox->send(kPoses, poseOf(id, n));
  }
  ASSERT_TRUE(stage.settles(kPosesEach * kAvatars));
  stage.service().stop();
  EXPECT_TRUE(onlooker.shown[Onlooker::kUnwanted].empty());
  std::map<std::int32_t, std::size_t> next;
  for (const Bytes& payload : stage.outbox->on(kContacts)) {
    const ContactsMessage answer = answerIn(payload);
    if (answer.avatar == static_cast<std::int32_t>(Onlooker::kUnwanted)) continue;
    const auto& shown = onlooker.shown[static_cast<std::size_t>(answer.avatar)];
    const std::size_t n = next[answer.avatar]++;
    ASSERT_LT(n, shown.size());
    EXPECT_EQ(shown[n].sequence, answer.sequenceTo);
    EXPECT_EQ(shown[n].contacts, answer.contacts.size());
    EXPECT_EQ(shown[n].toX, 0.4 * static_cast<double>(answer.sequenceTo % 4 + answer.avatar));
    if (n > 0) {
      EXPECT_EQ(shown[n].fromX, shown[n - 1].toX);
    }
  }
  EXPECT_EQ(next[0], static_cast<std::size_t>(kPosesEach));
  EXPECT_EQ(next[2], static_cast<std::size_t>(kPosesEach));
}

TEST(Service, LetsTheOldestPosesGoWhenAMailboxIsFull) {
  constexpr std::size_t kQueue = 4;
  Stage stage(1, withWorkers(1, kQueue));
  stage.outbox->gate.set(false);
  stage.sendSkeletons(1);
  stage.inbox->send(kPoses, poseOf(0, 1));
  ASSERT_TRUE(eventually([&] { return stage.outbox->gate.held() == 1; }));
  for (std::int64_t n = 2; n <= 11; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(eventually([&] { return stage.service().counts().received == 11; }));
  ASSERT_TRUE(eventually(
      [&] { return rejectsFor(stage.service().counts(), Reject::Overrun) == 10 - kQueue; }));
  EXPECT_EQ(stage.service().counts().waiting, kQueue + 1);
  EXPECT_TRUE(addUp(stage.service().counts()));
  stage.outbox->gate.set(true);
  ASSERT_TRUE(stage.settles(11));
  std::vector<std::int64_t> answered;
  for (const Bytes& answer : stage.outbox->on(kContacts)) {
    answered.push_back(answerIn(answer).sequenceTo);
  }
  EXPECT_EQ(answered, (std::vector<std::int64_t>{1, 8, 9, 10, 11}));
  EXPECT_EQ(answerIn(stage.outbox->on(kContacts)[1]).kind, StepKind::AcrossGap);
}

TEST(Service, KeepsSkeletonsHoweverManyPosesCome) {
  Stage stage(1, withWorkers(1, 2));
  stage.outbox->gate.set(false);
  stage.sendSkeletons(1);
  stage.inbox->send(kPoses, poseOf(0, 1));
  ASSERT_TRUE(eventually([&] { return stage.outbox->gate.held() == 1; }));
  SkeletonMessage changed = test::skeletonMessage(smallSkeleton(), 1, 1);
  changed.skeleton.joints[1].offset.x() += 0.01;
  changed.hash = skeletonHash(changed.skeleton);
  stage.inbox->send(kSkeletons, bytesOf(changed));
  for (std::int64_t n = 2; n <= 20; ++n) {
    PoseMessage pose = test::nthPose(n);
    pose.skeletonHash = changed.hash;
    stage.inbox->send(kPoses, bytesOf(pose));
  }
  ASSERT_TRUE(eventually([&] { return stage.service().counts().received == 20; }));
  stage.outbox->gate.set(true);
  ASSERT_TRUE(stage.settles(20));
  const auto answers = stage.outbox->on(kContacts);
  ASSERT_EQ(answers.size(), 3u);  // the first, and the two that waited last
  EXPECT_EQ(answerIn(answers.back()).skeletonHash, changed.hash);
}

// The recorded inputs, through fresh solvers, give the recorded answers.
TEST(Service, RecordsWhatReplaysToTheSameVerdicts) {
  constexpr std::int32_t kAvatars = 3;
  const std::vector<Sent> sent = mixedStreams(kAvatars, 800, 2);
  Stage stage(kAvatars, withWorkers(2, 8), /*isRecorded=*/true);  // a queue that overflows at times
  for (const Sent& message : sent) stage.inbox->send(message.channel, message.payload);
  ASSERT_TRUE(stage.settles(posesIn(sent)));
  stage.service().stop();
  std::vector<Sent> inputs;
  std::vector<Bytes> answers;
  for (const test::Recorded& event : stage.book->events()) {
    if (event.channel == kContacts) answers.push_back(event.payload);
    if (event.channel == kPoses || event.channel == kSkeletons) {
      inputs.push_back({event.channel, event.payload});
    }
  }
  EXPECT_TRUE(same(verdictsByAvatar(answers), verdictsOneByOne(inputs, kAvatars)));
  EXPECT_EQ(answers.size(), stage.service().counts().answered);
  EXPECT_EQ(stage.service().counts().journalFailures, 0u);
  EXPECT_EQ(stage.book->closes, 1);
}

TEST(Service, RecordsEachInputBeforeItsAnswer) {
  Stage stage(2, withWorkers(2), /*isRecorded=*/true);
  stage.sendSkeletons(2);
  for (std::int64_t n = 1; n <= 200; ++n) {
    for (std::int32_t id = 0; id < 2; ++id) stage.inbox->send(kPoses, poseOf(id, n));
  }
  ASSERT_TRUE(stage.settles(400));
  stage.service().stop();
  std::map<std::int32_t, std::int64_t> lastPose, lastAnswer;
  for (const test::Recorded& event : stage.book->events()) {
    PoseMessage pose;
    if (event.channel == kPoses && decode(event.payload, pose) == Reject::None) {
      EXPECT_EQ(pose.sequence, lastPose[pose.avatar] + 1);
      EXPECT_EQ(lastAnswer[pose.avatar], lastPose[pose.avatar]);
      lastPose[pose.avatar] = pose.sequence;
    } else if (event.channel == kContacts) {
      const ContactsMessage answer = answerIn(event.payload);
      EXPECT_EQ(answer.sequenceTo, lastPose[answer.avatar]);
      EXPECT_EQ(event.utimeUs, answer.sendUtimeUs);
      lastAnswer[answer.avatar] = answer.sequenceTo;
    }
  }
  EXPECT_EQ(lastAnswer[0], 200);
  EXPECT_EQ(lastAnswer[1], 200);
}

TEST(Service, AnswersAllThatWaitsBeforeItStops) {
  Stage stage(2, withWorkers(2));
  stage.outbox->gate.set(false);
  stage.sendSkeletons(2);
  for (std::int64_t n = 1; n <= 300; ++n) stage.inbox->send(kPoses, poseOf(n % 2 == 0, n));
  ASSERT_TRUE(eventually([&] { return stage.service().counts().received == 300; }));
  std::thread opener([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    stage.outbox->gate.set(true);
  });
  stage.service().stop();
  opener.join();
  const ServiceCounts counts = stage.service().counts();
  EXPECT_EQ(counts.answered, 300u);
  EXPECT_EQ(counts.waiting, 0u);
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 300u);
  // And the last status says so.
  const auto statuses = stage.outbox->on(kStatusChannel);
  ASSERT_FALSE(statuses.empty());
  StatusMessage last;
  ASSERT_EQ(decode(statuses.back(), last), Reject::None);
  EXPECT_EQ(last.answered, 300);
  EXPECT_EQ(last.waiting, 0);
}

TEST(Service, TakesWhatArrivedBeforeItWasToldToStop) {
  Stage stage;
  stage.sendSkeletons(1);
  ASSERT_TRUE(eventually([&] { return stage.service().counts().skeletons == 1; }));
  for (std::int64_t n = 1; n <= 10; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  stage.service().stop();
  EXPECT_EQ(stage.service().counts().answered, 10u);
}

TEST(Service, CountsAnswersThatTheSystemDoesNotTakeAndGoesOn) {
  Stage stage;
  stage.sendSkeletons(1);
  stage.outbox->refuses = true;
  for (std::int64_t n = 1; n <= 10; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(stage.settles(10));
  EXPECT_GE(stage.service().counts().publishFailures, 10u);
  EXPECT_EQ(stage.service().counts().answered, 10u);
  stage.outbox->refuses = false;
  stage.inbox->send(kPoses, poseOf(0, 11));
  ASSERT_TRUE(stage.settles(11));
  const auto answers = stage.outbox->on(kContacts);
  ASSERT_EQ(answers.size(), 1u);  // what failed is not sent again
  EXPECT_EQ(answerIn(answers[0]).sequenceTo, 11);
}

TEST(Service, CountsEventsThatADiskDoesNotTakeAndGoesOn) {
  ServiceOptions options = withWorkers(1);
  options.statusEvery = std::chrono::hours(1);
  Stage stage(1, options, /*isRecorded=*/true);
  stage.sendSkeletons(1);
  stage.book->isFull = true;
  for (std::int64_t n = 1; n <= 10; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(stage.settles(10));
  ASSERT_TRUE(eventually([&] { return stage.service().counts().journalFailures >= 20; }));
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 10u);
  EXPECT_NE(stage.service().journalFailure().find("No space left"), std::string::npos);
  stage.book->isFull = false;
  stage.inbox->send(kPoses, poseOf(0, 11));
  ASSERT_TRUE(stage.settles(11));
  stage.service().stop();
  const auto events = stage.book->events();
  ASSERT_GE(events.size(), 3u);
  EXPECT_EQ(events[events.size() - 3].channel, kPoses);
  EXPECT_EQ(events[events.size() - 2].channel, kContacts);
  EXPECT_EQ(events[events.size() - 1].channel, kStatusChannel);
}

TEST(Service, AnswersWhileADiskStalls) {
  ServiceOptions options = withWorkers(1);
  options.journal.maxEvents = 8;
  Stage stage(1, options, /*isRecorded=*/true);
  stage.book->gate.set(false);
  stage.sendSkeletons(1);
  for (std::int64_t n = 1; n <= 50; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(stage.settles(50));
  EXPECT_EQ(stage.outbox->on(kContacts).size(), 50u);
  const std::uint64_t failures = stage.service().counts().journalFailures;
  EXPECT_GT(failures, 50u);
  stage.book->gate.set(true);
  stage.service().stop();
  // Nothing is dropped silently: recorded or counted.
  const auto statuses = stage.outbox->on(kStatusChannel).size();
  EXPECT_EQ(stage.book->events().size() + stage.service().counts().journalFailures,
            1 + 50 + 50 + statuses);
}

TEST(Service, CountsGarbageUnderItsReason) {
  Stage stage;
  std::mt19937 random(3);
  constexpr std::uint64_t kGarbage = 500;
  for (std::uint64_t i = 0; i < kGarbage; ++i) {
    Bytes bytes(random() % 200);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    stage.inbox->send(i % 2 == 0 ? kPoses : kSkeletons, bytes);
  }
  stage.sendSkeletons(1);
  stage.inbox->send(kPoses, poseOf(0, 1));
  stage.inbox->send("OTHER", {1, 2, 3});
  ASSERT_TRUE(stage.settles(kGarbage / 2 + 1));
  const ServiceCounts counts = stage.service().counts();
  EXPECT_EQ(counts.answered, 1u);
  EXPECT_EQ(counts.rejected(), kGarbage / 2);
  EXPECT_EQ(counts.skeletons, kGarbage / 2 + 1);
  std::int64_t named = 0;
  for (const StatusMessage::Count& count : stage.service().status().counts) named += count.count;
  EXPECT_EQ(named, static_cast<std::int64_t>(kGarbage));
}

/// Holds an answer back until somebody has seen poses wait behind it, as long as tests wait.
class Straggler final : public StepObserver {
 public:
  explicit Straggler(const std::atomic<int>& seen) : seen_(seen) {}
  [[nodiscard]] bool wants(std::size_t /*avatar*/) const noexcept override { return seen_ == 0; }
  void observe(std::size_t /*avatar*/, const StreamStep& /*step*/,
               const ContactsMessage& /*answer*/, const ShownStep* /*shown*/,
               const PersonStream* /*person*/) noexcept override {
    EXPECT_TRUE(eventually([&] { return seen_ > 0; }));
  }

 private:
  const std::atomic<int>& seen_;
};

TEST(Service, AddsUpWheneverItIsAsked) {
  constexpr std::int32_t kAvatars = 3;
  const std::vector<Sent> sent = mixedStreams(kAvatars, 1500, 4);
  std::atomic<bool> isOver{false};
  std::atomic<int> looks{0}, busy{0};
  Straggler straggler(busy);
  Stage stage(kAvatars, withWorkers(2, 4), false, &straggler);
  std::thread watcher([&] {
    while (!isOver) {
      const StatusMessage status = stage.service().status();
      ++looks;
      busy += status.waiting > 0;
      if (status.received != status.answered + status.rejected + status.waiting) {
        ADD_FAILURE() << status.received << " " << status.answered << " " << status.rejected << " "
                      << status.waiting;
        return;
      }
    }
  });
  for (const Sent& message : sent) stage.inbox->send(message.channel, message.payload);
  EXPECT_TRUE(stage.settles(posesIn(sent)));
  isOver = true;
  watcher.join();
  EXPECT_GT(looks, 10);
  EXPECT_GT(busy, 0);
}

TEST(Service, PublishesItsStatus) {
  ServiceOptions options = withWorkers(3);
  options.statusEvery = std::chrono::milliseconds(5);
  options.suffix = "_LAB";
  options.build = "a build";
  options.scene = "wall.obj";
  Stage stage(2, options, /*isRecorded=*/true);
  stage.inbox->send(kSkeletons + "_LAB", skeletonOf(1));
  stage.inbox->send(kPoses + "_LAB", poseOf(1, 1));
  stage.inbox->send(kPoses, poseOf(1, 2));  // not ours
  ASSERT_TRUE(stage.settles(1));
  const std::string channel = std::string(kStatusChannel) + "_LAB";
  const std::size_t before = stage.outbox->on(channel).size();
  ASSERT_TRUE(eventually([&] { return stage.outbox->on(channel).size() > before + 3; }));
  StatusMessage status;
  ASSERT_EQ(decode(stage.outbox->on(channel).back(), status), Reject::None);
  EXPECT_EQ(status.build, "a build");
  EXPECT_EQ(status.scene, "wall.obj");
  EXPECT_EQ(status.numAvatars, 2);
  EXPECT_EQ(status.numWorkers, 3);
  EXPECT_EQ(status.received, 1);
  EXPECT_EQ(status.answered, 1);
  EXPECT_GT(status.utimeUs, status.startUtimeUs);
  EXPECT_EQ(stage.outbox->on(kContacts + "_LAB").size(), 1u);
}

TEST(Service, TellsThatItsReceiverIsGoneAndAnswersWhatItHas) {
  Stage stage;
  stage.outbox->gate.set(false);
  stage.sendSkeletons(1);
  for (std::int64_t n = 1; n <= 5; ++n) stage.inbox->send(kPoses, poseOf(0, n));
  ASSERT_TRUE(eventually([&] { return stage.service().counts().received == 5; }));
  EXPECT_TRUE(stage.service().health().isWell);
  stage.inbox->die();
  ASSERT_TRUE(eventually([&] { return stage.service().failure().has_value(); }));
  EXPECT_FALSE(stage.service().health().isWell);
  EXPECT_NE(stage.service().health().text.find("the socket is gone"), std::string::npos);
  stage.outbox->gate.set(true);
  stage.service().stop();
  EXPECT_EQ(stage.service().counts().answered, 5u);
}

TEST(Service, NamesAThreadThatDoesNotGetOn) {
  ServiceOptions options = withWorkers(2);
  options.stuckAfter = std::chrono::milliseconds(1500);  // idle threads beat more often
  Stage stage(1, options);
  stage.outbox->gate.set(false);
  stage.sendSkeletons(1);
  EXPECT_TRUE(stage.service().health().isWell);
  EXPECT_NE(stage.service().health().text.find("no pose yet"), std::string::npos);
  stage.inbox->send(kPoses, poseOf(0, 1));
  ASSERT_TRUE(eventually([&] { return !stage.service().health().isWell; }));
  EXPECT_EQ(stage.service().health().text.rfind("stuck: thread ", 0), 0u)
      << stage.service().health().text;
  stage.outbox->gate.set(true);
  EXPECT_TRUE(eventually([&] { return stage.service().health().isWell; }));
}

TEST(Service, RefusesWhatItCannotServe) {
  const auto refused = [](std::vector<StreamSolver> solvers, const ServiceOptions& options) {
    ServiceParts parts;
    parts.receiver = std::make_unique<test::FakeReceiver>(std::make_shared<test::Inbox>());
    parts.publisher = std::make_unique<test::FakePublisher>(std::make_shared<test::Outbox>());
    const auto service = Service::start(std::move(solvers), std::move(parts), options);
    return service.ok() ? std::string() : service.error().message;
  };
  EXPECT_EQ(refused(solversOf(1), {}), "");
  EXPECT_NE(refused({}, {}), "");
  std::vector<StreamSolver> twice = solversOf(1);
  twice.push_back(std::move(solversOf(1).front()));
  EXPECT_NE(refused(std::move(twice), {}).find("different ids"), std::string::npos);
  EXPECT_NE(refused(solversOf(1), withWorkers(0)).find("workers"), std::string::npos);
  EXPECT_NE(refused(solversOf(1), withWorkers(1, 0)).find("queue"), std::string::npos);
  ServiceOptions options;
  options.suffix = std::string(kMaxChannelBytes, 'x');
  EXPECT_NE(refused(solversOf(1), options).find("suffix"), std::string::npos);
}

TEST(WorkBudget, IsAnAmountOfWorkThatAllLinksShare) {
  EXPECT_EQ(workBudget(400.0), 40'000u);
  EXPECT_EQ(workBudget(0.001), 1u);
  EXPECT_GT(workBudget(1e300), 1'000'000'000u);
}

}  // namespace
}  // namespace foretouch
