// VMC against matrices in Unity's own axes, and against what a performer may do.
#include "network/vmc/vmc_stream.h"

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/avatar/humanoid_rest.h"
#include "network/stream/avatar_stream.h"
#include "tests/assets/humanoid_body.h"
#include "tests/network/vmc/performer.h"
#include "tests/support/holds.h"

namespace foretouch::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

const Matrix3d kWorldMirror = Vector3d(1, 1, -1).asDiagonal();

Isometry3d frameOf(const RigidPose& pose) {
  Isometry3d frame = Isometry3d::Identity();
  frame.linear() = pose.rotation.toRotationMatrix();
  frame.translation() = pose.translation;
  return frame;
}
Quaternion quaternionOf(const Matrix3d& m) {
  return Quaternion(m).normalized();
}

/// A body with VRM's names, and the Unity model that a performer would load.
struct Scene {
  /// `isTurned`: faces -z, as VRM 0.x; else +z.
  Scene(bool isTurned, bool hasCarrier, VmcBones bones, Random& random)
      : mirror(isTurned ? Matrix3d(Vector3d(1, 1, -1).asDiagonal())
                        : Matrix3d(Vector3d(-1, 1, 1).asDiagonal())),
        skeleton(skeletonOf(isTurned, hasCarrier, random)),
        rest(placesIn(skeleton, restPose(skeleton))),
        body(VmcBody::make(7, skeleton, bones).value()),
        isNormalized(bones == VmcBones::Normalized) {}

  static Skeleton skeletonOf(bool isTurned, bool hasCarrier, Random& random) {
    const Matrix3d world =
        isTurned ? Matrix3d(Vector3d(-1, 1, -1).asDiagonal()) : Matrix3d::Identity();
    const Skeleton plain = test::body(&Part::bone, world, true, random);
    if (!hasCarrier) return plain;
    RawSkeleton raw;
    raw.joints.push_back({"Armature", kNoParent, {0.1, 0.0, 0.2}, random.rotation()});
    appendChain(plain, 0, raw);
    for (JointId j = 0; j < plain.numJoints(); ++j) {
      raw.joints[static_cast<std::size_t>(j) + 1].name = plain.name(j);
    }
    // Where the body is at rest does not change.
    const Isometry3d hips = frameOf({raw.joints[0].rotation, raw.joints[0].offset}).inverse() *
                            frameOf({plain.restRotation(0), plain.restOffset(0)});
    raw.joints[1].offset = hips.translation();
    raw.joints[1].rotation = quaternionOf(hips.linear());
    return Skeleton::build(raw).value();
  }

  Matrix3d mirror;  // of the file's axes in Unity
  Skeleton skeleton;
  std::vector<RigidPose> rest;
  VmcBody body;
  bool isNormalized;

  /// Random words, and where each joint's frame then is in our world.
  VmcWords words(Random& random, std::map<std::string, Isometry3d>& expected) const {
    VmcWords said;
    said.root = {random.rotation(), random.inBox(3.0)};
    std::vector<Isometry3d> unity(rest.size());
    for (JointId j = 0; j < skeleton.numJoints(); ++j) {
      const auto s = static_cast<std::size_t>(j);
      const JointId parent = skeleton.parent(j);
      // The model at rest in Unity: frames of the file, mirrored; or none, turned by nothing.
      Isometry3d local = Isometry3d::Identity();
      if (isNormalized) {
        const Vector3d from = parent == kNoParent || skeleton.name(j) == "hips"
                                  ? Vector3d(Vector3d::Zero())
                                  : rest[static_cast<std::size_t>(parent)].translation;
        local.translation() = mirror * (rest[s].translation - from);
      } else {
        local.translation() = mirror * skeleton.restOffset(j);
        local.linear() = mirror * skeleton.restRotation(j).toRotationMatrix() * mirror;
      }
      const bool isCarrier = skeleton.name(j) == "Armature";
      if (isCarrier && isNormalized) local = Isometry3d::Identity();
      if (!isCarrier) {
        local.linear() = random.rotation().toRotationMatrix();
        if (skeleton.name(j) == "hips") local.translation() = random.inBox(2.0);
        said.bones.emplace_back(unityName(skeleton.name(j)),
                                RigidPose{quaternionOf(local.linear()), local.translation()});
      }
      unity[s] =
          (parent == kNoParent ? frameOf(said.root) : unity[static_cast<std::size_t>(parent)]) *
          local;
      Isometry3d ours = Isometry3d::Identity();
      ours.translation() = kWorldMirror * unity[s].translation();
      const Matrix3d inside =
          isNormalized ? Matrix3d(mirror * rest[s].rotation.toRotationMatrix()) : mirror;
      ours.linear() = kWorldMirror * unity[s].linear() * inside;
      if (!isCarrier) expected[skeleton.name(j)] = ours;
    }
    return said;
  }
};

