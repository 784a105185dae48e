// tests/oracle/leaf_campaign_main.cpp: exact leaf tests against the oracles, at any length. Exit
// code 0: every answer right; 1: one wrong, or one that the oracle could not tell; 2: bad use.
#include <chrono>
#include <cstdio>
#include <iostream>

#include <CLI/CLI.hpp>

#include "tests/oracle/leaf_campaign.h"
#include "tests/oracle/pair_campaign.h"
#include "tests/oracle/rigid_campaign.h"

namespace {

using foretouch::test::LeafJob;
using foretouch::test::LeafTally;

struct Arguments {
  std::uint64_t linear = 180'000, pairs = 8'000, rigid = 7'000, seed = 1;
  int threads = 2;
};

template <typename Families>
std::vector<std::string> namesOf(const Families& families) {
  std::vector<std::string> names;
  for (const auto& family : families) names.push_back(family.name);
  return names;
}

bool run(const char* kind, std::vector<std::string> names, std::uint64_t queries,
         const Arguments& a, std::vector<LeafTally> (*judge)(const LeafJob&)) {
  if (queries == 0) return true;
  const auto from = std::chrono::steady_clock::now();
  const std::uint64_t each = (queries + names.size() - 1) / names.size();
  std::vector<LeafTally> tallies = judge(LeafJob{a.seed, each, a.threads});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - from;
  LeafTally all;
  for (const LeafTally& tally : tallies) all.add(tally);
  all.failures.clear();
  names.emplace_back("all");
  tallies.push_back(all);
  std::cout << kind << ", seed " << a.seed << ", " << a.threads << " threads, " << took.count()
            << " s\n"
            << foretouch::test::tableOf(names, tallies) << std::endl;
  return all.wrong() == 0 && all.unproved == 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Judges exact leaf tests by rational and certified oracles"};
  app.add_option("--linear", a.linear, "Linear queries, spread over the families")
      ->capture_default_str();
  app.add_option("--pairs", a.pairs, "Pairs of moving triangles, spread over the families")
      ->capture_default_str();
  app.add_option("--rigid", a.rigid, "Rigid queries, spread over the families")
      ->capture_default_str();
  app.add_option("--seed", a.seed, "Another seed, other queries")->capture_default_str();
  app.add_option("--threads", a.threads, "Worker threads")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  using namespace foretouch::test;
  const bool linear = run("linear", namesOf(linearFamilies()), a.linear, a, judgeLinear);
  const bool pairs = run("pairs", pairFamilies(), a.pairs, a, judgePairs);
  const bool rigid = run("rigid", namesOf(rigidFamilies()), a.rigid, a, judgeRigid);
  return linear && pairs && rigid ? 0 : 1;
}
