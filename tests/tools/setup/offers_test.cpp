// Unit and axis, from bodies and rooms whose own are known.
#include <gtest/gtest.h>

#include "tests/tools/setup/hand_made_level.h"
#include "tools/setup/body_offer.h"
#include "tools/setup/frame_checks.h"
#include "tools/setup/scene_offer.h"

namespace foretouch::tools {
namespace {

using test::clipOf;
using test::room;
using test::standingBones;
using test::zUp;

TEST(Offers, LegsTellEveryUnitThatExportersUse) {
  for (const double unit : {1.0, 0.01, 0.0564, 0.0254, 0.1, 0.001, 0.3048}) {
    const Offer<double> offer = unitOf(clipOf(unit), false);
    EXPECT_EQ(offer.value, unit) << offer.reason;
    EXPECT_TRUE(offer.isSure);
  }
}

TEST(Offers, AClipThatWasReadInItsUnitIsNamedByIt) {
  const Offer<double> offer = unitOf(clipOf(1.0), false, 0.01);
  EXPECT_EQ(offer.value, 1.0);
  EXPECT_EQ(offer.reason.rfind("centimetres make it ", 0), 0u) << offer.reason;
}

TEST(Offers, TheUnitOfAClipIsSaidOnce) {
  FileFrame frame;
  frame.metresPerUnit = 0.0564;
  const std::string alike = clipFrameChecks(clipOf(1.0), frame, false).front().text;
  EXPECT_EQ(alike.rfind("CMU's unit, 1/0.45 inch make it ", 0), 0u) << alike;
  const std::string apart = clipFrameChecks(clipOf(0.01), frame, false).front().text;
  EXPECT_EQ(apart.rfind("CMU's unit, 1/0.45 inch: ", 0), 0u) << apart;
}

TEST(Offers, AUnitThatNoExporterUsesIsNotSure) {
  const Offer<double> offer = unitOf(clipOf(0.038), false);
  EXPECT_NEAR(offer.value, 0.038, 0.004);
  EXPECT_FALSE(offer.isSure);
}

TEST(Offers, AFileThatSaysMetresIsBelievedUnlessItsBodyIsAGiant) {
  EXPECT_EQ(unitOf(clipOf(1.0), true).value, 1.0);
  EXPECT_TRUE(unitOf(clipOf(1.0), true).isSure);
  const Offer<double> child = unitOf(clipOf(1.0 / 0.6), true);
  EXPECT_EQ(child.value, 1.0);
  EXPECT_FALSE(child.isSure);
  const Offer<double> forgotten = unitOf(clipOf(0.01), true);
  EXPECT_EQ(forgotten.value, 0.01);
  EXPECT_FALSE(forgotten.isSure);
}

TEST(Offers, JointsFarFromAPlausibleBodyAreADoubt) {
  Clip clip = clipOf(1.0);
  RawSkeleton bones = standingBones(1.0);
  bones.joints.push_back({"Prop", 0, {0, 14, 0}, Quaternion::Identity()});
  clip.skeleton = Skeleton::build(bones).value();
  const Offer<double> offer = unitOf(clip, true);
  EXPECT_EQ(offer.value, 1.0);
  EXPECT_FALSE(offer.isSure);
  EXPECT_NE(offer.reason.find("joints lie"), std::string::npos) << offer.reason;
}

TEST(Offers, WithoutLegsNothingIsSure) {
  Clip clip = clipOf(1.0);
  RawSkeleton bones;
  bones.joints.push_back({"a", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  bones.joints.push_back({"b", 0, {0, 30, 0}, Quaternion::Identity()});
  clip.skeleton = Skeleton::build(bones).value();
  clip.frames = {restPose(clip.skeleton)};
  const Offer<double> offer = unitOf(clip, false);
  EXPECT_FALSE(offer.isSure);
  EXPECT_GT(30 * offer.value, 0.1);
  EXPECT_LT(30 * offer.value, 10.0);
  EXPECT_FALSE(upAxisOf(clip, false).isSure);
}

TEST(Offers, FeetAndHeadTellTheAxis) {
  EXPECT_EQ(upAxisOf(clipOf(0.01), false).value, UpAxis::Y);
  EXPECT_TRUE(upAxisOf(clipOf(0.01), false).isSure);
  EXPECT_EQ(upAxisOf(clipOf(0.01, true), false).value, UpAxis::Z);
  EXPECT_TRUE(upAxisOf(clipOf(0.01, true), false).isSure);
}

TEST(Offers, ABodyThatLiesIsNotSure) {
  Clip clip = clipOf(1.0);
  clip.frames[0].rotations[0] = Eigen::AngleAxisd(std::acos(0.0), Eigen::Vector3d::UnitZ());
  EXPECT_FALSE(upAxisOf(clip, false).isSure);
  clip.frames[0].rotations[0] = Eigen::AngleAxisd(std::acos(-1.0), Eigen::Vector3d::UnitX());
  EXPECT_FALSE(upAxisOf(clip, false).isSure) << "head down";
}

TEST(Offers, ARoomIsLowerThanWide) {
  EXPECT_EQ(sceneUpAxisOf(room()).value, UpAxis::Y);
  EXPECT_TRUE(sceneUpAxisOf(room()).isSure);
  EXPECT_EQ(sceneUpAxisOf(zUp(room())).value, UpAxis::Z);
  EXPECT_TRUE(sceneUpAxisOf(zUp(room())).isSure);
}

TEST(Offers, AThingIsNotSureOfItsAxis) {
  RawScene wall;
  test::addRectangle(wall, {0, 0, 0}, {4, 0, 0}, {0, 4, 0});
  test::addRectangle(wall, {0, 0, 1}, {0, 4, 0}, {4, 0, 0});
  EXPECT_FALSE(sceneUpAxisOf(wall).isSure);
}

TEST(Offers, ARoomTellsItsUnit) {
  EXPECT_EQ(sceneUnitOf(room()).value, 1.0);
  EXPECT_TRUE(sceneUnitOf(room()).isSure);
  const Offer<double> centimetres = sceneUnitOf(room(100.0));
  EXPECT_EQ(centimetres.value, 0.01) << centimetres.reason;
  EXPECT_FALSE(centimetres.isSure) << "inches look alike";
  EXPECT_EQ(sceneUnitOf(room(1000.0)).value, 0.001);
  EXPECT_FALSE(sceneUnitOf(room(1000.0)).isSure);
}

TEST(Offers, ASceneOfMilesIsNotSure) {
  EXPECT_FALSE(sceneUnitOf(room(2e4)).isSure);
  EXPECT_FALSE(sceneUnitOf(room(1e-3)).isSure);
}

}  // namespace
}  // namespace foretouch::tools
