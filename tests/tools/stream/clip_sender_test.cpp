#include "tools/stream/clip_sender.h"

#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "tests/tools/small_world.h"
#include "tools/stream/clip_publisher.h"

namespace foretouch::tools {
namespace {

/// The small avatar with a hat that the clip does not know, and a clip that turns and moves.
struct SmallSender {
  Avatar avatar;
  Clip clip;
  JointMatch match;
  Placement placement;
  std::string path = "clip.bvh";

  explicit SmallSender(double frameTimeS = 0.1)
      : avatar(parseAvatar(withHat(), "man.json").value()),
        clip(parseBvh(test::clipAlongX({-0.75, -0.25, 0.25, 0.75, 0.5, 0.1}), "clip.bvh").value()) {
    clip.frameTimeS = frameTimeS;
    for (std::size_t i = 0; i < clip.frames.size(); ++i) {
      const double half = 0.1 * static_cast<double>(i);
      clip.frames[i].rotations[1] = Quaternion(std::cos(half), 0.0, std::sin(half), 0.0);
    }
    match = matchJoints(avatar.skeleton(), clip.skeleton).value();
    placement.origin = {1.0, 0.25, -1.0};
    placement.yawDeg = 33.0;
  }

  [[nodiscard]] PlacedClip placed() const { return {avatar, clip, match, placement, false, path}; }

  static std::string withHat() {
    std::string text = test::kManAvatar;
    return text.insert(text.rfind(']'), R"(,{"name":"Hat","parent":"Arm","offset":[0,0.5,0],)"
                                        R"("lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.01}]})");
  }
};

bool sameBits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(ClipSender, SendsThePosesOfAReplayBitForBit) {
  const SmallSender small;
  const StepSelection steps{2, 2};
  const ClipSender sender(small.placed(), steps, {3, 1000, "test"});
  ASSERT_EQ(sender.numPoses(), 3);
  for (std::int64_t i = 0; i < sender.numPoses(); ++i) {
    PoseMessage message;
    ASSERT_TRUE(sender.fill(i, 77, message).ok());
    EXPECT_EQ(message.avatar, 3);
    EXPECT_EQ(message.session, 1000);
    EXPECT_EQ(message.sequence, i);
    EXPECT_EQ(message.utimeUs, 1000 + 200'000 * i);
    EXPECT_EQ(message.sendUtimeUs, 77);
    const Pose pose = poseAtFrame(small.placed(), 2 * i).value();
    ASSERT_EQ(message.joints.size(), 3u);
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_EQ(message.joints[j].joint, static_cast<int>(j));
      for (int k = 0; k < 4; ++k) {
        EXPECT_TRUE(
            sameBits(message.joints[j].rotation.coeffs()[k], pose.rotations[j].coeffs()[k]));
      }
    }
    ASSERT_EQ(message.translations.size(), 1u);  // of the root alone: the arm has no positions
    EXPECT_EQ(message.translations[0].joint, 0);
    for (int k = 0; k < 3; ++k) {
      EXPECT_TRUE(sameBits(message.translations[0].translation[k], pose.translations[0][k]));
    }
    EXPECT_EQ(message.joints[0].flags, kJointValid | kJointTracked);
    EXPECT_EQ(message.joints[1].flags, kJointValid | kJointTracked);
    EXPECT_EQ(message.joints[2].flags, kJointValid | kJointInferred);  // the hat
  }
}

TEST(ClipSender, SendsTheAvatarsSkeleton) {
  const SmallSender small;
  const ClipSender sender(small.placed(), {1, 5}, {3, 1000, "test"});
  const SkeletonMessage message = sender.skeleton(5);
  EXPECT_EQ(message.avatar, 3);
  EXPECT_EQ(message.session, 1000);
  EXPECT_EQ(message.sendUtimeUs, 5);
  EXPECT_EQ(message.source, "test");
  EXPECT_NEAR(message.rateHz, 10.0, 1e-9);
  ASSERT_EQ(message.skeleton.joints.size(), 3u);
  EXPECT_EQ(message.skeleton.joints[2].name, "Hat");
  EXPECT_EQ(message.skeleton.joints[2].parent, 1);
  EXPECT_EQ(message.skeleton.joints[1].offset.y(), 0.3);
  EXPECT_EQ(message.hash, skeletonHash(message.skeleton));
}

