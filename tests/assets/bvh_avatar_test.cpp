// An avatar from a clip's skeleton: roles from names, radii from roles, LSS that contain their
// bones.
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "assets/bvh/bvh_reader.h"
#include "assets/bvh/bvh_roles.h"
#include "lss/fit.h"

namespace foretouch {
namespace {

using internal::BodyRole;

/// A clip with one frame, made by hand.
class ClipBuilder {
 public:
  ClipBuilder& joint(const std::string& name, const std::string& parent,
                     const Eigen::Vector3d& offset) {
    RawJoint raw;
    raw.name = name;
    raw.offset = offset;
    for (std::size_t i = 0; i < raw_.joints.size(); ++i) {
      if (raw_.joints[i].name == parent) raw.parent = static_cast<JointId>(i);
    }
    raw_.joints.push_back(raw);
    endSites_.emplace_back();
    return *this;
  }
  ClipBuilder& tip(const Eigen::Vector3d& offset) {
    endSites_.back().push_back(offset);
    return *this;
  }
  [[nodiscard]] Clip clip() const {
    Clip clip;
    clip.skeleton = Skeleton::build(raw_).value();
    clip.frameTimeS = 0.1;
    clip.frames = {restPose(clip.skeleton)};
    clip.hasRotation.assign(raw_.joints.size(), true);
    clip.hasTranslation.assign(raw_.joints.size(), false);
    clip.endSites = endSites_;
    return clip;
  }

