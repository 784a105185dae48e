// tests/tools/log/log_replay_program_test.cpp: `foretouch log replay`, on journals of a service
// with a moving world, which runs in this process.
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "network/log/event_log.h"
#include "tests/network/service/service_fakes.h"
#include "tests/support/holds.h"
#include "tests/tools/program_run.h"
#include "tests/tools/world/small_stage.h"
#include "tools/stream/served_world.h"
#include "tools/stream/serving.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

constexpr std::int64_t kBegin = 1'700'000'000'000'000;
constexpr std::int64_t kPeriod = 10'000;
constexpr BodyNumber kMan = 1, kThrown = 7;

template <typename Message>
Bytes encoded(const Message& message) {
  Bytes payload;
  encode(message, payload);
  return payload;
}

/// A service that serves a world file, and what it records.
class ServedStage : public SmallStage {
 public:
  ServedStage()
      : world(write("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                    sphereNamed("ball", "position = [9, 0, 0]\n"))) {}

  /// The man walks through the wall; a ball flies through him. Half of the ball's poses are lost.
  [[nodiscard]] std::string journal(const WorldPolicy& policy = {},
                                    const tools::StreamSolidRequest& solid = {}) const {
    tools::ServeConfig config;
    config.solid = solid;
    auto loaded = tools::loadWorldToServe(world, policy, config.solid, config.world);
    EXPECT_TRUE(loaded.ok()) << describe(loaded.error());
    config.avatars = loaded.value().avatars;
    auto served = tools::loadServedWorld(config);
    EXPECT_TRUE(served.ok()) << describe(served.error());
    const RawSkeleton raw = rawOf(served.value().avatars.front().avatar().skeleton());
    ServiceParts parts;
    const auto inbox = std::make_shared<Inbox>();
    const auto book = std::make_shared<Book>();
    parts.receiver = std::make_unique<FakeReceiver>(inbox);
    parts.publisher = std::make_unique<FakePublisher>(std::make_shared<Outbox>());
    parts.journal = std::make_unique<FakeSink>(book);
    parts.world = std::move(loaded.value().solver);
    ServiceOptions options;
    options.queue = 1000;
    auto service =
        Service::start(std::move(served.value().avatars), std::move(parts), options).value();
    send(*inbox, raw, service);
    service.stop();
    auto log = EventLogWriter::create(folder / "journal.lcmlog").value();
    for (const Recorded& event : book->events()) {
      EXPECT_TRUE(log.write(event.utimeUs, event.channel, event.payload).ok());
    }
    EXPECT_TRUE(log.close().ok());
    return folder / "journal.lcmlog";
  }

  /// The journal with each message of events as `change` leaves it.
  template <typename Change>
  [[nodiscard]] std::string changed(const std::string& path, const std::string& name,
                                    const Change& change) const {
    auto reader = EventLogReader::open(path).value();
    auto writer = EventLogWriter::create(folder / name).value();
    for (LogEvent event; reader.next(event).value();) {
      Bytes payload = event.payload;
      EventsMessage message;
      if (event.channel == kEventsChannel && decode(payload, message) == Reject::None) {
        if (!change(message)) continue;
        encode(message, payload);
      }
      EXPECT_TRUE(writer.write(event.utimeUs, event.channel, payload).ok());
    }
    EXPECT_TRUE(writer.close().ok());
    return folder / name;
  }

  [[nodiscard]] Ended replayed(const std::string& log, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"log", "replay", log, "--world", world};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runForetouch(arguments);
  }

  std::string world;

 private:
  static RawSkeleton rawOf(const Skeleton& skeleton) {
    RawSkeleton raw;
    for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
      raw.joints.push_back({skeleton.name(joint), skeleton.parent(joint),
                            skeleton.restOffset(joint), skeleton.restRotation(joint)});
    }
    return raw;
  }

