#include "tools/replay/summary.h"

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/tools/small_inputs.h"
#include "tools/percentile.h"
#include "tools/progress.h"
#include "tools/replay/replay.h"

namespace foretouch::tools {
namespace {

TEST(Percentile, IsTheValueAtTheNearestRank) {
  std::vector<float> values;
  EXPECT_EQ(percentile(values, 0.5), 0.0);
  for (int i = 100; i >= 1; --i) values.push_back(static_cast<float>(i));
  EXPECT_EQ(percentile(values, 0.0), 1.0);
  EXPECT_EQ(percentile(values, 0.5), 50.0);
  EXPECT_EQ(percentile(values, 0.9), 90.0);
  EXPECT_EQ(percentile(values, 0.99), 99.0);
  EXPECT_EQ(percentile(values, 1.0), 100.0);
}

std::string summaryOf(const ReplayInputs& inputs, ReplaySummary& summary) {
  ReplayTouches touches = std::move(ReplayTouches::start(inputs)).value();
  EXPECT_TRUE(replay(inputs, 1, [&](const ReplayedStep& step) {
                summary.add(step);
                EXPECT_TRUE(touches.add(step.answer).ok());
                return true;
              }).ok());
  EXPECT_TRUE(touches.finish().ok());
  summary.add(touches);
  return summary.text(1);
}

using test::holds;

TEST(ReplaySummary, CountsStepsLinksAndWhatThePosesMiss) {
  // Through the wall; away from it; back so that the hips end in it while the arm does not reach
  // it.
  const ReplayInputs inputs = test::smallInputs({-0.25, 0.25, 0.75, 0.08, 0.08});
  ReplaySummary summary(inputs);
  const std::string text = summaryOf(inputs, summary);
  EXPECT_TRUE(holds(text,
                    "The man touches the wall 3 times. Checking the poses alone would miss "
                    "2 of them.\n"))
      << text;
  EXPECT_TRUE(holds(text, "\nHips                                     2                 1"))
      << text;
  EXPECT_TRUE(holds(text, "steps                          4\n")) << text;
  EXPECT_TRUE(holds(text, "link-steps                     8   2 links with an LSS\n")) << text;
  EXPECT_TRUE(holds(text, "steps with contact             3   75.0 %\n")) << text;
  EXPECT_TRUE(holds(text, "contacts                       3\n")) << text;
  EXPECT_TRUE(holds(text, "starts in contact              1\n")) << text;
  EXPECT_TRUE(holds(text, "of 3 contacts, 2 (66.7 %) touch nothing at either pose")) << text;
  EXPECT_LT(text.find("\nHips"), text.find("\nArm")) << text;  // two contacts before one
  ASSERT_EQ(summary.firstMissed().size(), 1u);  // the arm's comes later in the same step
  EXPECT_EQ(summary.firstMissed()[0].step, 0);
  EXPECT_EQ(summary.firstMissed()[0].contact.link, 0);
  EXPECT_NEAR(summary.firstMissed()[0].timeS, 0.03, 1e-3);
}

TEST(ReplaySummary, KeepsTheFirstMissedContactOfTheFirstSteps) {
  std::vector<double> places;
  for (int i = 0; i < 20; ++i) places.push_back(i % 2 == 0 ? -0.5 : 0.5);
  const ReplayInputs inputs = test::smallInputs(places);
  ReplaySummary summary(inputs);
  summaryOf(inputs, summary);
  EXPECT_EQ(summary.total().missedByPoses, 38);
  ASSERT_EQ(summary.firstMissed().size(), ReplaySummary::kKeptMissed);
  EXPECT_EQ(summary.firstMissed().back().step, ReplaySummary::kKeptMissed - 1);
}

TEST(ProgressLine, ShowsShareAndTimeLeft) {
  EXPECT_EQ(progressLine("replay", 0, 4, 0.0), "replay [------------------------------]   0 % 0/4");
  EXPECT_EQ(progressLine("replay", 1, 4, 30.0),
            "replay [#######-----------------------]  25 % 1/4, 1:30 left");
  EXPECT_EQ(progressLine("replay", 4, 4, 9.0), "replay [##############################] 100 % 4/4");
  EXPECT_EQ(progressLine("replay", 0, 0, 9.0), "replay [##############################] 100 % 0/0");
}

}  // namespace
}  // namespace foretouch::tools
