#include "tools/stream/solid_text.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace foretouch::tools {
namespace {

using nlohmann::json;

SolidMessage sliding() {
  SolidMessage message;
  message.avatar = 1;
  message.session = 5;
  message.sequence = 42;
  message.kind = StepKind::Consecutive;
  message.state = SolidState::Sliding;
  message.isCertified = true;
  message.deviation = 0.0312;
  message.joints = {SolidJointState::Free, SolidJointState::Sliding};
  message.linkDeviation = {0.0, 0.0312};
  const Pose pose{{Quaternion::Identity(), Quaternion(0.1 + 0.2, 0.0, -0.0, 0.9)},
                  {Eigen::Vector3d(0.1, 1.0, -0.0), Eigen::Vector3d(0.0, 0.4, 0.0)}};
  message.way = {pose};
  message.times = {1.0};
  ShownContact& shown = message.contacts.emplace_back();
  shown.linkName = "LeftHand";
  shown.otherName = "table";
  shown.contact.link = 1;
  shown.contact.triangle = 7;
  shown.contact.push = 0.03;
  return message;
}

TEST(SolidText, IsForPeople) {
  SolidMessage message = sliding();
  EXPECT_EQ(solidText(message),
            "avatar 1, pose 42: shown sliding, 31.2 mm from the tracked pose: 'LeftHand' on "
            "'table'\n");
  message.contacts.clear();
  message.limit = SolidLimit::Budget;
  message.isCertified = false;
  message.snapInUs = 250'000;
  EXPECT_EQ(solidText(message),
            "avatar 1, pose 42: shown sliding, 31.2 mm from the tracked pose (budget), not "
            "certified, snaps in 0.25 s\n");
  message = sliding();
  message.state = SolidState::Equal;
  message.contacts.clear();
  EXPECT_EQ(solidText(message), "avatar 1, pose 42: shown equal to the tracked pose\n");
  message.state = SolidState::Placing;
  message.isCertified = false;
  EXPECT_EQ(solidText(message), "avatar 1, pose 42: shown placing, no free place is found yet\n");
}

TEST(SolidText, LinesOfJsonReadBackAsTheSameBits) {
  const SolidMessage message = sliding();
  const json solid = json::parse(solidLine(message, Stamps::Without))["solid"];
  EXPECT_EQ(solid["state"], "sliding");
  EXPECT_EQ(solid["certified"], true);
  EXPECT_FALSE(solid.contains("snap_in_us"));
  EXPECT_FALSE(solid.contains("solid_us"));
  EXPECT_EQ(solid["joints"], json({"free", "sliding"}));
  EXPECT_EQ(solid["contacts"][0]["object"], "table");
  const json& pose = solid["way"][0];
  EXPECT_EQ(pose["rotations"][1][0].get<double>(), 0.1 + 0.2);
  EXPECT_TRUE(std::signbit(pose["rotations"][1][2].get<double>()));
  EXPECT_TRUE(std::signbit(pose["translations"][0][2].get<double>()));
  EXPECT_TRUE(json::parse(solidLine(message, Stamps::With))["solid"].contains("solid_us"));
}

TEST(SolidNews, AreWhereTheStateChanges) {
  SolidNews news;
  SolidMessage message = sliding();
  EXPECT_TRUE(news.isNews(message));
  EXPECT_FALSE(news.isNews(message));
  message.avatar = 2;
  EXPECT_TRUE(news.isNews(message));
  message.limit = SolidLimit::CatchUp;
  EXPECT_TRUE(news.isNews(message));
  message.snapInUs = 1000;
  EXPECT_TRUE(news.isNews(message));
  message.snapInUs = 500;
  EXPECT_FALSE(news.isNews(message));
  message.avatar = 1;
  message.limit = SolidLimit::None;
  message.snapInUs = -1;
  EXPECT_FALSE(news.isNews(message));
}

// A flood of avatars that no service has must not take memory for ever.
TEST(SolidNews, AreBounded) {
  SolidNews news;
  SolidMessage message = sliding();
  for (std::int32_t avatar = 0; avatar < 20'000; ++avatar) {
    message.avatar = avatar;
    EXPECT_TRUE(news.isNews(message));
  }
  message.avatar = 0;
  EXPECT_TRUE(news.isNews(message));  // long forgotten
}

}  // namespace
}  // namespace foretouch::tools
