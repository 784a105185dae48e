// tests/oracle/leaf_campaign_main.cpp: exact leaf tests against the oracles, at any length. Exit
// code 0: every answer right; 1: one wrong, or one that the oracle could not tell; 2: bad use.
#include <chrono>
#include <cstdio>
#include <iostream>

#include <CLI/CLI.hpp>

#include "tests/oracle/leaf_campaign.h"
#include "tests/oracle/rigid_campaign.h"

namespace {

using foretouch::test::LeafJob;
using foretouch::test::LeafTally;

struct Arguments {
  std::uint64_t linear = 180'000, rigid = 7'000, seed = 1;
  int threads = 2;
};

template <typename Families, typename Judge>
bool run(const char* kind, const Families& families, std::uint64_t queries, const Arguments& a,
         Judge judge) {
  if (queries == 0) return true;
  const auto from = std::chrono::steady_clock::now();
  const std::uint64_t each = (queries + families.size() - 1) / families.size();
  std::vector<LeafTally> tallies = judge(LeafJob{a.seed, each, a.threads});
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - from;
  std::vector<std::string> names;
  LeafTally all;
  for (std::size_t i = 0; i < families.size(); ++i) {
    names.push_back(families[i].name);
    all.add(tallies[i]);
  }
  all.failures.clear();
  names.emplace_back("all");
  tallies.push_back(all);
  std::cout << kind << ", seed " << a.seed << ", " << a.threads << " threads, " << took.count()
            << " s\n"
            << tableOf(names, tallies) << std::endl;
  return all.wrong() == 0 && all.unproved == 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  CLI::App app{"Judges exact leaf tests by rational and certified oracles"};
  app.add_option("--linear", a.linear, "Linear queries, spread over the families")
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
  const bool linear = run("linear", foretouch::test::linearFamilies(), a.linear, a,
                          [](const LeafJob& job) { return foretouch::test::judgeLinear(job); });
  const bool rigid = run("rigid", foretouch::test::rigidFamilies(), a.rigid, a,
                         [](const LeafJob& job) { return foretouch::test::judgeRigid(job); });
  return linear && rigid ? 0 : 1;
}