 private:
  RawSkeleton raw_;
  std::vector<std::vector<Eigen::Vector3d>> endSites_;
};

std::vector<BodyRole> rolesOf(
    const std::vector<std::pair<std::string, std::string>>& namesAndParents) {
  ClipBuilder builder;
  for (const auto& [name, parent] : namesAndParents) builder.joint(name, parent, {0, 1, 0});
  return internal::bodyRoles(builder.clip().skeleton);
}

TEST(BodyRoles, KnowsMotionBuilderNames) {
  EXPECT_EQ(rolesOf({{"Hips", ""},
                     {"LHipJoint", "Hips"},
                     {"LeftUpLeg", "LHipJoint"},
                     {"LeftLeg", "LeftUpLeg"},
                     {"LeftFoot", "LeftLeg"},
                     {"LeftToeBase", "LeftFoot"},
                     {"LowerBack", "Hips"},
                     {"Neck1", "LowerBack"},
                     {"Head", "Neck1"},
                     {"LeftShoulder", "LowerBack"},
                     {"LeftArm", "LeftShoulder"},
                     {"LeftForeArm", "LeftArm"},
                     {"LeftHand", "LeftForeArm"},
                     {"LeftFingerBase", "LeftHand"},
                     {"LThumb", "LeftHand"},
                     {"LeftHandIndex1", "LeftHand"}}),
            (std::vector<BodyRole>{BodyRole::Pelvis, BodyRole::Pelvis, BodyRole::Thigh,
                                   BodyRole::Shin, BodyRole::Foot, BodyRole::Toe, BodyRole::Torso,
                                   BodyRole::Neck, BodyRole::Head, BodyRole::Clavicle,
                                   BodyRole::UpperArm, BodyRole::Forearm, BodyRole::Hand,
                                   BodyRole::Hand, BodyRole::Finger, BodyRole::Finger}));
}

TEST(BodyRoles, KnowsBiovisionNamesWhereHipAndShoulderMeanTheLimb) {
  EXPECT_EQ(rolesOf({{"Hips", ""},
                     {"LeftHip", "Hips"},
                     {"LeftKnee", "LeftHip"},
                     {"LeftAnkle", "LeftKnee"},
                     {"Chest", "Hips"},
                     {"LeftCollar", "Chest"},
                     {"LeftShoulder", "LeftCollar"},
                     {"LeftElbow", "LeftShoulder"},
                     {"LeftWrist", "LeftElbow"}}),
            (std::vector<BodyRole>{BodyRole::Pelvis, BodyRole::Thigh, BodyRole::Shin,
                                   BodyRole::Foot, BodyRole::Torso, BodyRole::Clavicle,
                                   BodyRole::UpperArm, BodyRole::Forearm, BodyRole::Hand}));
}

TEST(BodyRoles, KnowsNamespacesSuffixesAndRoots) {
  EXPECT_EQ(
      rolesOf({{"joint_Root", ""},
               {"mixamorig:Hips", "joint_Root"},
               {"head:Spine2", "mixamorig:Hips"},
               {"UpperLeg_L", "mixamorig:Hips"},
               {"lowerleg02.R", "UpperLeg_L"},
               {"finger1-1.L", "head:Spine2"},
               {"RightForeFoot", "lowerleg02.R"},
               {"Tail", "mixamorig:Hips"}}),
      (std::vector<BodyRole>{BodyRole::Root, BodyRole::Pelvis, BodyRole::Torso, BodyRole::Thigh,
                             BodyRole::Shin, BodyRole::Finger, BodyRole::Toe, BodyRole::Unknown}));
  // With more than hips below, it is the hips by another name; and hips that carry a leg stay hips.
  EXPECT_EQ(rolesOf({{"Root", ""}, {"Hips", "Root"}, {"Spine", "Root"}})[0], BodyRole::Pelvis);
  EXPECT_EQ(rolesOf({{"Hips", ""}, {"LeftLeg", "Hips"}}),
            (std::vector<BodyRole>{BodyRole::Pelvis, BodyRole::Thigh}));
}

/// Legs of 0.49 m: stature is 1 m, so that radii read as fractions of it.
ClipBuilder metreTallBody() {
  return ClipBuilder()
      .joint("Hips", "", {0, 0.5, 0})
      .joint("LeftUpLeg", "Hips", {0.05, 0, 0})
      .joint("LeftLeg", "LeftUpLeg", {0, -0.245, 0})
      .joint("LeftFoot", "LeftLeg", {0, -0.245, 0});
}

double radiusOf(const Avatar& avatar, const std::string& name) {
  return avatar.lss(avatar.skeleton().find(name).value()).at(0).radius;
}

TEST(AvatarFromClip, RadiiAreTheTablesSharesOfStature) {
  const Clip clip = metreTallBody()
                        .joint("Spine", "Hips", {0, 0.1, 0})
                        .joint("Chest", "Spine", {0, 0.1, 0})
                        .joint("LeftArm", "Chest", {0.15, 0.1, 0})
                        .joint("LeftForeArm", "LeftArm", {0.18, 0, 0})
                        .joint("LeftHand", "LeftForeArm", {0.15, 0, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok()) << describe(avatar.error());
  const double perGirth = 1.0 / (2.0 * 3.14159265358979323846 * 178.2);
  EXPECT_NEAR(radiusOf(avatar.value(), "LeftUpLeg"), 59.4 * perGirth, 1e-12);
  EXPECT_NEAR(radiusOf(avatar.value(), "LeftLeg"), 38.6 * perGirth, 1e-12);
  EXPECT_NEAR(radiusOf(avatar.value(), "Spine"), 92.6 * perGirth, 1e-12);
  EXPECT_NEAR(radiusOf(avatar.value(), "LeftArm"), 32.3 * perGirth, 1e-12);
  EXPECT_NEAR(radiusOf(avatar.value(), "LeftForeArm"), 28.7 * perGirth, 1e-12);
}

TEST(AvatarFromClip, ProportionsDoNotDependOnTheUnit) {
  const Clip metres = metreTallBody().joint("Head", "Hips", {0, 0.4, 0}).tip({0, 0.1, 0}).clip();
  Clip inches = metres;
  RawSkeleton raw;
  for (JointId j = 0; j < metres.skeleton.numJoints(); ++j) {
    raw.joints.push_back({metres.skeleton.name(j), metres.skeleton.parent(j),
                          metres.skeleton.restOffset(j) / 0.0254, Quaternion::Identity()});
  }
  inches.skeleton = Skeleton::build(raw).value();
  for (auto& sites : inches.endSites) {
    for (auto& site : sites) site /= 0.0254;
  }
  const auto a = avatarFromClip(metres);
  const auto b = avatarFromClip(inches);
  ASSERT_TRUE(a.ok() && b.ok());
  ASSERT_EQ(a.value().numLss(), b.value().numLss());
  for (LinkId i = 0; i < a.value().numLinks(); ++i) {
    for (std::size_t k = 0; k < a.value().lss(i).size(); ++k) {
      const Lss& small = a.value().lss(i)[k];
      const Lss& large = b.value().lss(i)[k];
      EXPECT_NEAR(large.radius * 0.0254, small.radius, 1e-12);
      EXPECT_LT((large.b * 0.0254 - small.b).norm(), 1e-12);
    }
  }
}

TEST(AvatarFromClip, RadiusScaleMultipliesEveryRadiusAndBonesStayInside) {
  const Clip clip = metreTallBody()
                        .joint("Spine", "Hips", {0, 0.1, 0})
                        .joint("Neck", "Spine", {0, 0.1, 0})
                        .joint("Head", "Neck", {0, 0.1, 0})
                        .tip({0, 0.1, 0})
                        .clip();
  const auto plain = avatarFromClip(clip);
  ASSERT_TRUE(plain.ok());
  for (const double scale : {0.01, 0.5, 1.3, 20.0}) {
    const auto scaled = avatarFromClip(clip, {scale});
    ASSERT_TRUE(scaled.ok());
    for (LinkId i = 0; i < plain.value().numLinks(); ++i) {
      ASSERT_EQ(scaled.value().lss(i).size(), plain.value().lss(i).size());
      for (std::size_t k = 0; k < plain.value().lss(i).size(); ++k) {
        EXPECT_NEAR(scaled.value().lss(i)[k].radius, scale * plain.value().lss(i)[k].radius, 1e-12);
      }
    }
    for (JointId j = 1; j < clip.skeleton.numJoints(); ++j) {
      const Eigen::Vector3d end = clip.skeleton.restOffset(j);
      double nearest = HUGE_VAL;
      for (const Lss& lss : scaled.value().lss(clip.skeleton.parent(j))) {
        nearest = std::min(nearest, axisDistance(lss, end) - lss.radius);
      }
      EXPECT_LE(nearest, 0.0) << clip.skeleton.name(j) << " at scale " << scale;
    }
  }
}

TEST(AvatarFromClip, ThickPartsDoNotReachPastThinOnes) {
  // The chest ends where the neck begins: its round end is no further up than the neck is thick.
  const Clip clip = metreTallBody()
                        .joint("Chest", "Hips", {0, 0.3, 0})
                        .joint("Neck", "Chest", {0, 0.2, 0})
                        .joint("Head", "Neck", {0, 0.08, 0})
                        .tip({0, 0.12, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  const Lss& chest = avatar.value().lss(clip.skeleton.find("Chest").value()).at(0);
  const double neckRadius = radiusOf(avatar.value(), "Neck");
  EXPECT_GT(chest.radius, 2.0 * neckRadius);
  EXPECT_NEAR(chest.b.y() + chest.radius, 0.2 + neckRadius, 1e-12);
  const Lss& head = avatar.value().lss(clip.skeleton.find("Head").value()).at(0);
  EXPECT_NEAR(head.b.y() + head.radius, 0.12 + 0.1 * head.radius, 1e-12);
}

TEST(AvatarFromClip, LimbSplitIntoJointsIsAsThickAllAlong) {
  const Clip clip = ClipBuilder()
                        .joint("Hips", "", {0, 0, 0})
                        .joint("thigh", "Hips", {0.05, 0, 0})
                        .joint("shin", "thigh", {0, -0.245, 0})
                        .joint("foot", "shin", {0, -0.245, 0})
                        .joint("toe1", "foot", {0, 0, 0.08})
                        .joint("toe2", "toe1", {0, 0, 0.011})
                        .joint("toe3", "toe2", {0, 0, 0.004})
                        .tip({0, 0, 0.003})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  EXPECT_NEAR(radiusOf(avatar.value(), "toe1"), 0.5 * 0.018, 1e-12);  // half the toe's length
  EXPECT_EQ(radiusOf(avatar.value(), "toe2"), radiusOf(avatar.value(), "toe1"));
  EXPECT_EQ(radiusOf(avatar.value(), "toe3"), radiusOf(avatar.value(), "toe1"));
}

TEST(AvatarFromClip, HeadsHandsAndFeetWithoutAnEndAreSpheres) {
  const Clip clip = metreTallBody()
                        .tip({0, 0, 0})
                        .joint("Neck", "Hips", {0, 0.4, 0})
                        .joint("Head", "Neck", {0, 0.1, 0})
                        .joint("LeftForeArm", "Hips", {0.3, 0.3, 0})
                        .joint("LeftHand", "LeftForeArm", {0.15, 0, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  for (const char* name : {"LeftFoot", "Head", "LeftHand"}) {
    const auto& lss = avatar.value().lss(clip.skeleton.find(name).value());
    ASSERT_EQ(lss.size(), 1u) << name;
    EXPECT_EQ(lss[0].a, lss[0].b) << name;
    EXPECT_LT(lss[0].a.norm(), lss[0].radius) << name;  // the joint is inside
  }
  const Lss& head = avatar.value().lss(clip.skeleton.find("Head").value()).at(0);
  EXPECT_NEAR(head.a.y(), 0.9 * head.radius, 1e-12);  // ahead along the neck
}

TEST(AvatarFromClip, EndOfAHeadIsNoSecondHead) {
  const Clip clip = metreTallBody()
                        .joint("Head", "Hips", {0, 0.45, 0})
                        .joint("HeadTop_End", "Head", {0, 0.1, 0})
                        .tip({0, 0, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  EXPECT_TRUE(avatar.value().lss(clip.skeleton.find("HeadTop_End").value()).empty());
}

TEST(AvatarFromClip, ARootAboveTheHipsCarriesNothing) {
  const Clip clip = ClipBuilder()
                        .joint("joint_Root", "", {0, 0, 0})
                        .joint("Hips", "joint_Root", {0, 90, 0})
                        .joint("Spine", "Hips", {0, 20, 0})
                        .tip({0, 30, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  EXPECT_TRUE(avatar.value().lss(0).empty());
  EXPECT_FALSE(avatar.value().lss(1).empty());
  // The way from the floor to the hips is no part of the body's height either.
  EXPECT_LT(radiusOf(avatar.value(), "Spine"), 0.1 * 50);
}

TEST(AvatarFromClip, UnknownNamesGetRadiiFromBoneLengths) {
  const Clip clip = ClipBuilder()
                        .joint("base", "", {0, 0, 0})
                        .joint("child1", "base", {0, 5, 0})
                        .joint("child2", "child1", {-1, 0, 0})
                        .joint("child3", "child2", {0, 3, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  EXPECT_NEAR(radiusOf(avatar.value(), "child1"), 0.15, 1e-12);
  EXPECT_TRUE(avatar.value().lss(3).empty());
}

TEST(AvatarFromClip, BonesAllAlongOneAxisStillGiveAStature) {
  // Bone-aligned skeletons have no posture at rest: here the body folds onto one axis.
  const Clip clip = ClipBuilder()
                        .joint("Hips", "", {0, 0, 0})
                        .joint("Spine", "Hips", {0.5, 0, 0})
                        .joint("Head", "Spine", {0.25, 0, 0})
                        .joint("Tail", "Hips", {0.8, 0, 0})
                        .clip();
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  const double stature = (0.5 + 0.25 + 0.8) / 1.55;
  EXPECT_NEAR(radiusOf(avatar.value(), "Head"), 0.055 * stature, 1e-12);
}

TEST(AvatarFromClip, SilentOffsetsAreTakenFromTheFirstFrame) {
  ClipBuilder builder =
      metreTallBody().joint("Spine", "Hips", {0, 0, 0}).joint("Neck", "Spine", {0, 0.1, 0});
  Clip clip = builder.clip();
  const auto spine = static_cast<std::size_t>(clip.skeleton.find("Spine").value());
  clip.hasTranslation[spine] = true;
  clip.frames[0].translations[spine] = Eigen::Vector3d(0, 0.2, 0);
  const auto avatar = avatarFromClip(clip);
  ASSERT_TRUE(avatar.ok());
  const auto& hips = avatar.value().lss(0);
  ASSERT_EQ(hips.size(), 2u);  // to the leg and to the spine
  EXPECT_GT(hips[1].b.y(), 0.1);
}

TEST(AvatarFromClip, RefusesWhatHasNoBonesOrNoScale) {
  const Clip single = ClipBuilder().joint("Hips", "", {0, 1, 0}).clip();
  EXPECT_EQ(avatarFromClip(single).error().code, ErrorCode::Empty);
  const Clip body = metreTallBody().clip();
  for (const double scale : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(avatarFromClip(body, {scale}).error().code, ErrorCode::OutOfRange);
  }
  Clip broken = body;
  broken.endSites.pop_back();
  EXPECT_EQ(avatarFromClip(broken).error().code, ErrorCode::Mismatch);
}

}  // namespace
}  // namespace foretouch
