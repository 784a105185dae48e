#include "tools/stream/person_text.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace foretouch::tools {
namespace {

using nlohmann::json;

PersonMessage handOnTable() {
  PersonMessage message;
  message.avatar = 1;
  message.sequence = 43;
  message.utimeUs = 66'000;
  message.model = MotionModel::CubicLate;
  message.kind = StepKind::Consecutive;
  message.sequenceFrom = 41;
  message.sequenceTo = 42;
  message.utimeToUs = 33'000;
  message.verdicts = {BracketVerdict::Excluded, BracketVerdict::Certain};
  message.aheadUs = 100'000;
  message.notBeforeUs = {166'000, -1};
  ToldBracket& told = message.brackets.emplace_back();
  told.linkName = "LeftHand";
  told.otherName = "table";
  told.bracket.link = 1;
  told.bracket.triangle = 7;
  told.bracket.verdict = BracketVerdict::Certain;
  told.bracket.possibleFrom = 0.25;
  told.bracket.certainFrom = 0.5;
  told.bracket.certainUntil = 1.0;
  return message;
}

TEST(PersonText, IsForPeople) {
  PersonMessage message = handOnTable();
  EXPECT_EQ(personStepText(message),
            "avatar 1, pose 42: the person surely touched 'LeftHand' on 'table', from 8.2 to 16.5 "
            "ms on, nothing for 100.0 ms\n");
  message.brackets[0].bracket.verdict = BracketVerdict::Possible;
  message.broken = {{1, BrokenBound::Claim::Ahead, 0.0123}};
  message.notBeforeUs = {70'000, -1};
  EXPECT_EQ(personStepText(message),
            "avatar 1, pose 42: the person perhaps touched 'LeftHand' on 'table', nothing for 4.0 "
            "ms, link 1 breaks its bound (ahead) by 12.3 mm\n");
  message.brackets.clear();
  message.broken.clear();
  message.notBeforeUs = {-1, -1};
  EXPECT_EQ(personStepText(message),
            "avatar 1, pose 42: the person touched nothing of the scene\n");
  message.verdicts = {BracketVerdict::Unclaimed, BracketVerdict::Unclaimed};
  EXPECT_EQ(personStepText(message), "avatar 1, pose 42: the person: nothing is claimed\n");
}

TEST(PersonText, SaysWhatLinksDidThatWereLost) {
  PersonMessage message = handOnTable();
  message.kind = StepKind::AcrossGap;
  message.sequenceFrom = 30;
  message.aheadUs = 0;
  message.notBeforeUs = {-1, -1};
  message.brackets[0].bracket.verdict = BracketVerdict::Possible;
  EXPECT_EQ(personStepText(message),
            "avatar 1, poses 30 to 42: the person, with links that were lost, perhaps touched "
            "'LeftHand' on 'table'\n");
}

TEST(PersonText, LinesOfJsonHaveAllOfIt) {
  PersonMessage message = handOnTable();
  message.personUs = 12.5;
  const json with = json::parse(personStepLine(message, Stamps::With))["person_step"];
  EXPECT_EQ(with["between"], "cubic-late");
  EXPECT_EQ(with["kind"], "consecutive");
  EXPECT_EQ(with["verdicts"], json({"excluded", "certain"}));
  EXPECT_EQ(with["not_before"], json({166'000, nullptr}));
  EXPECT_EQ(with["person_us"], 12.5);
  const json& bracket = with["brackets"][0];
  EXPECT_EQ(bracket["link"], "LeftHand");
  EXPECT_EQ(bracket["object"], "table");
  EXPECT_EQ(bracket["possible_from"], 0.25);
  EXPECT_EQ(bracket["certain_from"], 0.5);
  message.aheadUs = 0;
  message.brackets[0].bracket.triangle = -1;
  message.brackets[0].bracket.other = 0;
  message.brackets[0].bracket.verdict = BracketVerdict::Possible;
  message.broken = {{1, BrokenBound::Claim::InGap, 0.5}};
  const json without = json::parse(personStepLine(message, Stamps::Without))["person_step"];
  EXPECT_EQ(without.count("person_us") + without.count("not_before"), 0U);
  EXPECT_EQ(without["brackets"][0]["other"], "table");
  EXPECT_EQ(without["brackets"][0].count("certain_from"), 0U);
  EXPECT_EQ(without["broken"][0]["claim"], "gap");
}

TEST(PersonNews, AreWhereWhatIsTouchedChanges) {
  PersonNews news;
  PersonMessage message = handOnTable();
  EXPECT_TRUE(news.isNews(message));
  message.brackets[0].bracket.possibleFrom = 0.1;
  EXPECT_FALSE(news.isNews(message));
  message.brackets[0].bracket.verdict = BracketVerdict::Possible;
  EXPECT_TRUE(news.isNews(message));
  message.broken.resize(1);
  EXPECT_TRUE(news.isNews(message));
  message.broken.clear();
  EXPECT_FALSE(news.isNews(message));
  message.brackets.clear();
  EXPECT_TRUE(news.isNews(message));
  message.avatar = 2;
  EXPECT_FALSE(news.isNews(message)) << "nothing touched, as before";
  PersonMessage found = handOnTable();
  found.avatar = 2;
  found.kind = StepKind::AcrossGap;
  EXPECT_TRUE(news.isNews(found));
  EXPECT_FALSE(news.isNews(message)) << "of the links that were known nothing is new";
}

}  // namespace
}  // namespace foretouch::tools
