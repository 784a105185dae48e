// ask_oracle: judges questions to random worlds, now and then, and how near motions come, at any
// length.
//   ask_oracle [--seeds N] [--first S] [--questions N] [--flights N] [--clearances N]
//              [--first-kind K]
#include <cstdint>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/middleware/ask/ask_campaign.h"
#include "tests/middleware/near/clearance_campaign.h"

int main(int count, char** arguments) {
  constexpr int kMostSeeds = 1'000'000'000;
  int seeds = 1000, first = 0, questions = 100, flights = 10, clearances = 0, firstKind = 0;
  CLI::App program{"Questions to random worlds, each answer judged part by part"};
  program.add_option("--seeds", seeds, "Worlds")->check(CLI::Range(1, kMostSeeds));
  program.add_option("--first", first, "The first one's seed")->check(CLI::Range(0, kMostSeeds));
  program.add_option("--questions", questions, "Per world")->check(CLI::Range(0, kMostSeeds));
  program.add_option("--flights", flights, "Per world")->check(CLI::Range(0, kMostSeeds));
  program.add_option("--clearances", clearances, "Motions per world")
      ->check(CLI::Range(0, kMostSeeds));
  program
      .add_option("--first-kind", firstKind, "Only kinds from this one on; 5: hulls and insides")
      ->check(CLI::Range(0, foretouch::test::kAskedKinds - 1));
  CLI11_PARSE(program, count, arguments);
  std::printf("worlds %d to %d, each: %d questions, %d flights, %d clearances\n", first,
              first + seeds - 1, questions, flights, clearances);
  foretouch::test::AskTally all;
  foretouch::test::ClearanceTally near;
  std::size_t said = 0, saidOfNear = 0;  // problems
  for (int i = 0; i < seeds; ++i) {
    const auto seed = static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(i);
    if (questions > 0) all.add(foretouch::test::judgeQuestions(seed, questions, {}, firstKind));
    if (flights > 0) all.add(foretouch::test::judgeFlights(seed, flights));
    if (clearances > 0) near.add(foretouch::test::judgeClearances(seed, clearances));
    while (said < all.problems.size()) std::puts(all.problems[said++].c_str());
    while (saidOfNear < near.problems.size()) std::puts(near.problems[saidOfNear++].c_str());
    std::fflush(stdout);
  }
  if (all.parts > 0) std::fputs(summaryOf(all).c_str(), stdout);
  if (near.asked > 0) std::fputs(summaryOf(near).c_str(), stdout);
  return all.problems.empty() && near.problems.empty() ? 0 : 1;
}