Avatar avatarOf(const Skeleton& skeleton) {
  const Lss bone{{0, 0, 0}, {0, 0.1, 0}, 0.05};
  return Avatar::build(skeleton, std::vector<std::vector<Lss>>(
                                     static_cast<std::size_t>(skeleton.numJoints()), {bone}))
      .value();
}

TEST(Vmc, PutsEveryJointWhereUnityHasIt) {
  for (int seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    Random random(static_cast<std::uint64_t>(seed));
    const VmcBones bones = seed % 2 == 0 ? VmcBones::Original : VmcBones::Normalized;
    const Scene scene(seed / 2 % 2 == 0, seed / 4 % 2 == 0, bones, random);
    VmcStream stream(scene.body);
    AvatarStream poses = AvatarStream::make(avatarOf(scene.skeleton), {}).value();
    std::vector<VmcStream::Said> said;
    std::map<std::string, Isometry3d> first, last;
    ASSERT_TRUE(stream.take(scene.words(random, first).bundle(1.0), 1'000'000, said));
    ASSERT_TRUE(stream.take(scene.words(random, last).bundle(1.1), 1'100'000, said));
    ASSERT_EQ(said.size(), 2u);
    ASSERT_TRUE(said[0].skeleton);
    ASSERT_EQ(poses.take(*said[0].skeleton), Reject::None);
    for (int k = 0; k < 2; ++k) {
      StreamStep step;
      ASSERT_EQ(poses.take(said[static_cast<std::size_t>(k)].pose, step), Reject::None);
      const auto places = placesIn(scene.skeleton, *step.to);
      for (const auto& [name, frame] : k == 0 ? first : last) {
        const auto joint = static_cast<std::size_t>(*scene.skeleton.find(name));
        EXPECT_LT((places[joint].translation - frame.translation()).norm(), 5e-6) << name;
        EXPECT_LT((places[joint].rotation.toRotationMatrix() - frame.linear()).norm(), 5e-6)
            << name;
        EXPECT_EQ((*step.unknown)[joint], UndecidedReason::None) << name;
      }
    }
  }
}

/// One body and one performer.
class VmcFrames : public testing::Test {
 protected:
  VmcWords wordsNow() {
    std::map<std::string, Isometry3d> none;
    return scene_.words(random_, none);
  }
  void take(const Bytes& packet) {
    utimeUs_ += 10'000;
    EXPECT_TRUE(stream_.take(packet, utimeUs_, said_));
  }
  [[nodiscard]] std::int64_t sequence(std::size_t i) const { return said_.at(i).pose.sequence; }
  [[nodiscard]] std::int64_t session(std::size_t i) const { return said_.at(i).pose.session; }
  [[nodiscard]] bool isTimed(std::size_t i) const { return sequence(i) < kFirstUntimed; }
  [[nodiscard]] std::size_t numJoints(std::size_t i) const {
    return said_.at(i).pose.joints.size();
  }

  Random random_{1};
  Scene scene_{false, false, VmcBones::Original, random_};
  VmcStream stream_{scene_.body};
  std::int64_t utimeUs_ = 5'000'000;
  std::vector<VmcStream::Said> said_;
};

TEST_F(VmcFrames, OneBundleAFrameIsSaidAtOnceAndAtItsOwnTime) {
  for (int k = 0; k < 5; ++k) take(wordsNow().bundle(100.0 + 0.0125 * k));
  ASSERT_EQ(said_.size(), 5u);  // the first one with the second datagram
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(sequence(k), kFirstUncounted + static_cast<std::int64_t>(k));
    const auto sinceUs = static_cast<double>(said_[k].pose.utimeUs - said_[0].pose.utimeUs);
    EXPECT_NEAR(sinceUs, 12'500.0 * static_cast<double>(k), 10.0);  // the clock is a float
    EXPECT_EQ(session(k), said_[0].receiveUtimeUs);
  }
  EXPECT_EQ(said_[4].receiveUtimeUs, utimeUs_);
  EXPECT_TRUE(said_[0].skeleton);
  EXPECT_FALSE(said_[1].skeleton);
}

