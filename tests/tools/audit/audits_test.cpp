#include "tools/audit/audits.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

TEST(AuditAvatar, MeasuresAllLssWhereThePosePutsThem) {
  const Avatar man = parseAvatar(test::kManAvatar, "man.json").value();
  const AvatarAudit audit = auditAvatar(man, restPose(man.skeleton()));
  EXPECT_EQ(audit.links, 2);
  EXPECT_EQ(audit.lss, 2);
  EXPECT_TRUE(audit.linksWithoutLss.empty());
  EXPECT_NEAR(audit.extent.x(), 0.2, 1e-15);
  EXPECT_NEAR(audit.extent.y(), 0.1 + 0.3 + 0.5 + 0.05, 1e-15);
  EXPECT_EQ(audit.smallestRadius, 0.05);
  EXPECT_EQ(audit.largestRadius, 0.1);
  EXPECT_NEAR(audit.volume, volume(man.lss(0)[0]) + volume(man.lss(1)[0]), 1e-15);
  EXPECT_TRUE(doubtsAbout(audit).empty());
}

TEST(AuditAvatar, ListsLinksWithoutLss) {
  RawSkeleton raw;
  raw.joints.push_back({"Root", kNoParent, {0, 0, 0}, Quaternion::Identity()});
  raw.joints.push_back({"Body", 0, {0, 1, 0}, Quaternion::Identity()});
  const Avatar avatar =
      Avatar::build(Skeleton::build(raw).value(), {{}, {Lss{{0, 0, 0}, {0, 1, 0}, 0.1}}}).value();
  const AvatarAudit audit = auditAvatar(avatar, restPose(avatar.skeleton()));
  EXPECT_EQ(audit.linksWithoutLss, std::vector<std::string>{"Root"});
  EXPECT_NE(describe(audit, "rest pose").find("1: 'Root'"), std::string::npos);
}

TEST(DoubtsAbout, AsksForTheUnitOfAvatarsAndScenesOfUnlikelySize) {
  AvatarAudit avatar;
  SceneAudit scene;
  for (const auto& [side, isLikely] :
       {std::pair(0.4, false), std::pair(1.7, true), std::pair(170.0, false)}) {
    avatar.extent = {0.1, side, 0.1};
    avatar.stature = 1.7;  // of a person
    EXPECT_EQ(doubtsAbout(avatar).empty(), isLikely) << side;
  }
  for (const auto& [side, isLikely] :
       {std::pair(0.4, false), std::pair(1500.0, true), std::pair(6000.0, false)}) {
    scene.boxMax = {0.0, 0.0, side};
    EXPECT_EQ(doubtsAbout(scene).empty(), isLikely) << side;
  }
}

TEST(DoubtsAbout, JudgesPeopleByTheirStatureInAnyPose) {
  AvatarAudit crouching;
  crouching.extent = {0.6, 0.9, 0.7};
  for (const auto& [stature, isLikely] : {std::pair(0.64, false), std::pair(0.9, true),
                                          std::pair(1.8, true), std::pair(2.7, false)}) {
    crouching.stature = stature;
    EXPECT_EQ(doubtsAbout(crouching).empty(), isLikely) << stature;
  }
}

TEST(DoubtsAbout, LetsRobotsBeOfAnySizeInMetres) {
  AvatarAudit robot;
  for (const auto& [side, isLikely] : {std::pair(0.004, false), std::pair(0.46, true),
                                       std::pair(12.0, true), std::pair(460.0, false)}) {
    robot.extent = {0.01, side, 0.01};
    EXPECT_EQ(doubtsAbout(robot).empty(), isLikely) << side;
  }
}

TEST(DoubtsAbout, CountsTrianglesThatAreNotFinite) {
  SceneAudit scene;
  scene.boxMax = {4, 3, 4};
  scene.droppedNonFinite = 7;
  ASSERT_EQ(doubtsAbout(scene).size(), 1u);
  EXPECT_NE(doubtsAbout(scene)[0].find("7 triangles"), std::string::npos);
}

TEST(LargestObjects, ListsTenByNumberOfTriangles) {
  RawScene raw;
  for (int object = 0; object < 12; ++object) {
    raw.objectNames.push_back("object" + std::to_string(object));
    for (int i = 0; i <= object; ++i) {
      raw.triangles.push_back(test::wallAt(i, "").triangles[0]);
      raw.objectOf.push_back(object);
    }
  }
  const std::string text = largestObjects(Scene::build(raw).value());
  EXPECT_NE(text.find("12 in all"), std::string::npos);
  EXPECT_NE(text.find("12  'object11'"), std::string::npos);
  EXPECT_LT(text.find("'object11'"), text.find("'object2'"));
  EXPECT_EQ(text.find("'object1'"), std::string::npos);
}

}  // namespace
}  // namespace foretouch::tools
