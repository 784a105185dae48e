// tests/oracle/solid_world_oracle.cpp: the campaign of together_campaign.h at any length. Exit code
// 0: every promise kept; 1: one broken; 2: bad use.
#include <iostream>

#include <CLI/CLI.hpp>

#include "tests/middleware/solid_world/together_campaign.h"

int main(int argc, char** argv) {
  using namespace foretouch::test;
  TogetherCampaign campaign;
  std::uint64_t seeds = 30;
  std::vector<double> rates{90, 30, 10};
  CLI::App app{
      "Judges all that solid avatars show among what moves, by an oracle that shares no code"};
  app.add_option("--seeds", seeds, "How many worlds, at each rate")->check(CLI::PositiveNumber);
  app.add_option("--first", campaign.seed, "The first one's seed");
  app.add_option("--ticks", campaign.ticks, "Of each world")->check(CLI::PositiveNumber);
  app.add_option("--rates", rates, "Hz")->delimiter(',')->check(CLI::Range(1.0, 1000.0));
  app.add_option("--instants", campaign.instants, "Of each tick")->check(CLI::PositiveNumber);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  TogetherTally total;
  const std::uint64_t first = campaign.seed;
  for (std::uint64_t i = 0; i < seeds; ++i) {
    for (const double rate : rates) {
      campaign.seed = first + i;
      campaign.rateHz = rate;
      const TogetherTally tally = judgeTogether(campaign);
      total.add(tally);
      if (tally.violations() > 0) {
        std::cout << "seed " << campaign.seed << ", " << rate << " Hz: " << summaryOf(tally)
                  << std::endl;
      }
    }
    if ((i + 1) % 20 == 0) std::cout << i + 1 << " worlds: " << summaryOf(total) << std::endl;
  }
  std::cout << "total: " << summaryOf(total) << "\n";
  for (const std::string& finding : total.findings) std::cout << "  " << finding << "\n";
  return total.violations() > 0 ? 1 : 0;
}