TEST_F(VmcFrames, OneBoneADatagramIsAFrameWithoutATime) {
  for (int k = 0; k < 4; ++k) {
    take(oscTime(0.1 * k));
    for (const Bytes& packet : wordsNow().packets()) take(packet);
  }
  ASSERT_EQ(said_.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_FALSE(isTimed(k));
    EXPECT_EQ(numJoints(k), scene_.body.numBones());
  }
  EXPECT_EQ(said_[3].receiveUtimeUs, utimeUs_);  // with its last bone
}

TEST_F(VmcFrames, TimeMayComeLast) {
  for (int k = 0; k < 4; ++k) {
    for (const Bytes& packet : wordsNow().packets()) take(packet);
    take(oscTime(0.1 * k));
  }
  ASSERT_EQ(said_.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(numJoints(k), scene_.body.numBones());
}

TEST_F(VmcFrames, ABoneThatIsLostIsMissingInThatFrameAlone) {
  for (int k = 0; k < 6; ++k) {
    VmcWords words = wordsNow();
    if (k == 3) words.bones.pop_back();
    take(oscTime(0.1 * k));
    for (const Bytes& packet : words.packets()) take(packet);
  }
  ASSERT_EQ(said_.size(), 6u);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(numJoints(k), scene_.body.numBones() - (k == 3 ? 1 : 0)) << k;
  }
}

TEST_F(VmcFrames, ABoneThatNeverComesIsNotOfTheSkeleton) {
  VmcWords words = wordsNow();
  const std::string lacking = words.bones.back().first;
  words.bones.pop_back();
  for (int k = 0; k < 3; ++k) take(words.bundle(0.1 * k));
  ASSERT_EQ(said_.size(), 3u);
  EXPECT_EQ(said_[0].skeleton->skeleton.joints.size(), scene_.body.numBones() - 1);
  // It comes after all: another generation of the skeleton, and no bone is waited for in vain.
  take(wordsNow().bundle(0.3));
  ASSERT_EQ(said_.size(), 4u);
  EXPECT_EQ(said_[3].skeleton->generation, said_[0].skeleton->generation + 1);
  for (int k = 4; k < 20; ++k) take(words.bundle(0.1 * k));
  const std::size_t before = said_.size();
  take(words.bundle(2.0));
  EXPECT_EQ(said_.size(), before + 1);
  EXPECT_EQ(said_.back().receiveUtimeUs, utimeUs_);
}

TEST_F(VmcFrames, ARestartIsASessionAndAnOvertakenFrameIsNothing) {
  for (int k = 0; k < 3; ++k) take(wordsNow().bundle(100.0 + 0.01 * k));
  take(wordsNow().bundle(100.005));
  EXPECT_EQ(said_.size(), 3u);
  take(wordsNow().bundle(0.5));
  take(wordsNow().bundle(0.51));
  ASSERT_EQ(said_.size(), 5u);
  EXPECT_GT(session(3), session(2));
  EXPECT_EQ(session(4), session(3));
  EXPECT_TRUE(said_[3].skeleton);
}