  /// Each is answered before the next one is sent: else one stream may be told whole before the
  /// other.
  static void send(Inbox& inbox, const RawSkeleton& raw, const Service& service) {
    SkeletonMessage skeleton;
    skeleton.avatar = kMan;
    skeleton.session = 1;
    skeleton.skeleton = raw;
    skeleton.hash = skeletonHash(raw);
    inbox.send(kSkeletonChannel, encoded(skeleton), kBegin);
    BodyMessage ball;
    ball.body = kThrown;
    ball.session = 1;
    ball.shape = "ball";
    ball.sinceUs = 0;
    inbox.send(kBodyChannel, encoded(ball), kBegin);
    for (std::int64_t n = 0; n <= 60; ++n) {
      const double walked = 0.025 * static_cast<double>(n);
      PoseMessage pose;
      pose.avatar = kMan;
      pose.session = 1;
      pose.sequence = n;
      pose.utimeUs = kBegin + n * kPeriod;
      pose.skeletonHash = skeleton.hash;
      for (std::size_t j = 0; j < raw.joints.size(); ++j) {
        pose.joints.push_back(
            {static_cast<std::int32_t>(j), kJointValid | kJointTracked, Quaternion::Identity()});
      }
      pose.translations.push_back({0, {walked - 0.75, 0.0, 0.0}});
      inbox.send(kPoseChannel, encoded(pose), pose.utimeUs + 50);
      EXPECT_TRUE(eventually([&] {
        const ServiceCounts counts = service.counts();
        const WorldCounts told = service.world()->counts;
        return counts.received == static_cast<std::uint64_t>(n) + 1 && counts.waiting == 0 &&
               told.avatarPoses == counts.received;
      }));
      if (n % 2 != 0) continue;
      RigidPoseMessage poses;
      poses.session = 1;
      poses.sequence = n / 2;
      poses.utimeUs = pose.utimeUs + 3000;
      const Vector3d place(0.75 - 2.0 * walked, 0.0, 0.0);
      poses.bodies.push_back(
          {kThrown, kJointValid | kJointTracked, {Quaternion::Identity(), place}});
      inbox.send(kRigidPoseChannel, encoded(poses), poses.utimeUs + 50);
      const auto all = static_cast<std::uint64_t>(poses.sequence) + 1;
      EXPECT_TRUE(eventually([&] { return service.world()->counts.rigidPoses == all; }));
    }
  }
};

TEST(LogReplayProgram, RepeatsContactsAndEventsByteForByte) {
  const ServedStage stage;
  const std::string log = stage.journal();
  const Ended ended = stage.replayed(log);
  ASSERT_EQ(ended.exitCode, 0) << ended.err << ended.out;
  EXPECT_TRUE(holds(ended.out, "61 of 61 verdicts equal the journal's, byte for byte"))
      << ended.out;
  EXPECT_TRUE(holds(ended.out, "messages of events equal the journal's, byte for byte"))
      << ended.out;
  const Ended asJson = stage.replayed(log, {"--json"});
  ASSERT_EQ(asJson.exitCode, 0) << asJson.err;
  const json found = json::parse(asJson.out);
  EXPECT_EQ(found["agrees"], true);
  EXPECT_GT(found["messages_recorded"].get<int>(), 20);
  EXPECT_EQ(found["messages_equal"], found["messages_recorded"]);
  EXPECT_EQ(found["messages"], found["messages_recorded"]);
  EXPECT_EQ(found["answers_equal"], 61);
  EXPECT_GE(found["events"].get<int>(), 2);
}

TEST(LogReplayProgram, RepeatsWhatASolidBodyShowsAndWhatPressesAgainstIt) {
  const ServedStage stage;
  tools::StreamSolidRequest solid;
  solid.solid.isAsked = true;
  solid.worldBodies = {"m*"};
  const std::string log = stage.journal({}, solid);
  const std::vector<std::string> options{"--solid", "--world-solid", "man"};
  const Ended ended = stage.replayed(log, options);
  ASSERT_EQ(ended.exitCode, 0) << ended.err << ended.out;
  for (const char* const what :
       {"61 of 61 verdicts", "messages of events", "poses of solid bodies", "messages of pushes"}) {
    EXPECT_TRUE(holds(ended.out, std::string(what) + " equal the journal's, byte for byte"))
        << ended.out;
  }
  const json found =
      json::parse(stage.replayed(log, {"--json", "--solid", "--world-solid", "man"}).out);
  EXPECT_EQ(found["agrees"], true);
  EXPECT_GT(found["shown"].get<int>(), 20);
  EXPECT_EQ(found["shown_equal"], found["shown"]);
  EXPECT_EQ(found["pushes_equal"], found["shown"]);
  const Ended thicker =
      stage.replayed(log, {"--solid", "--world-solid", "man", "--solid-skin", "0.004"});
  EXPECT_EQ(thicker.exitCode, 1);
  EXPECT_TRUE(holds(thicker.out, "is shown differently: the skin is 0.002 in the log, 0.004 here"))
      << thicker.out;
  const Ended tracked = stage.replayed(log);
  EXPECT_EQ(tracked.exitCode, 1) << tracked.out;
  EXPECT_TRUE(holds(tracked.out, "the log also has")) << tracked.out;
  const std::string lines = stage.folder / "lines.jsonl";
  ASSERT_EQ(runForetouch({"log", "convert", log, "--output", lines}).exitCode, 0);
  EXPECT_TRUE(holds(contentOf(lines), "\"pushes\":{\"avatar\":1,"));
}

