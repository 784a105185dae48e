#include "tools/replay/replay.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

using test::smallInputs;
using test::withoutLatency;

/// To and fro through the wall, each time by another way.
std::vector<double> manyPlaces(int frames) {
  std::vector<double> places;
  for (int i = 0; i < frames; ++i) places.push_back((i % 2 == 0 ? -1.0 : 1.0) * (0.2 + 0.001 * i));
  return places;
}

std::vector<std::string> linesOf(const ReplayInputs& inputs, int threads) {
  std::vector<std::string> lines;
  const auto done = replay(inputs, threads, [&](const ReplayedStep& step) {
    EXPECT_EQ(step.answer.step, static_cast<std::int64_t>(lines.size()));
    lines.push_back(withoutLatency(step.line));
    return true;
  });
  EXPECT_TRUE(done.ok());
  return lines;
}

TEST(Replay, FindsTheWallThatNoPoseTouches) {
  const ReplayInputs inputs = smallInputs({-0.75, -0.25, 0.25, 0.75});
  std::vector<ReplayedStep> steps;
  ASSERT_TRUE(replay(inputs, 1, [&](const ReplayedStep& step) {
                steps.push_back(step);
                return true;
              }).ok());
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_TRUE(steps[0].answer.contacts.empty());
  EXPECT_TRUE(steps[2].answer.contacts.empty());
  // The hips' sphere (0.1 m) meets x = 0 at 0.3 of the way from -0.25 to 0.25, the arm (0.05 m) at
  // 0.4.
  const StepAnswer& answer = steps[1].answer;
  ASSERT_EQ(answer.contacts.size(), 2u);
  const double eps = inputs.query.tolerance;
  const double expected[] = {0.3, 0.4};
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(answer.contacts[i].link, static_cast<LinkId>(i));
    EXPECT_EQ(answer.contacts[i].verdict, Verdict::Contact);
    EXPECT_LE(answer.contacts[i].toi, expected[i] + 1e-12);
    EXPECT_GE(answer.contacts[i].toi, expected[i] - 2.0 * eps - 1e-12);  // half a metre a step
  }
  EXPECT_EQ(answer.missedByPoses, (std::vector<LinkId>{0, 1}));
  EXPECT_EQ(answer.t0S, 0.1);
  EXPECT_EQ(answer.t1S, 0.2);
}

TEST(Replay, DoesNotCallAContactMissedThatAPoseShows) {
  const ReplayInputs inputs = smallInputs({-0.5, -0.05});  // ends inside
  int contacts = 0;
  ASSERT_TRUE(replay(inputs, 1, [&](const ReplayedStep& step) {
                for (const LinkContact& contact : step.answer.contacts) {
                  contacts += contact.verdict == Verdict::Contact ? 1 : 0;
                }
                EXPECT_EQ(step.answer.missedByPoses, std::vector<LinkId>{});
                return true;
              }).ok());
  EXPECT_GE(contacts, 1);
}

TEST(Replay, GivesTheSameLinesForAnyNumberOfThreads) {
  const ReplayInputs inputs = smallInputs(manyPlaces(400));
  const std::vector<std::string> expected = linesOf(inputs, 1);
  ASSERT_EQ(expected.size(), 399u);
  for (const int threads : {2, 3, 4, 16}) {
    EXPECT_EQ(linesOf(inputs, threads), expected) << threads;
  }
}

TEST(Replay, EndsWhenTheSinkHasEnough) {
  const ReplayInputs inputs = smallInputs(manyPlaces(1000));
  int taken = 0;
  EXPECT_TRUE(replay(inputs, 4, [&](const ReplayedStep&) { return ++taken < 7; }).ok());
  EXPECT_EQ(taken, 7);
}

TEST(Replay, ReportsTheEarliestStepThatFails) {
  std::vector<double> places(300, 0.0);
  places[200] = 9e6;
  places[250] = 9e6;
  const ReplayInputs inputs = smallInputs(places, {5e6, 0, 0});
  for (const int threads : {1, 4}) {
    int taken = 0;
    const auto done = replay(inputs, threads, [&](const ReplayedStep&) {
      ++taken;
      return true;
    });
    ASSERT_FALSE(done.ok());
    EXPECT_EQ(done.error().file, "some/clip.bvh");
    EXPECT_NE(done.error().message.find("frame 200:"), std::string::npos) << done.error().message;
    EXPECT_EQ(taken, 199);
  }
}

}  // namespace
}  // namespace foretouch::tools
