// tests/middleware/solid_world/together_campaign_test.cpp: a sample of the campaign, and the
// control: the judge names every lie.
#include "tests/middleware/solid_world/together_campaign.h"

#include <gtest/gtest.h>

namespace foretouch::test {
namespace {

TEST(TogetherCampaign, NothingIsInsideThatIsNotSaid) {
  TogetherTally total;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    TogetherCampaign campaign;
    campaign.seed = seed;
    campaign.ticks = 150;
    campaign.rateHz = seed % 3 == 0 ? 90.0 : seed % 3 == 1 ? 30.0 : 10.0;
    campaign.instants = 25;
    total.add(judgeTogether(campaign));
  }
  for (const std::string& finding : total.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(total.violations(), 0u) << summaryOf(total);
  EXPECT_GT(total.ticks, 2000u);
  EXPECT_GT(total.pushed, 300u);
  EXPECT_LT(total.crushed, total.ticks / 2);
}

}  // namespace
}  // namespace foretouch::test
