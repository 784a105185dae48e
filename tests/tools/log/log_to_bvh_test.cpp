#include "tools/log/log_to_bvh.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assets/bvh/bvh_reader.h"
#include "network/log/event_log.h"
#include "network/wire/codec.h"
#include "tests/support/random_motion.h"
#include "tests/support/temp_folder.h"
#include "tools/log/bvh_text.h"
#include "tools/stream/event_line.h"

namespace foretouch::tools {
namespace {

using test::Random;
using test::RandomMotion;
using test::randomMotion;

/// Oracle: the angle of the turn between two rotations, in fifty digits.
double turnBetween(const Quaternion& a, const Quaternion& b) {
  using oracle::PreciseQuaternion;
  using Real = oracle::Precise;
  const auto precise = [](const Quaternion& q, int sign) {
    return PreciseQuaternion{Real(q.w()), Real(sign * q.x()), Real(sign * q.y()),
                             Real(sign * q.z())};
  };
  const PreciseQuaternion turn = precise(a, -1) * precise(b, 1);
  const Real sine = sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  return static_cast<double>(2 * atan2(sine, abs(turn.w)));
}

/// A rotation whose middle angle is a quarter turn, or next to it: there the outer two are one.
Quaternion nearLock(Random& random) {
  const double half = 0.5 * (1.5707963267948966 - random.magnitude(1e-17, 1e-3));
  const Quaternion about(std::cos(half), random.chance(0.5) ? std::sin(half) : -std::sin(half), 0.0,
                         0.0);
  const Quaternion first =
      Quaternion(Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitZ()));
  const Quaternion last =
      Quaternion(Eigen::AngleAxisd(random.uniform(-3, 3), Eigen::Vector3d::UnitY()));
  return first * about * last;
}

TEST(BvhText, KeepsEveryRotationAndTranslation) {
  Random random(11);
  double worst = 0.0;
  for (int i = 0; i < 300; ++i) {
    RandomMotion motion = randomMotion(random, 1 + random.below(12));
    const auto joints = static_cast<std::size_t>(motion.skeleton.numJoints());
    for (std::size_t j = 0; j < joints; ++j) {
      if (random.chance(0.3)) motion.to.rotations[j] = nearLock(random);
    }
    const std::vector<Pose> poses{validatedPose(motion.skeleton, motion.from).value(),
                                  validatedPose(motion.skeleton, motion.to).value()};
    const std::vector<bool> all(joints, true);
    const auto text = bvhText(motion.skeleton, all, poses, 0.0125);
    ASSERT_TRUE(text.ok()) << describe(text.error());
    const Clip clip = parseBvh(text.value(), "x.bvh").value();
    ASSERT_EQ(clip.frames.size(), 2u);
    EXPECT_EQ(clip.frameTimeS, 0.0125);
    for (JointId joint = 0; joint < motion.skeleton.numJoints(); ++joint) {
      const auto found = clip.skeleton.find(motion.skeleton.name(joint));
      ASSERT_TRUE(found);
      const auto j = static_cast<std::size_t>(joint), c = static_cast<std::size_t>(*found);
      for (std::size_t frame = 0; frame < 2; ++frame) {
        EXPECT_EQ(clip.frames[frame].translations[c], poses[frame].translations[j]);
        worst = std::max(worst,
                         turnBetween(clip.frames[frame].rotations[c], poses[frame].rotations[j]));
      }
    }
  }
  EXPECT_LT(worst, 1e-14);  // far below the 1e-9 that is promised
  EXPECT_GT(worst, 0.0);
}

TEST(BvhText, RefusesWhatBvhCannotHold) {
  RawSkeleton raw;
  raw.joints.push_back({"blank at its end ", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  const Skeleton skeleton = Skeleton::build(raw).value();
  const auto text = bvhText(skeleton, {false}, {restPose(skeleton)}, 0.1);
  ASSERT_FALSE(text.ok());
  EXPECT_NE(text.error().message.find("blank at its end "), std::string::npos)
      << describe(text.error());
  RawSkeleton shifted;
  shifted.joints.push_back({"a", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  shifted.joints.push_back({"b", 0, {0, 1, 0}, Quaternion::Identity()});
  const Skeleton pair = Skeleton::build(shifted).value();
  Pose pose = restPose(pair);
  pose.translations[1].x() = 0.5;
  EXPECT_FALSE(bvhText(pair, {true, false}, {pose}, 0.1).ok());
  EXPECT_TRUE(bvhText(pair, {true, true}, {pose}, 0.1).ok());
}

/// A log of one random chain; what changes a pose comes before it is written.
class LogOfChain {
 public:
  explicit LogOfChain(const std::string& path,
                      const std::function<void(int, PoseMessage&)>& change = {},
                      bool hasSkeleton = true) {
    Random random(17);
    motion = randomMotion(random, 6);
    auto log = EventLogWriter::create(path).value();
    SkeletonMessage skeleton;
    skeleton.session = 40;
    for (JointId j = 0; j < motion.skeleton.numJoints(); ++j) {
      skeleton.skeleton.joints.push_back({motion.skeleton.name(j), motion.skeleton.parent(j),
                                          motion.skeleton.restOffset(j),
                                          motion.skeleton.restRotation(j)});
    }
    skeleton.hash = skeletonHash(skeleton.skeleton);
    skeleton.avatar = 1;
    Bytes payload;
    encode(skeleton, payload);
    if (hasSkeleton) {
      EXPECT_TRUE(log.write(40, kSkeletonChannel, payload).ok());
    }
    const std::uint8_t other[3] = {1, 2, 3};
    EXPECT_TRUE(log.write(41, "CAMERA", ByteView(other, 3)).ok());
    for (int i = 0; i < kPoses; ++i) {
      PoseMessage pose;
      pose.avatar = 1;
      pose.session = 40;
      pose.sequence = i;
      pose.utimeUs = 1000 + 20'000 * i;
      pose.skeletonHash = skeleton.hash;
      const Pose& source = i % 2 == 0 ? motion.from : motion.to;
      for (std::size_t j = 0; j < source.rotations.size(); ++j) {
        pose.joints.push_back(
            {static_cast<int>(j), kJointValid | kJointTracked, source.rotations[j]});
        pose.translations.push_back({static_cast<int>(j), source.translations[j]});
      }
      if (change) change(i, pose);
      encode(pose, payload);
      EXPECT_TRUE(log.write(pose.utimeUs, kPoseChannel, payload).ok());
    }
    EXPECT_TRUE(log.close().ok());
  }
  static constexpr int kPoses = 8;
  RandomMotion motion;
};

TEST(LogToBvh, WritesAFrameAPose) {
  const test::TempFolder folder;
  const LogOfChain chain(folder / "a.lcmlog");
  LogLoss loss;
  const auto bvh = logToBvh({folder / "a.lcmlog", "", 1}, loss);
  ASSERT_TRUE(bvh.ok()) << describe(bvh.error());
  EXPECT_EQ(bvh.value().frames, LogOfChain::kPoses);
  EXPECT_TRUE(bvh.value().notes.empty());
  EXPECT_FALSE(loss.any());
  const Clip clip = parseBvh(bvh.value().text, "a.bvh").value();
  EXPECT_NEAR(clip.frameTimeS, 0.02, 1e-12);
  ASSERT_EQ(clip.frames.size(), 8u);
  const auto found = static_cast<std::size_t>(*clip.skeleton.find("joint5"));
  EXPECT_LT(turnBetween(clip.frames[3].rotations[found], chain.motion.to.rotations[5]), 1e-9);
}

TEST(LogToBvh, SaysWhatABvhFileDoesNotHold) {
  const test::TempFolder folder;
  const LogOfChain lost(folder / "lost.lcmlog", [](int i, PoseMessage& pose) {
    if (i >= 4) pose.sequence += 3, pose.utimeUs += 60'000;
    if (i == 6) pose.sequence = 1;
  });
  LogLoss loss;
  const auto bvh = logToBvh({folder / "lost.lcmlog", "", 1}, loss);
  ASSERT_TRUE(bvh.ok()) << describe(bvh.error());
  std::string notes;
  for (const std::string& note : bvh.value().notes) notes += note + "\n";
  EXPECT_NE(notes.find("4 poses between the frames are lost"), std::string::npos) << notes;
  EXPECT_NE(notes.find("1 poses that came twice or too late"), std::string::npos) << notes;
  EXPECT_NE(notes.find("each is given 0.02 s, 0.12 s in all instead of 0.2 s"), std::string::npos)
      << notes;
}

TEST(LogToBvh, RefusesWhatIsNoClip) {
  const test::TempFolder folder;
  int number = 0;
  const auto errorOf = [&](const std::function<void(int, PoseMessage&)>& change,
                           bool hasSkeleton = true) {
    const std::string path = folder / (std::to_string(number++) + ".lcmlog");
    const LogOfChain chain(path, change, hasSkeleton);
    LogLoss loss;
    const auto bvh = logToBvh({path, "", 1}, loss);
    return bvh.ok() ? "none" : describe(bvh.error());
  };
  EXPECT_NE(errorOf([](int i, PoseMessage& pose) {
              if (i == 3) pose.joints.pop_back(), pose.translations.pop_back();
            }).find("pose 3 does not say where joint 'joint5' is"),
            std::string::npos);
  EXPECT_NE(errorOf([](int i, PoseMessage& pose) {
              if (i == 3) pose.joints[2].flags = kJointTracked;
            }).find("'joint2'"),
            std::string::npos);
  EXPECT_NE(errorOf([](int i, PoseMessage& pose) {
              if (i == 5) pose.session = 41;
            }).find("one session"),
            std::string::npos);
  EXPECT_NE(errorOf([](int, PoseMessage& pose) { pose.avatar = 2; }).find("no pose of avatar 1"),
            std::string::npos);
  EXPECT_NE(errorOf({}, false).find("not the skeleton"), std::string::npos);
}

TEST(EventLine, IsOneObjectAnEvent) {
  const test::TempFolder folder;
  const LogOfChain chain(folder / "a.lcmlog");
  auto log = EventLogReader::open(folder / "a.lcmlog").value();
  const ChannelNames channels = channelNames("").value();
  LogEvent event;
  std::vector<nlohmann::json> lines;
  while (log.next(event).value())
    lines.push_back(nlohmann::json::parse(eventLine(event, channels)));
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines[0]["skeleton"]["joints"][5]["name"], "joint5");
  EXPECT_EQ(lines[1]["channel"], "CAMERA");
  EXPECT_EQ(lines[1]["bytes"], 3);
  EXPECT_EQ(lines[1].count("refused"), 0u);
  EXPECT_EQ(lines[3]["pose"]["sequence"], 1);
  EXPECT_EQ(lines[3]["pose"]["skeleton_hash"], lines[0]["skeleton"]["hash"]);
  EXPECT_EQ(lines[3]["pose"]["joints"][2]["rotation"][0].get<double>(),
            chain.motion.to.rotations[2].w());
  event.channel = kContactsChannel;
  EXPECT_EQ(nlohmann::json::parse(eventLine(event, channels))["refused"], "fingerprint");
}

}  // namespace
}  // namespace foretouch::tools
