#include "tools/stream/pushes_text.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace foretouch::tools {
namespace {

using nlohmann::json;

PushesMessage pushedHand() {
  PushesMessage message;
  message.avatar = 1;
  message.session = 5;
  message.sequence = 42;
  message.utimeUs = 2'000;
  message.stepUs = 1'000;
  message.timeline = 1;
  for (const double push : {0.0021, 0.012}) {
    ToldPush& told = message.contacts.emplace_back();
    told.linkName = "LeftHand";
    told.contact.body = 3;
    told.contact.link = 2;
    told.contact.push = push;
    told.contact.slipSpeed = 0.1 + 0.2;
  }
  message.contacts[1].contact.triangle = 8;
  return message;
}

PushesMessage crushedHand(bool isOver) {
  PushesMessage message = pushedHand();
  message.contacts.clear();
  ToldCrush& told = message.crushes.emplace_back();
  told.linkName = "LeftHand";
  told.crush = {7, 2, 1'500, isOver, 0.0015};
  return message;
}

TEST(PushesText, IsForPeople) {
  EXPECT_EQ(pushesText(pushedHand()), "avatar 1, pose 42: body 3 presses 'LeftHand' (12 mm)\n");
  EXPECT_EQ(pushesText(crushedHand(false)),
            "avatar 1, pose 42: body 7 crushes 'LeftHand' (1.5 mm)\n");
  EXPECT_EQ(pushesText(crushedHand(true)), "avatar 1, pose 42: body 7 crushes it no longer\n");
  EXPECT_EQ(pushesText(PushesMessage()), "avatar 0, pose 0: nothing that moves presses it\n");
}

TEST(PushesText, IsNewsWhereOthersPressOrCrush) {
  PushesNews news;
  EXPECT_FALSE(news.isNews(PushesMessage())) << "nobody presses to begin with";
  EXPECT_TRUE(news.isNews(pushedHand()));
  EXPECT_FALSE(news.isNews(pushedHand()));
  PushesMessage other = pushedHand();
  other.contacts[0].contact.body = 4;
  EXPECT_TRUE(news.isNews(other));
  EXPECT_TRUE(news.isNews(crushedHand(false)));
  EXPECT_FALSE(news.isNews(crushedHand(false)));
  EXPECT_TRUE(news.isNews(crushedHand(true)));
}

TEST(PushesText, LinesOfJsonHaveAllFields) {
  const json line = json::parse(pushesLine(pushedHand()))["pushes"];
  EXPECT_EQ(line["avatar"], 1);
  EXPECT_EQ(line["utime"], 2'000);
  EXPECT_EQ(line["step_us"], 1'000);
  EXPECT_EQ(line.count("assumed"), 0U);
  ASSERT_EQ(line["contacts"].size(), 2U);
  EXPECT_EQ(line["contacts"][0].count("triangle"), 0U);
  EXPECT_EQ(line["contacts"][1]["triangle"], 8);
  EXPECT_EQ(line["contacts"][1]["body"], 3);
  EXPECT_EQ(line["contacts"][1]["push"], 0.012);
  EXPECT_EQ(line["contacts"][1]["slip"], 0.1 + 0.2);
  const json crush = json::parse(pushesLine(crushedHand(true)))["pushes"]["crushes"][0];
  EXPECT_EQ(crush["body"], 7);
  EXPECT_EQ(crush["since"], 1'500);
  EXPECT_EQ(crush["over"], true);
  EXPECT_EQ(crush["depth"], 0.0015);
}

}  // namespace
}  // namespace foretouch::tools
