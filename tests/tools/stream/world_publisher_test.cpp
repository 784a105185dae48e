// A world file sent as messages, and heard by a live world: it tells what a replay of the file
// does.
#include "tools/stream/world_publisher.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "network/wire/codec.h"
#include "network/world_stream/world_solver.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/world/drawn_world.h"
#include "tests/tools/world/small_stage.h"
#include "tools/world/followed_world.h"
#include "tools/world/served_bodies.h"

namespace foretouch::test {
namespace {

using tools::LoadedWorld;
using tools::PublishOptions;
using tools::PublishReport;

constexpr std::int64_t kStartUs = 1'700'000'000'000'000;

/// The man walks into what stands in his way, carries a ball on his arm, and lets go of it.
const std::string kBodies =
    kManWalks + sphereNamed("post", "position = [0.1, 0, 0]\n") +
    sphereNamed("ball", poseAt(0.0, "-0.75, 1, 0") + poseAt(0.05, "-0.7, 1, 0") +
                            poseAt(0.2, "0.2, 0.3, 0") + poseAt(0.3, "0.2, -0.4, 0") +
                            "[[body.attach]]\ntime = 0.05\nto = \"man\"\nlink = \"Hips\"\n"
                            "position = [0, 0.5, 0]\n"
                            "[[body.detach]]\ntime = 0.18\nposition = [0.2, 0.5, 0]\n");

/// What a world says, and who hears it.
class Heard {
 public:
  explicit Heard(const LoadedWorld& world)
      : setup_(tools::servedBodies(world)), solver_(WorldSolver::make(setup_, {}).value()) {
    for (const auto& avatar : setup_.avatars) {
      streams_.emplace(avatar.number,
                       AvatarStream::make(*setup_.shapes[avatar.shape].avatar, {}).value());
    }
  }

  Result<PublishReport> hear(const LoadedWorld& world, double speed = 1.0) {
    PublishOptions options;
    options.speed = speed;
    options.channels = tools::channelNames("").value();
    options.sender.startUtimeUs = kStartUs;
    tools::RecordedPace pace(kStartUs);
    return tools::publishWorld(
        world, options, pace,
        [&](const std::string& channel, ByteView payload, std::int64_t utimeUs) -> Result<bool> {
          take(channel, payload, utimeUs);
          return true;
        });
  }

  std::vector<ToldEvent> events;
  std::vector<UnknownPart> unknown;
  std::vector<BodyMessage> states;
  std::vector<std::int64_t> stamps;  // of rigid poses
  [[nodiscard]] WorldCounts counts() const { return solver_.counts(); }

 private:
  void take(const std::string& channel, ByteView payload, std::int64_t utimeUs) {
    if (channel == kSkeletonChannel) {
      SkeletonMessage message;
      ASSERT_EQ(decode(payload, message), Reject::None);
      ASSERT_EQ(streams_.at(message.avatar).take(message), Reject::None);
    } else if (channel == kPoseChannel) {
      PoseMessage message;
      ASSERT_EQ(decode(payload, message), Reject::None);
      StreamStep step;
      ASSERT_EQ(streams_.at(message.avatar).take(message, step), Reject::None);
      ASSERT_EQ(solver_.take(message.avatar, step, utimeUs), Reject::None);
    } else if (channel == kBodyChannel) {
      ASSERT_EQ(decode(payload, states.emplace_back()), Reject::None);
      ASSERT_EQ(solver_.take(states.back(), utimeUs), Reject::None);
    } else {
      ASSERT_EQ(channel, kRigidPoseChannel);
      RigidPoseMessage message;
      ASSERT_EQ(decode(payload, message), Reject::None);
      stamps.push_back(message.utimeUs);
      ASSERT_EQ(solver_.take(message, utimeUs), Reject::None);
    }
    std::vector<EventsMessage> answers;
    solver_.advance(answers);
    for (const EventsMessage& answer : answers) {
      events.insert(events.end(), answer.events.begin(), answer.events.end());
      unknown.insert(unknown.end(), answer.unknown.begin(), answer.unknown.end());
    }
  }