TEST_F(VmcFrames, AClockThatStandsOrIsTooCoarseOrOffIsNotBelieved) {
  for (int k = 0; k < 3; ++k) take(wordsNow().bundle(5.0));
  ASSERT_EQ(said_.size(), 3u);
  EXPECT_TRUE(isTimed(0));
  EXPECT_FALSE(isTimed(1));
  EXPECT_GT(said_[2].pose.utimeUs, said_[1].pose.utimeUs);
  VmcStream coarse(scene_.body), slow(scene_.body);
  said_.clear();
  for (int k = 0; k < 2; ++k) {
    ASSERT_TRUE(coarse.take(wordsNow().bundle(kMostVmcTime + 0.1 * k), 1000 * k + 1, said_));
  }
  EXPECT_FALSE(isTimed(0));
  said_.clear();
  // A clock that runs at a tenth of ours, as of an engine that was halted.
  for (int k = 0; k < 30; ++k) {
    ASSERT_TRUE(slow.take(wordsNow().bundle(0.01 * k), 100'000 * k + 1, said_));
  }
  EXPECT_GT(session(29), session(0));
}

TEST_F(VmcFrames, WhatIsNotTrackedOrNoRotationIsSaidSo) {
  VmcWords words = wordsNow();
  take(words.bundle(0.1));
  take(oscState({1, 3, 0, 0}));
  take(words.bundle(0.2));
  take(oscState({1, 3, 0, 1}));
  words.bones[4].second.rotation = Quaternion(0, 0, 0, 0);
  words.bones[5].second.rotation = Quaternion(NAN, 0, 0, 0);
  take(words.bundle(0.3));
  ASSERT_EQ(said_.size(), 3u);
  EXPECT_EQ(said_[0].pose.joints[4].flags, kJointValid | kJointTracked);
  EXPECT_EQ(said_[1].pose.joints[4].flags, kJointValid);
  EXPECT_EQ(said_[2].pose.joints[4].flags, 0);
  EXPECT_EQ(said_[2].pose.joints[5].flags, 0);
  EXPECT_EQ(said_[2].pose.joints[6].flags, kJointValid | kJointTracked);
  // No model: nothing is a pose.
  take(oscState({0}));
  take(words.bundle(0.4));
  take(words.bundle(0.5));
  EXPECT_EQ(said_.size(), 3u);
}

TEST_F(VmcFrames, ARootThatDoesNotComeIsOld) {
  VmcWords words = wordsNow();
  take(words.bundle(0.1));
  take(words.bundle(0.2));
  std::vector<Bytes> bones = words.packets();
  bones.erase(bones.begin());
  bones.push_back(oscTime(0.3));
  take(oscBundle(bones));
  take(words.bundle(0.4));
  ASSERT_EQ(said_.size(), 4u);
  EXPECT_EQ(said_[1].pose.joints[0].flags, kJointValid | kJointTracked);
  EXPECT_EQ(said_[2].pose.joints[0].flags, kJointValid);  // the hips, which stand on it
  EXPECT_EQ(said_[2].pose.joints[1].flags, kJointValid | kJointTracked);
}

TEST_F(VmcFrames, NoStepClaimsToBeConsecutive) {
  AvatarStream poses = AvatarStream::make(avatarOf(scene_.skeleton), {}).value();
  for (int k = 0; k < 5; ++k) take(wordsNow().bundle(1.0 + 0.01 * k));
  ASSERT_EQ(poses.take(*said_[0].skeleton), Reject::None);
  for (std::size_t k = 0; k < said_.size(); ++k) {
    Bytes payload;
    PoseMessage again;
    encode(said_[k].pose, payload);
    ASSERT_EQ(decode(payload, again), Reject::None);
    StreamStep step;
    ASSERT_EQ(poses.take(again, step), Reject::None);
    EXPECT_EQ(step.kind, k == 0 ? StepKind::First : StepKind::AcrossGap);
    EXPECT_EQ(step.lost, 0);
  }
}

TEST(Vmc, NamesWhatAnAvatarLacks) {
  Random random(3);
  RawSkeleton raw;
  raw.joints.push_back({"hips", kNoParent, {0, 1, 0}, Quaternion::Identity()});
  const auto none = VmcBody::make(1, Skeleton::build(raw).value(), VmcBones::Original);
  ASSERT_FALSE(none.ok());
  EXPECT_TRUE(holds(none.error().message, "is no humanoid")) << none.error().message;
  const Matrix3d leaning =
      Eigen::AngleAxisd(0.8, Vector3d(1, 0, 1).normalized()).toRotationMatrix();
  const auto leans =
      VmcBody::make(1, test::body(&Part::bone, leaning, true, random), VmcBones::Original);
  ASSERT_FALSE(leans.ok());
  EXPECT_TRUE(holds(leans.error().message, "stand along the axes")) << leans.error().message;
  // Arms down: no T-pose, which only normalized bones need.
  const Skeleton plain = test::body(&Part::bone, Matrix3d::Identity(), false, random);
  for (JointId j = 0; j < plain.numJoints(); ++j) {
    RawJoint joint{plain.name(j), plain.parent(j), plain.restOffset(j), plain.restRotation(j)};
    if (j == 0) raw.joints.clear();
    if (joint.name == "leftUpperArm")
      joint.rotation = Quaternion(std::cos(0.6), 0, 0, -std::sin(0.6));
    raw.joints.push_back(joint);
  }
  const Skeleton bent = Skeleton::build(raw).value();
  EXPECT_TRUE(VmcBody::make(1, bent, VmcBones::Original).ok());
  const auto refused = VmcBody::make(1, bent, VmcBones::Normalized);
  ASSERT_FALSE(refused.ok());
  EXPECT_TRUE(holds(refused.error().message, "'leftUpperArm' is 68.8 degrees off"))
      << refused.error().message;
}

}  // namespace
}  // namespace foretouch::test