TEST(ClipSender, StampsGrowStrictlyAtEveryFrameTime) {
  for (const double frameTimeS :
       {1e-6, 1.0000001e-6, 1.4999999e-6, 1.0 / 60.0, 0.0333333, 1.0 / 3.0}) {
    const SmallSender small(frameTimeS);
    const ClipSender sender(small.placed(), {1, 5}, {1, 1'700'000'000'000'000, ""});
    for (std::int64_t i = 1; i < 20000; ++i) {
      ASSERT_GT(sender.utimeOf(i), sender.utimeOf(i - 1)) << frameTimeS << " " << i;
      const double exactUs = static_cast<double>(i) * frameTimeS * 1e6;
      ASSERT_NEAR(static_cast<double>(sender.utimeOf(i) - sender.utimeOf(0)), exactUs, 0.5001);
    }
  }
}

/// What was sent, and when.
struct Sent {
  std::string channel;
  std::int64_t utimeUs = 0;
};

TEST(PublishClip, AnnouncesTheSkeletonFirstAndEverySecond) {
  const SmallSender small(0.4);
  PublishOptions options;
  options.channels = channelNames("_T").value();
  options.sender.startUtimeUs = 5'000'000;
  RecordedPace pace(5'000'000);
  std::vector<Sent> sent;
  const auto report =
      publishClip(small.placed(), {1, 5}, options, pace,
                  [&](const std::string& channel, ByteView, std::int64_t utimeUs) -> Result<bool> {
                    sent.push_back({channel, utimeUs});
                    return sent.size() != 3;  // one is not taken
                  });
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report.value().poses, 6);
  EXPECT_EQ(report.value().skeletons, 3);  // at 0, 1 and 2 s; a pose at the same instant follows
  EXPECT_EQ(report.value().failures, 1);
  EXPECT_EQ(report.value().late, 0);
  std::string order;
  for (const Sent& one : sent) order += one.channel == "FORETOUCH_POSE_T" ? 'p' : 's';
  EXPECT_EQ(order, "spppsppsp");
  EXPECT_EQ(sent[4].utimeUs, 6'000'000);
  EXPECT_EQ(sent.back().utimeUs, 7'000'000);
}

TEST(PublishClip, LoopsAsNewSessionsUntilItIsStopped) {
  /// Stops after so many waits.
  class Impatient : public RecordedPace {
   public:
    using RecordedPace::RecordedPace;
    std::optional<std::int64_t> waitUntil(std::int64_t elapsedUs) override {
      return ++waits_ > 17 ? std::nullopt : RecordedPace::waitUntil(elapsedUs);
    }

   private:
    int waits_ = 0;
  };
  const SmallSender small(0.1);
  PublishOptions options;
  options.channels = channelNames("").value();
  options.sender.startUtimeUs = 1'000'000;
  options.loop = true;
  Impatient pace(1'000'000);
  std::vector<PoseMessage> poses;
  const auto report =
      publishClip(small.placed(), {1, 5}, options, pace,
                  [&](const std::string& channel, ByteView payload, std::int64_t) -> Result<bool> {
                    PoseMessage pose;
                    if (channel == kPoseChannel && decode(payload, pose) == Reject::None)
                      poses.push_back(pose);
                    return true;
                  });
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(poses.size(), 14u);  // 17 waits: three skeletons, then two passes of 6 poses and 2 more
  EXPECT_EQ(poses[5].session, 1'000'000);
  EXPECT_EQ(poses[5].utimeUs, 1'500'000);
  EXPECT_EQ(poses[6].session, 1'600'000);  // as much later as a pose is after the one before
  EXPECT_EQ(poses[6].sequence, 0);
  EXPECT_EQ(poses[6].utimeUs, 1'600'000);
  EXPECT_EQ(poses[12].session, 2'200'000);
}

TEST(PublishClip, EndsWithTheErrorOfItsSink) {
  const SmallSender small;
  PublishOptions options;
  RecordedPace pace(0);
  const auto report =
      publishClip(small.placed(), {1, 5}, options, pace,
                  [](const std::string&, ByteView, std::int64_t) -> Result<bool> {
                    return Error::in("x.lcmlog", ErrorCode::FileUnwritable, "no space");
                  });
  ASSERT_FALSE(report.ok());
  EXPECT_EQ(report.error().file, "x.lcmlog");
}

TEST(LivePace, WaitsForItsDeadlinesAndObeysAStop) {
  bool isStopped = false;
  LivePace pace([&] { return isStopped; });
  const std::int64_t before = pace.utimeUs();
  const auto late = pace.waitUntil(2000);
  ASSERT_TRUE(late);
  EXPECT_GE(*late, 0);
  EXPECT_GE(pace.utimeUs() - before, 1000);  // the wall clock may be slewed while it waits
  isStopped = true;
  EXPECT_FALSE(pace.waitUntil(0));
}

}  // namespace
}  // namespace foretouch::tools