  WorldSetup setup_;
  WorldSolver solver_;
  std::map<BodyNumber, AvatarStream> streams_;
};

LoadedWorld loaded(const SmallStage& stage, const std::string& bodies) {
  auto world = stage.load(bodies);
  EXPECT_TRUE(world.ok()) << describe(world.error());
  return std::move(world).value();
}

TEST(WorldPublisher, IsHeardAsTheFileIsReplayed) {
  const SmallStage stage;
  LoadedWorld world = loaded(stage, "[scene]\nfile = \"wall.obj\"\n" + kBodies);
  Heard heard(world);
  const auto sent = heard.hear(world);
  ASSERT_TRUE(sent.ok()) << describe(sent.error());
  EXPECT_EQ(heard.counts().rejected(), 0U);
  EXPECT_EQ(heard.counts().lateChanges, 0U);
  EXPECT_TRUE(heard.unknown.empty());

  std::vector<WorldEvent> replayed;
  const std::int64_t untilUs = world.beginUs + heard.counts().answeredUntilUs - kStartUs;
  EXPECT_EQ(untilUs, world.endUs);
  ASSERT_TRUE(tools::followWorld(world, world.beginUs, untilUs, [&](const auto& stretch) {
                const auto& more = stretch.contacts.events;
                replayed.insert(replayed.end(), more.begin(), more.end());
                return true;
              }).ok());
  std::vector<ToldEvent> told;
  for (const ToldEvent& event : heard.events) {
    if (event.cause != ToldCause::BodyGone) told.push_back(event);
  }
  ASSERT_EQ(told.size(), replayed.size());
  ASSERT_GT(told.size(), 5U);
  bool isOfCarried = false;
  for (std::size_t i = 0; i < told.size(); ++i) {
    const WorldEvent &one = told[i].event, &other = replayed[i];
    SCOPED_TRACE(toString(other.kind));
    EXPECT_EQ(one.kind, other.kind);
    EXPECT_EQ(one.a.body, other.a.body + 1);
    EXPECT_EQ(one.b.body, other.b.body < 0 ? other.b.body : other.b.body + 1);
    EXPECT_EQ(one.a.link, other.a.link);
    EXPECT_FALSE(one.isAssumed);
    // Of longer spans it sends the motion in between, in which the instants of the same contact
    // may be others: at 5 m/s by as much as two tolerances take.
    EXPECT_NEAR(microsecondsAfter(kStartUs, one.time), microsecondsAfter(world.beginUs, other.time),
                400.0);
    EXPECT_NEAR(one.separation, other.separation, 2 * kDefaultTolerance);
    isOfCarried = isOfCarried || (other.a.body == 2 && other.time.us < 180'000);
  }
  EXPECT_TRUE(isOfCarried);
}

/// What is heard of a world, by names and times, in any order.
std::vector<std::string> heardOf(const SmallStage& stage, const std::string& text) {
  const LoadedWorld world = loaded(stage, text);
  Heard heard(world);
  const auto sent = heard.hear(world);
  EXPECT_TRUE(sent.ok()) << describe(sent.error());
  EXPECT_EQ(heard.counts().rejected(), 0U);
  EXPECT_EQ(heard.counts().lateChanges, 0U);
  std::vector<std::string> told;
  for (const ToldEvent& event : heard.events) {
    if (event.cause == ToldCause::BodyGone) continue;
    std::vector<std::string> who{"everybody", "everybody"};
    if (event.event.a.body > 0) who[0] = world.nameOf(event.event.a.body - 1);
    if (event.event.b.body > 0) who[1] = world.nameOf(event.event.b.body - 1);
    std::sort(who.begin(), who.end());
    told.push_back(who[0] + " " + who[1] + " " + toString(event.event.kind) + " " +
                   std::to_string(event.event.time.us));
  }
  std::sort(told.begin(), told.end());
  return told;
}

/// A cup is put on a tray at the instant at which the man takes the tray, whose place changes; at
/// the next one both are let go of. Whoever comes first in the file, the same is heard.
TEST(WorldPublisher, TellsChangesOfOneInstantAlikeInAnyOrder) {
  const SmallStage stage;
  const std::string post = sphereNamed("post", "position = [0.35, 0.6, 0]\n"),
                    cup = sphereNamed(
                        "cup",
                        "position = [0, 0.7, 0]\n[[body.attach]]\ntime = 0.1\nto = \"tray\"\n"
                        "[[body.detach]]\ntime = 0.24\n"),
                    tray = sphereNamed(
                        "tray",
                        "position = [0, 0.6, 0]\n[[body.attach]]\ntime = 0.1\nto = \"man\"\n"
                        "link = \"Hips\"\nposition = [0, 0.6, 0]\n[[body.detach]]\n"
                        "time = 0.24\nposition = [2, 2, 2]\n");
  const auto told = heardOf(stage, kManWalks + post + cup + tray);
  EXPECT_GE(told.size(), 2U);
  EXPECT_EQ(heardOf(stage, tray + cup + post + kManWalks), told);
}

/// Nobody is told of before who carries him, and no circle is announced, whoever carries whom in
/// turn.
TEST(WorldPublisher, IsUnderstoodWhoeverCarriesWhom) {
  const SmallStage stage;
  std::size_t numTold = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    const DrawnWorld drawn(seed, seed % 2 == 0, false);
    const auto told = heardOf(stage, drawn.text({0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(heardOf(stage, drawn.text({3, 5, 1, 4, 0, 2})), told);
    numTold += told.size();
  }
  EXPECT_GT(numTold, 500U);
}

TEST(WorldPublisher, RefusesWhoIsCarriedByATrigger) {
  const SmallStage stage;
  const LoadedWorld world =
      loaded(stage, kManWalks + sphereNamed("light", "[[body.attach]]\ntime = 0\nto = \"zone\"\n") +
                        "[[trigger]]\nname = \"zone\"\nsphere = 1\n");
  Heard heard(world);
  const auto sent = heard.hear(world);
  ASSERT_FALSE(sent.ok());
  EXPECT_TRUE(holds(describe(sent.error()), "do not tell of triggers, as 'zone'"))
      << describe(sent.error());
}

TEST(WorldPublisher, SaysChangesAheadAndAtTheEndThatPropsAreGone) {
  const SmallStage stage;
  const LoadedWorld world = loaded(stage, kBodies);
  Heard heard(world);
  ASSERT_TRUE(heard.hear(world).ok());
  std::vector<const BodyMessage*> ofBall;
  for (const BodyMessage& state : heard.states) {
    if (state.shape == "ball") ofBall.push_back(&state);
  }
  ASSERT_EQ(ofBall.size(), 6U) << "there, carried, let go of (both ahead and then), gone";
  EXPECT_EQ(ofBall[0]->carrier, kNoBody);
  for (const std::size_t i : {1U, 3U}) {
    EXPECT_LT(ofBall[i]->utimeUs, ofBall[i]->sinceUs);
    EXPECT_EQ(ofBall[i + 1]->utimeUs, ofBall[i + 1]->sinceUs);
    EXPECT_EQ(ofBall[i]->sinceUs, ofBall[i + 1]->sinceUs);
  }
  EXPECT_EQ(ofBall[1]->carrier, 1);
  EXPECT_EQ(ofBall[3]->carrier, kNoBody);
  EXPECT_FALSE(ofBall[5]->isPresent);
  for (const BodyMessage* state : ofBall) EXPECT_NE(state->shapeHash, 0);
}

TEST(WorldPublisher, FollowsItsSpeed) {
  const SmallStage stage;
  const LoadedWorld world = loaded(stage, kBodies);
  for (const double speed : {0.5, 1.0, 3.0}) {
    Heard heard(world);
    const auto sent = heard.hear(world, speed);
    ASSERT_TRUE(sent.ok());
    const double lengthUs = static_cast<double>(world.endUs - world.beginUs) / speed;
    EXPECT_NEAR(static_cast<double>(heard.stamps.back() - kStartUs), lengthUs, 2.0);
    EXPECT_EQ(heard.counts().rejected(), 0U);
    EXPECT_EQ(heard.counts().silences, 0U) << "nobody is quiet for longer than is waited for";
    EXPECT_TRUE(heard.unknown.empty());
  }
}

TEST(WorldPublisher, RefusesAnAvatarThatIsCarried) {
  const SmallStage stage;
  const LoadedWorld world = loaded(
      stage, kManWalks + sphereNamed("cart", poseAt(0.0, "0, 1, 0") + poseAt(0.3, "1, 1, 0")) +
                 "[[body]]\nname = \"rider\"\navatar = \"man.json\"\n"
                 "[[body.attach]]\ntime = 0\nto = \"cart\"\nposition = [0, 1, 0]\n");
  Heard heard(world);
  const auto sent = heard.hear(world);
  ASSERT_FALSE(sent.ok());
  EXPECT_TRUE(holds(describe(sent.error()), "expected a prop")) << describe(sent.error());
  EXPECT_GT(sent.error().line, 0);
}

TEST(WorldPublisher, WritesALogOrSaysWhyNot) {
  const SmallStage stage;
  const std::string path = stage.write("[scene]\nfile = \"wall.obj\"\n" + kBodies);
  const std::string log = stage.folder / "world.lcmlog";
  const Ended written = runForetouch({"publish", "--world", path, "-o", log, "--start", "1000000"});
  ASSERT_EQ(written.exitCode, 0) << written.err;
  EXPECT_TRUE(holds(written.out, "states of")) << written.out;
  const Ended seen = runForetouch({"log", "info", log});
  EXPECT_EQ(seen.exitCode, 0) << seen.err;
  EXPECT_TRUE(holds(seen.out, "FORETOUCH_RIGID")) << seen.out;
  const auto refused = [&](const std::vector<std::string>& more, const std::string& why) {
    std::vector<std::string> words{"publish", "--world", path};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = runForetouch(words);
    EXPECT_EQ(ended.exitCode, 2);
    EXPECT_TRUE(holds(ended.err, why)) << ended.err;
  };
  refused({"--rate", "10"}, "--rate: is of a clip");
  refused({"clip.bvh"}, "--motion: is of a clip");
  refused({"--speed", "0"}, "--speed: expected above 0");
  const Ended nothing = runForetouch({"publish", "--avatar", stage.folder / "man.json"});
  EXPECT_EQ(nothing.exitCode, 2);
  EXPECT_TRUE(holds(nothing.err, "expected a clip to send")) << nothing.err;
}

}  // namespace
}  // namespace foretouch::test
