// ask_oracle: judges questions to random worlds, now and then, at any length.
//   ask_oracle [--seeds N] [--first S] [--questions N] [--flights N] [--first-kind K]
#include <cstdint>
#include <cstdio>
#include <string>

#include <CLI/CLI.hpp>

#include "tests/middleware/ask/ask_campaign.h"

int main(int count, char** arguments) {
  constexpr int kMostSeeds = 1'000'000'000;
  int seeds = 1000, first = 0, questions = 100, flights = 10, firstKind = 0;
  CLI::App program{"Questions to random worlds, each answer judged part by part"};
  program.add_option("--seeds", seeds, "Worlds")->check(CLI::Range(1, kMostSeeds));
  program.add_option("--first", first, "The first one's seed")->check(CLI::Range(0, kMostSeeds));
  program.add_option("--questions", questions, "Per world")->check(CLI::Range(0, kMostSeeds));
  program.add_option("--flights", flights, "Per world")->check(CLI::Range(0, kMostSeeds));
  program
      .add_option("--first-kind", firstKind, "Only kinds from this one on; 5: hulls and insides")
      ->check(CLI::Range(0, foretouch::test::kAskedKinds - 1));
  CLI11_PARSE(program, count, arguments);
  foretouch::test::AskTally all;
  for (int i = 0; i < seeds; ++i) {
    const auto seed = static_cast<std::uint64_t>(first) + static_cast<std::uint64_t>(i);
    if (questions > 0) all.add(foretouch::test::judgeQuestions(seed, questions, {}, firstKind));
    if (flights > 0) all.add(foretouch::test::judgeFlights(seed, flights));
  }
  for (const std::string& problem : all.problems) std::puts(problem.c_str());
  std::fputs(summaryOf(all).c_str(), stdout);
  return all.problems.empty() ? 0 : 1;
}