TEST(LogReplayProgram, NamesTheFirstThatDiffers) {
  const ServedStage stage;
  const std::string log = stage.journal();
  bool isDone = false;
  const std::string moved = stage.changed(log, "moved.lcmlog", [&](EventsMessage& message) {
    if (!isDone && !message.events.empty()) {
      message.events[0].event.separation += 1e-6;
      isDone = true;
    }
    return true;
  });
  ASSERT_TRUE(isDone);
  Ended ended = stage.replayed(moved);
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(holds(ended.out, "first: timeline ")) << ended.out;
  EXPECT_TRUE(holds(ended.out, "tells differently: the separation of event 0 is ")) << ended.out;
  EXPECT_TRUE(holds(ended.out, " in the log, ")) << ended.out;

  std::int64_t left = 0;
  const std::string lacking = stage.changed(log, "lacking.lcmlog", [&](EventsMessage& message) {
    left += message.sequence == 5 ? 1 : 0;
    return message.sequence != 5;
  });
  ASSERT_EQ(left, 1);
  ended = stage.replayed(lacking);
  EXPECT_EQ(ended.exitCode, 1);
  EXPECT_TRUE(holds(ended.out, "message 5 is told here, and not in the log")) << ended.out;
}

/// Whatever the answers depend on is told apart, by its name.
TEST(LogReplayProgram, SaysWhichOptionOrFileDiffers) {
  const ServedStage stage;
  const std::string log = stage.journal();
  const Ended waits = stage.replayed(log, {"--world-wait", "0.001"});
  EXPECT_EQ(waits.exitCode, 1) << waits.out;
  const std::string other =
      stage.folder.write("other.toml",
                         "format = \"foretouch-world\"\nversion = 1\n[query]\ntolerance = "
                         "0.002\n[scene]\nfile = \"wall.obj\"\n" +
                             kManWalks + sphereNamed("ball", "position = [9, 0, 0]\n"));
  const Ended tolerance = runForetouch({"log", "replay", log, "--world", other});
  EXPECT_EQ(tolerance.exitCode, 1);
  EXPECT_TRUE(holds(tolerance.out, "the tolerance is 0.001 in the log, 0.002 here"))
      << tolerance.out;
}

TEST(LogReplayProgram, RefusesByName) {
  const ServedStage stage;
  const std::string log = stage.journal();
  const auto refused = [&](std::vector<std::string> arguments, const std::string& message) {
    const Ended ended = runForetouch(arguments);
    EXPECT_EQ(ended.exitCode, 2) << message;
    EXPECT_TRUE(holds(ended.err, message)) << ended.err;
  };
  refused({"log", "replay", log}, "--world");
  refused({"log", "replay", log, "--world", stage.folder / "none.toml"}, "none.toml");
  refused({"log", "replay", stage.folder / "none.lcmlog", "--world", stage.world}, "none.lcmlog");
  const std::string bare =
      stage.folder.write("bare.toml", "format = \"foretouch-world\"\nversion = 1\n" + kManWalks);
  refused({"log", "replay", log, "--world", bare}, "expected a [scene]");
  const std::string empty = stage.folder.write(
      "empty.toml", "format = \"foretouch-world\"\nversion = 1\n[scene]\nfile = \"wall.obj\"\n" +
                        sphereNamed("ball", "position = [9, 0, 0]\n"));
  refused({"log", "replay", log, "--world", empty}, "expected a [[body]] with an avatar");
  refused({"log", "replay", log, "--world", stage.world, "--solid", "--world-solid", "ball"},
          "--world-solid: expected the name of a body with an avatar");
  refused({"log", "replay", log, "--world", stage.world, "--world-solid", "man"}, "--solid");
  const std::string carried = stage.folder.write(
      "carried.toml", "format = \"foretouch-world\"\nversion = 1\n[scene]\nfile = \"wall.obj\"\n" +
                          kManWalks +
                          sphereNamed("ball",
                                      "[[body.attach]]\ntime = 0.1\nto = \"man\"\nlink = \"Arm\"\n"
                                      "position = [0, 0.2, 0]\n"));
  refused({"log", "replay", log, "--world", carried, "--solid", "--world-solid", "*"},
          "'man' carries 'ball'; expected that a solid body of a service carries nothing");
  refused(
      {"log", "replay", log, "--world", stage.world, "--solid", "--world-solid", "man", "--snap"},
      "'man'");
  // A log without a moving world has nothing to compare, and says so.
  const std::string without =
      stage.changed(log, "without.lcmlog", [](EventsMessage&) { return false; });
  const Ended ended = stage.replayed(without);
  EXPECT_EQ(ended.exitCode, 1) << ended.err;
  EXPECT_TRUE(holds(ended.out, "the log has no events of a moving world")) << ended.out;
  const json found = json::parse(stage.replayed(without, {"--json"}).out);
  EXPECT_TRUE(found["agrees"].is_null()) << found;
  EXPECT_EQ(found["messages_recorded"], 0);
  // Who replays it without a world is told that there is more.
  const Ended plain = runForetouch({"replay", "--scene", stage.folder / "wall.obj", "--avatar",
                                    "1=" + (stage.folder / "man.json"), "--motion", log, "--output",
                                    stage.folder / "plain.jsonl"});
  EXPECT_EQ(plain.exitCode, 0) << plain.err;
  EXPECT_TRUE(holds(plain.out, "foretouch log replay compares them")) << plain.out;
}

}  // namespace
}  // namespace foretouch::test
