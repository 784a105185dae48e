// tests/middleware/solid_world/together_campaign_test.cpp: a sample of the campaign, and the
// control: the judge names every lie.
#include "tests/middleware/solid_world/together_campaign.h"

#include <cstdint>
#include <functional>
#include <utility>

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
  // Fewer than while who has to get out of the way kept own links apart: of these, 56.
  EXPECT_LT(total.crushed, total.ticks / 70);
}

// Worlds in which somebody once claimed more: who stayed, while another one passed by who had
// proven that he might.
TEST(TogetherCampaign, TheClearanceOfWhoStaysIsNotBeyondTheTruth) {
  const std::pair<std::uint64_t, double> worlds[] = {
      {1090, 10.0}, {2024, 10.0}, {2221, 30.0}, {10054, 30.0}};
  std::uint64_t crushed = 0;
  for (const auto& [seed, rateHz] : worlds) {
    TogetherCampaign campaign;
    campaign.seed = seed;
    campaign.rateHz = rateHz;
    campaign.ticks = 300;
    campaign.instants = 10;
    const TogetherTally tally = judgeTogether(campaign);
    for (const std::string& finding : tally.findings) ADD_FAILURE() << finding;
    EXPECT_EQ(tally.violations(), 0u);
    crushed += tally.crushed;
  }
  EXPECT_GT(crushed, 400u);
}

TEST(TogetherCampaign, TheSameSeedShowsTheSameBits) {
  for (const std::uint64_t seed : {3u, 6u}) {
    TogetherCampaign campaign;
    campaign.seed = seed;
    campaign.ticks = 80;
    campaign.rateHz = 30.0;
    campaign.instants = 1;
    EXPECT_EQ(judgeTogether(campaign).digest, judgeTogether(campaign).digest) << seed;
  }
}

// The control: whoever lies is found.
TEST(TogetherCampaign, NamesLies) {
  const auto judged = [](std::function<void(SolidBodyTick&)> lie) {
    TogetherTally total;
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      TogetherCampaign campaign;
      campaign.seed = 6 + seed;
      campaign.ticks = 60;
      campaign.rateHz = 10.0;
      campaign.instants = 20;
      campaign.tamper = [&](std::vector<SolidBodyTick>& ticks) {
        for (SolidBodyTick& tick : ticks) lie(tick);
      };
      total.add(judgeTogether(campaign));
    }
    return total;
  };
  const TogetherTally honest = judged([](SolidBodyTick&) {});
  EXPECT_EQ(honest.violations(), 0u);
  ASSERT_GT(honest.crushed, 5u);
  EXPECT_GT(judged([](SolidBodyTick& tick) { tick.crushes.clear(); }).inside, 5u);
  EXPECT_GT(judged([](SolidBodyTick& tick) {
              for (SolidCrush& crush : tick.crushes) crush.sinceUs += 50'000;
            }).inside,
            0u);
  EXPECT_GT(judged([](SolidBodyTick& tick) { tick.tick.isCertified = true; }).uncertified, 5u);
  EXPECT_GT(judged([](SolidBodyTick& tick) { tick.tick.clearance += 1e-2; }).overclaimed, 50u);
  EXPECT_GT(judged([](SolidBodyTick& tick) {
              for (std::size_t i = 0; i < tick.tick.numWay; ++i) {
                tick.tick.way[i].translations[0].y() -= 0.05;
              }
              tick.tick.shown.translations[0].y() -= tick.tick.numWay > 0 ? 0.05 : 0.0;
            }).violations(),
            50u);
}

}  // namespace
}  // namespace foretouch::test
